"""Drives, friction and springs of a joint of a compiled MuJoCo model."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np

from rrr._rrr import Error

FIXED, OF_MOTOR = int(mujoco.mjtGain.mjGAIN_FIXED), int(mujoco.mjtGain.mjGAIN_DCMOTOR)
NO_BIAS, AFFINE = int(mujoco.mjtBias.mjBIAS_NONE), int(mujoco.mjtBias.mjBIAS_AFFINE)
NONE, FILTER = int(mujoco.mjtDyn.mjDYN_NONE), int(mujoco.mjtDyn.mjDYN_FILTER)
EXACT, MOTOR = int(mujoco.mjtDyn.mjDYN_FILTEREXACT), int(mujoco.mjtDyn.mjDYN_DCMOTOR)
NO_INPUT = int(mujoco.mjtCtrlInput.mjINPUT_NONE) if hasattr(mujoco, "mjtCtrlInput") else 16


@dataclass
class Drive:
    """What drives a joint, in terms of its command u: torque = constant u.

    `gear` is actuator length by joint position; `stiffness` and `damping` [Nm/rad, Nm s/rad] are those
    of a position servo, or the damping that a motor's back-EMF adds; `lag_s`, `delay_s`.
    """

    actuator: int | None = None
    kind: str = "torque"
    constant: float = 1.0
    gear: float = 1.0
    stiffness: float = 0.0
    damping: float = 0.0
    limit: float = np.inf
    lag_s: float = 0.0
    delay_s: float = 0.0
    bristles: dict[str, float] = field(default_factory=dict)
    cogging: tuple[float, float, float] = (0.0, 0.0, 0.0)


def on_joint(m: Any, joint: int) -> list[int]:
    """Actuators that act on a joint, passive ones too."""
    is_joint = m.actuator_trntype == int(mujoco.mjtTrn.mjTRN_JOINT)
    is_joint |= m.actuator_trntype == int(mujoco.mjtTrn.mjTRN_JOINTINPARENT)
    return [int(a) for a in np.flatnonzero(is_joint & (m.actuator_trnid[:, 0] == joint))]


def is_passive(m: Any, actuator: int) -> bool:
    """Whether it takes no command: a `dcmotor` that stands for friction or cogging."""
    return int(m.actuator_ctrlnum[actuator]) == 0


def drive(m: Any, joint: int) -> Drive:
    """The drive of a joint.

    Raises `rrr.Error` where several drive it, or one of a kind that this package does not know.
    """
    every = on_joint(m, joint)
    driving = [a for a in every if not is_passive(m, a)]
    if len(driving) > 1:
        names = ", ".join(m.actuator(a).name or str(a) for a in driving)
        where = m.joint(joint).name or str(joint)
        raise Error(f"several actuators drive the joint {where}: {names}\nhint: keep one of them")
    found = _driven(m, driving[0]) if driving else Drive()
    for actuator in every:
        if m.actuator_biastype[actuator] == int(mujoco.mjtBias.mjBIAS_DCMOTOR):
            _add_passive(m, actuator, found)
    _limit_torque(m, joint, found)
    return found


def _driven(m: Any, a: int) -> Drive:
    gain, bias, gear = m.actuator_gainprm[a], m.actuator_biasprm[a], float(m.actuator_gear[a, 0])
    kinds = (int(m.actuator_gaintype[a]), int(m.actuator_biastype[a]))
    found = Drive(a, gear=gear, delay_s=float(m.actuator_delay[a]))
    if kinds == (FIXED, NO_BIAS):
        found.constant = gear * float(gain[0])
    elif kinds == (FIXED, AFFINE) and _is_position_servo(gain, bias):
        # The goal is taken in the joint's own unit, a gear apart from the actuator's.
        found.kind, found.constant = "position-servo", 1.0
        found.stiffness, found.damping = gear**2 * float(gain[0]), -(gear**2) * float(bias[2])
    elif kinds[0] == OF_MOTOR and _is_plain_motor(m, a):
        found.constant = gear * float(gain[1] / gain[0])
        found.damping = gear**2 * float(gain[1] ** 2 / gain[0])
    else:
        raise Error(
            f"the actuator {m.actuator(a).name or a} is of a kind that has no form here"
            "\nhint: motor, position, general with a fixed gain, and dcmotor by its voltage have one"
        )
    _add_dynamics(m, a, found)
    _limit_command(m, a, found, float(gain[0]) if kinds[0] == FIXED else 1.0)
    if found.kind != "position-servo":
        is_torque = kinds[0] == FIXED and found.constant == 1.0
        found.kind = "torque" if is_torque else "voltage"
    return found


def _is_position_servo(gain: Any, bias: Any) -> bool:
    return bool(gain[0] > 0 and bias[1] == -gain[0] and bias[0] == 0)


def _is_plain_motor(m: Any, a: int) -> bool:
    """Without a controller, inductance or heat."""
    return int(m.actuator_actnum[a]) <= (1 if m.actuator_dynprm[a, 5] > 0 else 0)


def _add_dynamics(m: Any, a: int, found: Drive) -> None:
    kind = int(m.actuator_dyntype[a])
    if kind in (FILTER, EXACT):
        found.lag_s = float(m.actuator_dynprm[a, 0])
    elif kind not in (NONE, MOTOR):
        name = m.actuator(a).name or a
        raise Error(f"the actuator {name} has dynamics that have no form here\nhint: filter has one")


def _limit_command(m: Any, a: int, found: Drive, gain: float) -> None:
    """The largest command that the actuator passes on, in the command's unit."""
    if m.actuator_forcelimited[a]:
        torque = abs(found.gear) * float(np.abs(m.actuator_forcerange[a]).max())
        found.limit = min(found.limit, torque / abs(found.constant))
    control = int(m.actuator_ctrladr[a]) if hasattr(m, "actuator_ctrladr") else a
    if found.kind != "position-servo" and m.actuator_ctrllimited[control]:
        found.limit = min(found.limit, float(np.abs(m.actuator_ctrlrange[control]).max()))


