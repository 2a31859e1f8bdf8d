"""Causes, and how they are drawn: from small ones of some 20 mV to hundreds of millivolts."""

from dataclasses import dataclass, field

import numpy as np

from robot import TORQUE_CONSTANT


@dataclass
class Cause:
    """A cause on a joint, 1 to 3, or on the whole robot, 0; parameters as in docs/effects.md."""

    effect: str
    joint: int
    parameters: dict = field(default_factory=dict)


def _log_uniform(rng, low, high):
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def _signed(rng, low, high):
    return float(rng.choice([-1, 1])) * _log_uniform(rng, low, high)


def _harmonic(rng, name, low, high, highest):
    order, phase = int(rng.integers(1, highest + 1)), float(rng.uniform(-np.pi, np.pi))
    return {name: _log_uniform(rng, low, high), "harmonic": order, "phase_rad": phase}


def _tip_force(rng, robot, joint, commands):
    direction = rng.standard_normal(3)
    force = _log_uniform(rng, 0.5, 8.0) * direction / np.linalg.norm(direction)
    return {"force_N": force.tolist()}


def _base_tilt(rng, robot, joint, commands):
    size, angle = _log_uniform(rng, 0.01, 0.12), rng.uniform(-np.pi, np.pi)
    return {"tilt_x_rad": float(size * np.cos(angle)), "tilt_y_rad": float(size * np.sin(angle))}


def _elasticity(rng, robot, joint, commands):
    """A spring by its resonance with the motor held; the motor is the robot's rotor."""
    motor = float(robot.rotors[joint - 1])
    link = robot.own_inertia(joint) - motor
    frequency = 2 * np.pi * _log_uniform(rng, 8.0, 40.0)
    damping = 2 * _log_uniform(rng, 0.02, 0.1) * link * frequency
    return {
        "stiffness_Nm_per_rad": float(link * frequency**2),
        "damping_Nm_s_per_rad": float(damping),
        "motor_inertia_kg_m2": motor,
    }


def _backlash(rng, robot, joint, commands):
    return {
        "gap_rad": _log_uniform(rng, 1e-3, 3e-2),
        "motor_inertia_kg_m2": float(robot.rotors[joint - 1]),
    }


def _cable_spring(rng, robot, joint, commands):
    rest = [0.0, -np.pi / 2, 0.0][joint - 1] + rng.uniform(-1, 1)
    return {"stiffness_V_per_rad": _log_uniform(rng, 0.02, 0.5), "rest_rad": float(rest)}


def _saturation(rng, robot, joint, commands):
    """A limit that a small part of the commands reaches."""
    reached = _log_uniform(rng, 0.005, 0.06)
    return {"limit_V": float(np.quantile(np.abs(commands[:, joint - 1]), 1 - reached))}


def _one(name, low, high, draw=_log_uniform):
    return lambda rng, robot, joint, commands: {name: draw(rng, low, high)}


def _waves(name, low, high, highest):
    return lambda rng, robot, joint, commands: _harmonic(rng, name, low, high, highest)


DRAWS = {
    "torque_constant": _one("relative_error", 0.03, 0.25, _signed),
    "actuator_lag": _one("time_constant_s", 1e-3, 1.2e-2),
    "delay": lambda rng, *_: {"delay_s": round(_log_uniform(rng, 1e-3, 8e-3), 4)},
    "position_friction": _waves("relative_amplitude", 0.1, 0.6, 12),
    "cogging": _waves("amplitude_V", 0.03, 0.35, 24),
    "torque_ripple": _waves("relative_amplitude", 0.03, 0.3, 24),
    "payload": _one("mass_kg", 0.05, 0.8),
    "tip_force": _tip_force,
    "base_tilt": _base_tilt,
    "joint_elasticity": _elasticity,
    "backlash": _backlash,
    "asymmetric_friction": _one("relative_asymmetry", 0.06, 0.5, _signed),
    "load_friction": lambda rng, robot, joint, commands: {
        "coefficient_V_per_Nm": _log_uniform(rng, 0.03, 0.3) / TORQUE_CONSTANT[joint - 1]
    },
    "friction_drift": lambda rng, *_: {
        "relative_change": _signed(rng, 0.12, 0.7),
        "time_constant_s": float(rng.uniform(2, 10)),
    },
    "cable_spring": _cable_spring,
    "dac_offset": _one("offset_V", 0.03, 0.3, _signed),
    "saturation": _saturation,
    "dead_zone": _one("half_width_V", 0.04, 0.3),
    "encoder_eccentricity": lambda rng, *_: {
        "amplitude_rad": _log_uniform(rng, 1.5e-2, 0.1),
        "phase_rad": float(rng.uniform(-np.pi, np.pi)),
    },
    "quadratic_drag": _one("coefficient_V_s2_per_rad2", 0.003, 0.05),
}
"""Parameters of rng, robot, joint and the commands without the cause, n x 3 [V]."""
WHOLE_ROBOT = {"payload", "tip_force", "base_tilt"}
WITH_ROTOR = {"joint_elasticity", "backlash"}
"""Causes that part the motor from its link, so that the motor needs an inertia of its own."""
FRICTION = {"asymmetric_friction", "position_friction", "load_friction", "friction_drift"}
APART = [
    FRICTION | {"dac_offset", "cable_spring"},
    {"delay", "actuator_lag"},
    {"joint_elasticity", "backlash"},
    {"torque_ripple", "actuator_lag", "delay", "torque_constant", "saturation"},
]
"""Of each of these a joint has at most one."""


def draw_places(rng, count, first=None):
    """Names and joints of different causes that can be told apart; the first may be given."""
    while True:
        names = list(rng.permutation(list(DRAWS)))[:count]
        if first:
            names = [first] + [name for name in names if name != first][: count - 1]
        places = [(str(name), _joint(rng, name)) for name in names]
        if _can_be_told_apart(places):
            return places


def _joint(rng, name):
    return 0 if name in WHOLE_ROBOT else int(rng.integers(1, 4))


def _can_be_told_apart(places):
    if {"payload", "tip_force"} <= {name for name, _ in places}:
        return False
    for group in APART:
        joints = [joint for name, joint in places if name in group]
        if len(set(joints)) < len(joints):
            return False
    return True
