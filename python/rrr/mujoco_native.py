"""Effects in the forms that MuJoCo has for them.

An effect of the table `FORMS` becomes a part of the specification; all others are handed on to the
file of callbacks, with what it must know of the joint.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from rrr.mujoco_chain import SLIDE, Inertial, Link, body_inertial, whole
from rrr.mujoco_drive import FIXED, NO_INPUT, drive, on_joint
from rrr.mujoco_model import from_mujoco
from rrr.mujoco_parameters import set_inertial

Parameters = dict[str, Any]


class Amendment:
    """A specification that takes effects; `left` are those that it has no form for.

    `constants` is the torque by command of each joint [Nm by the command's unit].
    """

    def __init__(
        self,
        spec: Any,
        m: Any,
        links: list[Link],
        constants: list[float],
        joints: list[dict[str, Any]],
    ) -> None:
        self.spec, self.m, self.links = spec, m, links
        self.constants, self.joints = constants, joints
        # What the engine's model has already.
        self.given = from_mujoco(m).to_dict().get("effect", [])
        self.left: list[dict[str, Any]] = []

    def add(self, effect: dict[str, Any]) -> None:
        """Takes an `[[effect]]` of the model."""
        name, number = effect["effect"], int(effect.get("joint", 0))
        parameters = effect.get("parameters", {})
        if effect in self.given:
            return
        form = FORMS.get(name)
        if form is None or not form(self, number - 1, parameters):
            self._leave(name, number, parameters)

    def actuator(self, index: int) -> Any | None:
        """The actuator that drives a joint, by its number from 0."""
        found = drive(self.m, self.links[index].joint)
        return None if found.actuator is None else self.spec.actuators[found.actuator]

    def joint(self, index: int) -> Any:
        """A joint's element."""
        return self.spec.joints[self.links[index].joint]

    def joint_name(self, index: int) -> str:
        """A joint's name; one that has none is given one."""
        joint = self.joint(index)
        if not joint.name:
            joint.name = f"joint{index + 1}"
        return str(joint.name)

    def add_passive(self, index: int) -> Any:
        """A `dcmotor` on a joint that takes no command."""
        actuator = self.spec.add_actuator(
            target=self.joint_name(index), trntype=mujoco.mjtTrn.mjTRN_JOINT
        )
        actuator.gear = [1, 0, 0, 0, 0, 0]
        return actuator

    def _leave(self, name: str, number: int, parameters: Parameters) -> None:
        """Hands an effect on, with what a callback must know."""
        left: dict[str, Any] = {"effect": name, "joint": number, "parameters": parameters}
        if number:
            left |= self._of_joint(number - 1)
        else:
            link = self.links[-1]
            body = self.spec.bodies[link.root]
            body.name = body.name or "tip"
            left |= {"body": str(body.name), "tip_m": [float(x) for x in link.anchor]}
        self.left.append(left)

    def _of_joint(self, index: int) -> dict[str, Any]:
        actuator = self.actuator(index)
        if actuator is not None and not actuator.name:
            actuator.name = f"drive{index + 1}"
        friction = self.joints[index].get("friction", {})
        value = {name.split("_")[0]: v for name, v in friction.items()}
        k = abs(self.constants[index])
        return {
            "name": self.joint_name(index),
            "actuator": None if actuator is None else str(actuator.name),
            "torque_constant": self.constants[index],
            "coulomb": k * value.get("alpha0", 0.0),
            "viscous": k * value.get("alpha2", 0.0),
        }


def _torque_constant(to: Amendment, index: int, p: Parameters) -> bool:
    actuator = to.actuator(index)
    if actuator is None or int(actuator.gaintype) != FIXED:
        return False
    gain = np.array(actuator.gainprm)
    gain[0] *= 1 + p["relative_error"]
    actuator.gainprm = gain
    bias = np.array(actuator.biasprm)
    actuator.biasprm = bias * (1 + p["relative_error"])
    return True


def _lag(to: Amendment, index: int, p: Parameters) -> bool:
    """`filterexact`; the state acts in the step that it is computed for."""
    actuator = to.actuator(index)
    is_free = actuator is not None and int(actuator.dyntype) == int(mujoco.mjtDyn.mjDYN_NONE)
    is_filter = actuator is not None and not is_free and _is_filter(actuator)
    if actuator is None or not (is_free or is_filter):
        return False
    dynamics = np.array(actuator.dynprm)
    dynamics[0] = p["time_constant_s"]
    actuator.dyntype = mujoco.mjtDyn.mjDYN_FILTEREXACT
    actuator.dynprm, actuator.actearly = dynamics, True
    return True


def _is_filter(actuator: Any) -> bool:
    kinds = (mujoco.mjtDyn.mjDYN_FILTER, mujoco.mjtDyn.mjDYN_FILTEREXACT)
    return int(actuator.dyntype) in [int(kind) for kind in kinds]


def _delay(to: Amendment, index: int, p: Parameters) -> bool:
    actuator = to.actuator(index)
    if actuator is None:
        return False
    actuator.delay = p["delay_s"]
    actuator.nsample = max(int(p["delay_s"] / to.spec.option.timestep) + 3, int(actuator.nsample))
    return True


def _saturation(to: Amendment, index: int, p: Parameters) -> bool:
    actuator = to.actuator(index)
    if actuator is None:
        return False
    actuator.ctrllimited, actuator.ctrlrange = True, [-p["limit_V"], p["limit_V"]]
    return True


def _offset(to: Amendment, index: int, p: Parameters) -> bool:
    """A constant in the actuator's bias."""
    actuator = to.actuator(index)
    if actuator is None or int(actuator.gaintype) != FIXED:
        return False
    bias = np.array(actuator.biasprm)
    bias[0] += float(actuator.gainprm[0]) * p["offset_V"]
    actuator.biastype, actuator.biasprm = mujoco.mjtBias.mjBIAS_AFFINE, bias
    return True


def _spring(to: Amendment, index: int, p: Parameters) -> bool:
    joint, stiffness = to.joint(index), to.constants[index] * p["stiffness_V_per_rad"]
    if stiffness < 0:
        return False
    joint.stiffness = [stiffness, 0, 0]
    joint.springref = _in_own_unit(to, to.links[index], [p["rest_rad"]])[0]
    return True


def _drag(to: Amendment, index: int, p: Parameters) -> bool:
    """The second coefficient of damping, which is odd in speed."""
    joint = to.joint(index)
    square = to.constants[index] * p["coefficient_V_s2_per_rad2"]
    coefficients = np.array(joint.damping, dtype=np.float64)
    coefficients[1] = square
    joint.damping = coefficients
    return True


def _cogging(to: Amendment, index: int, p: Parameters) -> bool:
    """A `dcmotor` without input; its poles are whole."""
    poles = float(p["harmonic"])
    if abs(poles - round(poles)) > 1e-9:
        return False
    wave = [to.constants[index] * p["amplitude_V"], round(poles), p["phase_rad"]]
    if wave[0] < 0:
        wave = [-wave[0], wave[1], wave[2] + math.pi]
    to.add_passive(index).set_to_dcmotor(
        motorconst=[0, 0], resistance=1, cogging=wave, ctrlspec=NO_INPUT
    )
    return True


def _payload(to: Amendment, _: int, p: Parameters) -> bool:
    """A body at the tip; a negative mass goes into the last link."""
    link, mass = to.links[-1], float(p["mass_kg"])
    place = link.anchor + np.array(p.get("com_m", [0.0, 0.0, 0.0]))
    body = to.spec.bodies[link.root]
    if mass > 0:
        load = body.add_body(name="payload", pos=place)
        # A body without a centre of its own would have it at its place in the body above.
        load.explicitinertial, load.mass, load.ipos = True, mass, np.zeros(3)
        load.inertia = np.full(3, 1e-9)
    else:
        own = _inertial_of(body, to.m, link.root)
        set_inertial(body, whole([own, Inertial(mass, place, np.zeros((3, 3)))]))
    return True


def _inertial_of(body: Any, m: Any, root: int) -> Inertial:
    """What the specification says by now, or what was compiled."""
    if not body.explicitinertial:
        return body_inertial(m, root)
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, np.array(body.iquat))
    matrix = turn.reshape(3, 3)
    about = matrix @ np.diag(body.inertia) @ matrix.T
    return Inertial(float(body.mass), np.array(body.ipos), about)


