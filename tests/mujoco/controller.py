"""The board of this rig: PD on encoder counts once a millisecond, and the logs that it makes."""

from dataclasses import dataclass

import numpy as np

from motions import PERIOD
from plant import COUNTS_PER_RAD
from regressor import gravity_torque, mass_matrix
from robot import TORQUE_CONSTANT

STEP_V = 20.0 / 65536
"""Of the converter: 16 bits for +-10 V."""
LOOP_HZ, DAMPING_RATIO = np.array([4.0, 4.0, 5.5]), 0.7
"""Of each joint's loop, with the inertia of the stretched arm."""
NOISE_V = 0.006
"""Torque noise of a tick [V], on top of the command and not in the log."""
FAST = 0.5
"""How much of a new difference of counts goes into the measured speed at once."""


@dataclass
class Recording:
    """A log: counts n x 3, command [V] n x 3, reference [rad] n x 3."""

    plan: object
    counts: np.ndarray
    command: np.ndarray

    def is_tame(self, other=None):
        """Whether the arm followed, about as well as in the other recording."""
        error = self.counts / COUNTS_PER_RAD - self.plan.reference
        if not np.isfinite(error).all() or np.abs(error).max() > 1.2:
            return False
        limited = (np.abs(self.command) > 9.99).mean()
        return limited < 0.01 and (other is None or error.std() < 5 * other.error_rms() + 0.1)

    def error_rms(self):
        """Of following the reference [rad]."""
        return (self.counts / COUNTS_PER_RAD - self.plan.reference).std()


class Controller:
    """u = kp (qref - q) + kd (qdref - qd) + the model's gravity, or without it."""

    def __init__(self, base, compensates):
        inertia = np.array([_stretched_inertia(base, joint) for joint in range(3)])
        omega = 2 * np.pi * LOOP_HZ
        self.kp = (inertia / TORQUE_CONSTANT * omega**2).tolist()
        self.kd = (inertia / TORQUE_CONSTANT * 2 * DAMPING_RATIO * omega).tolist()
        self.base, self.compensates = base, compensates

    def feedforward(self, plan):
        """The part of the command that is known before: injected noise and gravity, n x 3 [V]."""
        if not self.compensates:
            return plan.added
        torque = gravity_torque(self.base, plan.reference[:, 1], plan.reference[:, 2])
        return plan.added + torque.T / TORQUE_CONSTANT


def _stretched_inertia(base, joint):
    return mass_matrix(base, np.zeros(1), np.zeros(1))[joint, joint, 0]


def record(plant, controller, plan, rng):
    """Plays a plan; the noise comes from `rng`."""
    noise = (NOISE_V * rng.standard_normal(plan.reference.shape)).tolist()
    known = controller.feedforward(plan).tolist()
    reference = plan.reference.tolist()
    speed_ref = np.gradient(plan.reference, PERIOD, axis=0).tolist()
    kp, kd = controller.kp, controller.kd
    plant.start(plan.reference[0])
    counts, commands = [], []
    last, speed = plant.counts(), [0.0, 0.0, 0.0]
    for row in range(len(reference)):
        now = plant.counts()
        command = []
        for i in range(3):
            speed[i] += FAST * ((now[i] - last[i]) / COUNTS_PER_RAD / PERIOD - speed[i])
            u = kp[i] * (reference[row][i] - now[i] / COUNTS_PER_RAD)
            u += kd[i] * (speed_ref[row][i] - speed[i]) + known[row][i]
            command.append(STEP_V * min(max(round(u / STEP_V), -32768), 32767))
        last = now
        counts.append(now)
        commands.append(command)
        plant.advance([u + n for u, n in zip(command, noise[row])], row * PERIOD)
    return Recording(plan, np.array(counts), np.array(commands))