def _limit_torque(m: Any, joint: int, found: Drive) -> None:
    if m.jnt_actfrclimited[joint]:
        torque = float(np.abs(m.jnt_actfrcrange[joint]).max())
        found.limit = min(found.limit, torque / abs(found.constant))


def _add_passive(m: Any, a: int, found: Drive) -> None:
    """Cogging and LuGre friction of a `dcmotor`, at the joint."""
    bias, dynamics, gear = m.actuator_biasprm[a], m.actuator_dynprm[a], float(m.actuator_gear[a, 0])
    amplitude, poles, phase = (float(value) for value in bias[:3])
    if amplitude:
        found.cogging = (gear * amplitude, gear * poles, phase)
    if dynamics[5] > 0:
        found.bristles = {
            "sigma0": gear**2 * float(dynamics[5]),
            "sigma1": gear**2 * float(dynamics[6]),
            "coulomb": abs(gear) * float(bias[3]),
            "static": abs(gear) * float(bias[4]),
            "stribeck": float(bias[5]) / abs(gear),
        }


def armature(m: Any, joint: int) -> float:
    """Rotor inertia at a joint [kg m^2; kg], that of its actuators included."""
    own = float(m.dof_armature[m.jnt_dofadr[joint]])
    return own + sum(
        float(m.actuator_armature[a] * m.actuator_gear[a, 0] ** 2) for a in on_joint(m, joint)
    )


def damping(m: Any, joint: int) -> tuple[float, float, float]:
    """Coefficients of v, v |v| and v^3 at a joint [Nm s/rad, ...], those of its actuators included."""
    dof = int(m.jnt_dofadr[joint])
    own = np.array([m.dof_damping[dof], *m.dof_dampingpoly[dof]], dtype=np.float64)
    for a in on_joint(m, joint):
        gear = abs(float(m.actuator_gear[a, 0]))
        more = np.array([m.actuator_damping[a], *m.actuator_dampingpoly[a]])
        own += more * gear ** np.array([2, 3, 4])
    linear, square, cube = (float(value) for value in own)
    return linear, square, cube