def _tilt(to: Amendment, _: int, p: Parameters) -> bool:
    g = float(np.linalg.norm(to.m.opt.gravity))
    a, b = p["tilt_x_rad"], p["tilt_y_rad"]
    down = [math.sin(b), -math.sin(a) * math.cos(b), -math.cos(a) * math.cos(b)]
    to.spec.option.gravity = [g * x for x in down]
    return True


def _elasticity(to: Amendment, index: int, p: Parameters) -> bool:
    """A second hinge on the same axis: the joint is the motor's, the new one how far the link is
    ahead of it."""
    new = _second_joint(to, index, p)
    new.stiffness = [p["stiffness_Nm_per_rad"], 0, 0]
    new.damping = [p["damping_Nm_s_per_rad"], 0, 0]
    return True


def _second_joint(to: Amendment, index: int, p: Parameters) -> Any:
    joint, link = to.joint(index), to.links[index]
    body = to.spec.bodies[link.root]
    # What the motor has is a part of the joint's own inertia: the rest of the rotor goes to the link.
    rest = float(joint.armature) - p["motor_inertia_kg_m2"]
    joint.armature = p["motor_inertia_kg_m2"]
    is_slide = to.m.jnt_type[link.joint] == SLIDE
    if rest and not is_slide:
        own = _inertial_of(body, to.m, link.root)
        about = own.about_centre + rest * np.outer(link.axis, link.axis)
        set_inertial(body, Inertial(own.mass, own.centre, about))
    return body.add_joint(
        name=f"{to.joint_name(index)}_link", type=joint.type, axis=link.axis, pos=link.anchor
    )


