#!/usr/bin/env python3
"""Compares what each cause does to recorded commands with its definition in docs/effects.md.

Along the recorded motion of a robot without model errors, the command less that of the robot is
regressed on what the definition adds. Sign and size are right where the coefficient is near 1.
"""

import argparse
from types import SimpleNamespace

import numpy as np

from cases import LAWS, Case
from causes import Cause
from gap import _low_pass
from links import A2, A3, D2, D3, GRAVITY, NAMES, Link, base_parameters
from motions import PERIOD
from plant import COUNTS_PER_RAD
from regressor import inverse_dynamics
from robot import TORQUE_CONSTANT

MOTION_HZ, COMMAND_HZ = 60.0, 15.0
WAVE = {"harmonic": 5, "phase_rad": 0.7}
TILT = {"tilt_x_rad": 0.05, "tilt_y_rad": -0.08}
FORCE = np.array([2.0, -3.0, 1.5])
TOLERANCE = 0.12
"""On the coefficient of 1: friction at rest, lags and the hidden moments of a tilt are not in the
definitions' plain forms."""


def _wave(m):
    return np.sin(WAVE["harmonic"] * m.q + WAVE["phase_rad"])


def _payload(m):
    none = Link(0.0, np.zeros(3), np.zeros((3, 3)))
    load = Link(0.3, np.zeros(3), np.zeros((3, 3)))
    base = base_parameters((none, none, load), np.zeros(3))
    return inverse_dynamics(base, m.all_q, m.all_v, m.all_a) / TORQUE_CONSTANT


def _in_arm_frame(m, vector):
    s1, c1 = np.sin(m.all_q[:, 0]), np.cos(m.all_q[:, 0])
    return c1 * vector[0] + s1 * vector[1], c1 * vector[1] - s1 * vector[0], vector[2]


def _tip_force(m):
    along, across, up = _in_arm_frame(m, FORCE)
    q2, q23 = m.all_q[:, 1], m.all_q[:, 1] + m.all_q[:, 2]
    reach, height = A2 * np.cos(q2) + A3 * np.cos(q23), A2 * np.sin(q2) + A3 * np.sin(q23)
    fore = A3 * (np.cos(q23) * up - np.sin(q23) * along)
    torque = [(D2 + D3) * along + reach * across, reach * up - height * along, fore]
    return -np.stack(torque, axis=1) / TORQUE_CONSTANT


def _base_tilt(m):
    """On joints 2 and 3: on joint 1 moments act that are not among the base parameters."""
    a, b = TILT.values()
    gravity = GRAVITY * np.array([np.sin(b), -np.sin(a) * np.cos(b), 1 - np.cos(a) * np.cos(b)])
    along, _, up = _in_arm_frame(m, gravity)
    p = dict(zip(NAMES, m.base))

    def moment(x, y, angle):
        level, upright = np.cos(angle), np.sin(angle)
        return (x * level - y * upright) * up - (x * upright + y * level) * along

    fore = moment(p["mx3r"], p["my3r"], m.all_q[:, 1] + m.all_q[:, 2])
    arm = moment(p["mx2r"], p["my2r"], m.all_q[:, 1])
    return -np.stack([0 * fore, arm + fore, fore], axis=1) / TORQUE_CONSTANT


