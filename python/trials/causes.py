"""Hidden causes of the trials, made without the code that amends models.

Each is put into the robot's specification by elements of the engine, or done to its commands, torques
and readings while it is recorded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np
from arm import TORQUE_CONSTANT


@dataclass
class Cause:
    """An effect of docs/effects.md on a joint, 1 to 3, or on the whole robot, 0."""

    effect: str
    joint: int
    parameters: dict[str, Any] = field(default_factory=dict)

    @property
    def index(self) -> int:
        """The joint's number from 0."""
        return self.joint - 1

    @property
    def k(self) -> float:
        """Torque constant of the joint [Nm/V]."""
        return TORQUE_CONSTANT[self.index]


CAUSES = [
    Cause("cogging", 3, {"amplitude_V": 0.12, "harmonic": 7, "phase_rad": 0.6}),
    Cause("payload", 0, {"mass_kg": 0.35, "com_m": [0.3, 0.02, 0.0]}),
    Cause("dac_offset", 2, {"offset_V": 0.09}),
    Cause("torque_constant", 2, {"relative_error": 0.12}),
    Cause("actuator_lag", 1, {"time_constant_s": 0.006}),
    Cause("delay", 3, {"delay_s": 0.004}),
    Cause("cable_spring", 3, {"stiffness_V_per_rad": 0.12, "rest_rad": 0.4}),
    Cause("quadratic_drag", 3, {"coefficient_V_s2_per_rad2": 0.015}),
    Cause("base_tilt", 0, {"tilt_x_rad": 0.05, "tilt_y_rad": -0.03}),
    Cause("saturation", 1, {"limit_V": 1.1}),
    Cause("joint_elasticity", 3, {
        "stiffness_Nm_per_rad": 900.0, "damping_Nm_s_per_rad": 0.6, "motor_inertia_kg_m2": 0.08}),
    Cause("backlash", 3, {
        "gap_rad": 0.02, "stiffness_Nm_per_rad": 5000.0, "damping_Nm_s_per_rad": 8.0,
        "motor_inertia_kg_m2": 0.08}),
    Cause("asymmetric_friction", 2, {"relative_asymmetry": 0.3}),
    Cause("position_friction", 3, {"relative_amplitude": 0.5, "harmonic": 2, "phase_rad": 1.0}),
    Cause("load_friction", 2, {"coefficient_V_per_Nm": 0.02}),
    Cause("friction_drift", 1, {"relative_change": 0.6, "time_constant_s": 4.0}),
    Cause("torque_ripple", 2, {"relative_amplitude": 0.12, "harmonic": 5, "phase_rad": -0.4}),
    Cause("dead_zone", 3, {"half_width_V": 0.15}),
    Cause("tip_force", 0, {"force_N": [3.0, -2.0, 4.0]}),
]
"""One of each; the command of its joint changes by some tens of millivolts or more."""
SHORT = ["cogging", "payload", "asymmetric_friction"]
"""Those of the tests: one for each way into the amended model."""


def put_in(spec: Any, cause: Cause) -> None:
    """Makes a cause that is a part of the robot's body or of its motors."""
    p = cause.parameters
    tip = spec.body("lower")
    if cause.effect == "payload":
        load = tip.add_body(name="load")
        load.pos, load.ipos = p["com_m"], [0, 0, 0]
        load.explicitinertial, load.mass, load.inertia = True, p["mass_kg"], np.full(3, 1e-9)
    elif cause.effect == "torque_constant":
        gear = np.array(spec.actuators[cause.index].gear)
        spec.actuators[cause.index].gear = gear * (1 + p["relative_error"])
    elif cause.effect == "base_tilt":
        a, b = p["tilt_x_rad"], p["tilt_y_rad"]
        down = [math.sin(b), -math.sin(a) * math.cos(b), -math.cos(a) * math.cos(b)]
        spec.option.gravity = [9.81 * x for x in down]
    elif cause.effect in ("joint_elasticity", "backlash"):
        _part_motor(spec, cause)