def _backlash(to: Amendment, index: int, p: Parameters) -> bool:
    """The same with a range for a spring: contact at its ends as stiff and as damped."""
    link = to.links[index]
    inertia = _reduced_inertia(to, index, p["motor_inertia_kg_m2"])
    stiffness, damping = p["stiffness_Nm_per_rad"], p["damping_Nm_s_per_rad"]
    frequency = math.sqrt(stiffness / inertia)
    ratio = max(damping / (2 * math.sqrt(stiffness * inertia)), 0.05)
    constant = max(1 / (ratio * frequency), 2 * to.spec.option.timestep)
    new = _second_joint(to, index, p)
    half = 0.5 * p["gap_rad"]
    new.limited, new.range = True, _in_own_unit(to, link, [-half, half])
    new.solref_limit = [constant, ratio]
    return True


def _reduced_inertia(to: Amendment, index: int, motor: float) -> float:
    """That of motor and link against each other, in the model's own posture [kg m^2]."""
    dof = int(to.m.jnt_dofadr[to.links[index].joint])
    link = max(1.0 / float(to.m.dof_invweight0[dof]) - motor, motor)
    return motor * link / (motor + link)


def _in_own_unit(to: Amendment, link: Link, angles: list[float]) -> list[float]:
    """Ranges stand in degrees where the compiler reads degrees."""
    is_slide = to.m.jnt_type[link.joint] == SLIDE
    by = math.degrees(1.0) if to.spec.compiler.degree and not is_slide else 1.0
    return [by * angle for angle in angles]


FORMS: dict[str, Callable[[Amendment, int, Parameters], bool]] = {
    "torque_constant": _torque_constant,
    "actuator_lag": _lag,
    "delay": _delay,
    "saturation": _saturation,
    "dac_offset": _offset,
    "cable_spring": _spring,
    "quadratic_drag": _drag,
    "cogging": _cogging,
    "payload": _payload,
    "base_tilt": _tilt,
    "joint_elasticity": _elasticity,
    "backlash": _backlash,
}
"""What puts an effect into the specification: of the amendment, the joint's index (-1 for the whole
robot) and the parameters; False where it cannot."""
