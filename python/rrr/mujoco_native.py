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

from rrr.mujoco_amendment import Amendment, Parameters, in_own_unit, inertial_of
from rrr.mujoco_chain import Inertial, whole
from rrr.mujoco_drive import FIXED, NO_INPUT
from rrr.mujoco_hinges import backlash, elasticity
from rrr.mujoco_parameters import set_inertial


def add(to: Amendment, effect: dict[str, Any]) -> None:
    """Puts an `[[effect]]` of the model into a specification, or hands it on."""
    if effect in to.given:
        return
    name, number = effect["effect"], int(effect.get("joint", 0))
    parameters = effect.get("parameters", {})
    form = FORMS.get(name)
    if form is None or not form(to, number - 1, parameters):
        to.leave(name, number, parameters)


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
    joint.springref = in_own_unit(to, to.links[index], [p["rest_rad"]])[0]
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
        own = inertial_of(body, to.m, link.root)
        set_inertial(body, whole([own, Inertial(mass, place, np.zeros((3, 3)))]))
    return True


def _tilt(to: Amendment, _: int, p: Parameters) -> bool:
    g = float(np.linalg.norm(to.m.opt.gravity))
    a, b = p["tilt_x_rad"], p["tilt_y_rad"]
    down = [math.sin(b), -math.sin(a) * math.cos(b), -math.cos(a) * math.cos(b)]
    to.spec.option.gravity = [g * x for x in down]
    return True


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
    "joint_elasticity": elasticity,
    "backlash": backlash,
}
"""What puts an effect into the specification: of the amendment, the joint's index (-1 for the whole
robot) and the parameters; False where it cannot."""