CHECKS = [
    (Cause("cogging", 2, {"amplitude_V": 0.3, **WAVE}), lambda m: -0.3 * _wave(m)),
    (Cause("torque_ripple", 2, {"relative_amplitude": 0.2, **WAVE}),
     lambda m: -0.2 * m.u * _wave(m)),
    (Cause("quadratic_drag", 3, {"coefficient_V_s2_per_rad2": 0.03}),
     lambda m: 0.03 * m.v * abs(m.v)),
    (Cause("cable_spring", 1, {"stiffness_V_per_rad": 0.3, "rest_rad": 0.4}),
     lambda m: 0.3 * (m.q - 0.4)),
    (Cause("dac_offset", 1, {"offset_V": -0.2}), lambda m: 0.2 + 0 * m.q),
    (Cause("torque_constant", 2, {"relative_error": -0.15}), lambda m: 0.15 * m.u),
    (Cause("dead_zone", 2, {"half_width_V": 0.2}), lambda m: np.clip(m.u, -0.2, 0.2)),
    (Cause("delay", 2, {"delay_s": 0.005}), lambda m: 0.005 * np.gradient(m.u, PERIOD)),
    (Cause("actuator_lag", 2, {"time_constant_s": 0.005}),
     lambda m: 0.005 * np.gradient(m.u, PERIOD)),
    (Cause("asymmetric_friction", 3, {"relative_asymmetry": -0.3}),
     lambda m: -0.3 * (m.coulomb + m.viscous * abs(m.v))),
    (Cause("position_friction", 2, {"relative_amplitude": 0.5, **WAVE}),
     lambda m: 0.5 * m.coulomb * m.sign * _wave(m)),
    (Cause("load_friction", 2, {"coefficient_V_per_Nm": 0.02}),
     lambda m: 0.02 * m.sign * abs(m.load)),
    (Cause("friction_drift", 2, {"relative_change": -0.5, "time_constant_s": 2.0}),
     lambda m: -0.5 * (1 - np.exp(-m.t / 2)) * (m.coulomb * m.sign + m.viscous * m.v)),
    (Cause("payload", 0, {"mass_kg": 0.3}), _payload),
    (Cause("tip_force", 0, {"force_N": FORCE.tolist()}), _tip_force),
    (Cause("base_tilt", 0, TILT), _base_tilt),
]
"""Causes with what they add to the command [V]: of their joint, or n x 3."""


def _motion(recording, case, joint):
    """Motion, command and friction of a log at its joint, and what the robot leaves of it."""
    q = _low_pass(recording.counts / COUNTS_PER_RAD, MOTION_HZ)
    v = np.gradient(q, PERIOD, axis=0)
    a, own = np.gradient(v, PERIOD, axis=0), max(joint, 1) - 1
    cut = (len(recording.command) - len(q)) // 2
    u = recording.command.copy()
    u[1:] = 0.5 * (u[1:] + u[:-1])
    u, base, friction = u[cut : cut + len(q)], case.robot.base, case.robot.friction
    sign = np.tanh(v / 0.02)
    model = inverse_dynamics(base, q, v, a) / TORQUE_CONSTANT
    model += friction[:, 0] * sign + friction[:, 3] * v
    load = inverse_dynamics(base, q, v, 0 * v)[:, own]
    return SimpleNamespace(
        all_q=q, all_v=v, all_a=a, q=q[:, own], v=v[:, own], u=u[:, own], sign=sign[:, own],
        t=(np.arange(len(q)) + cut) * PERIOD, coulomb=friction[own, 0], viscous=friction[own, 3],
        load=load, base=base, left=u - model,
    )


def coefficient(case, cause, definition):
    """What of the definition is found in the commands: 1 where it is right."""
    found = size = 0.0
    for recording in case.record([cause]):
        m = _motion(recording, case, cause.joint)
        joints = {0: [1, 2] if cause.effect == "base_tilt" else [0, 1, 2]}
        left = m.left[:, joints.get(cause.joint, [cause.joint - 1])]
        added = definition(m)
        added = added[:, None] if added.ndim == 1 else added[:, joints[0]]
        left, added = (_low_pass(x, COMMAND_HZ)[300:] for x in (left, added))
        found, size = found + (left * added).sum(), size + (added**2).sum()
    return found / size


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--friction", choices=LAWS, default="tanh")
    law = parser.parse_args().friction
    options = {"seed": 3, "kind": "none", "friction": law, "model_error": 0.0, "seconds": 24.0}
    case, wrong = Case(SimpleNamespace(**options), 1), []
    for cause, definition in CHECKS:
        value = coefficient(case, cause, definition)
        print(f"{cause.effect}: {value:.3f}", flush=True)
        wrong += [cause.effect] if abs(value - 1) > TOLERANCE else []
    assert not wrong, wrong


if __name__ == "__main__":
    main()