def _part_motor(spec: Any, cause: Cause) -> None:
    """A motor of its own, whose rotor is the joint's armature, and a link that turns about it."""
    p, joint = cause.parameters, spec.joints[cause.index]
    joint.armature = p["motor_inertia_kg_m2"]
    body = joint.parent
    spring = body.add_joint(name="between", axis=joint.axis, type=mujoco.mjtJoint.mjJNT_HINGE)
    if cause.effect == "joint_elasticity":
        spring.stiffness = [p["stiffness_Nm_per_rad"], 0, 0]
        spring.damping = [p["damping_Nm_s_per_rad"], 0, 0]
    else:
        half = p["gap_rad"] / 2
        spring.limited, spring.range = True, [-half, half]
        spring.solref_limit = [0.004, 0.7]


class Drive:
    """What becomes of a command between log and motor, step by step of the engine."""

    def __init__(self, cause: Cause | None) -> None:
        self.cause = cause
        self.past = [0.0] * 400
        self.lagged = 0.0

    def voltage(self, command: list[float], step_s: float, q: list[float]) -> list[float]:
        """Voltages at the three motors in a step."""
        cause, out = self.cause, list(command)
        if cause is None or cause.joint == 0:
            return out
        out[cause.index] = self._changed(cause, out[cause.index], step_s, q[cause.index])
        return out

    def _changed(self, cause: Cause, u: float, step_s: float, q: float) -> float:
        p = cause.parameters
        match cause.effect:
            case "dac_offset":
                return u + p["offset_V"]
            case "saturation":
                return min(max(u, -p["limit_V"]), p["limit_V"])
            case "dead_zone":
                return math.copysign(max(abs(u) - p["half_width_V"], 0.0), u)
            case "torque_ripple":
                return u * (1 + p["relative_amplitude"] * _wave(p, q))
            case "actuator_lag":
                decay = math.exp(-step_s / p["time_constant_s"])
                self.lagged = u + (self.lagged - u) * decay
                return self.lagged
            case "delay":
                self.past = [u, *self.past[:-1]]
                return self.past[round(p["delay_s"] / step_s)]
        return u


def _wave(p: dict[str, Any], q: float) -> float:
    return math.sin(p["harmonic"] * q + p["phase_rad"])


def torque(cause: Cause, q: float, v: float, coulomb: float, viscous: float) -> float:
    """Torque that a cause adds to its joint [Nm], of friction's own two parameters there."""
    p, k = cause.parameters, cause.k
    match cause.effect:
        case "cogging":
            return k * p["amplitude_V"] * _wave(p, q)
        case "cable_spring":
            return -k * p["stiffness_V_per_rad"] * (q - p["rest_rad"])
        case "quadratic_drag":
            return -k * p["coefficient_V_s2_per_rad2"] * v * abs(v)
        case "asymmetric_friction":
            return -p["relative_asymmetry"] * (coulomb + viscous * abs(v))
    return 0.0


def friction(cause: Cause, q: float, load: float, time_s: float) -> tuple[float, float, float]:
    """Factor on friction's level, torque added to it [Nm], factor on its viscous part."""
    p = cause.parameters
    match cause.effect:
        case "position_friction":
            return 1 + p["relative_amplitude"] * _wave(p, q), 0.0, 1.0
        case "load_friction":
            return 1.0, cause.k * p["coefficient_V_per_Nm"] * abs(load), 1.0
        case "friction_drift":
            grown = 1 + p["relative_change"] * (1 - math.exp(-time_s / p["time_constant_s"]))
            return grown, 0.0, grown
    return 1.0, 0.0, 1.0


WHILE_MOVING = ("cogging", "cable_spring", "quadratic_drag", "asymmetric_friction")
OF_FRICTION = ("position_friction", "load_friction", "friction_drift")