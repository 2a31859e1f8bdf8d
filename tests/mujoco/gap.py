"""How much of the gap between model and robot a cause makes.

A twin is recorded with the same noise and without the cause. Base parameters, Coulomb and viscous
friction are refitted by plain linear least squares with tight priors.
"""

import numpy as np

from motions import PERIOD
from plant import COUNTS_PER_RAD
from regressor import regressor
from robot import TORQUE_CONSTANT

PRIOR = 0.025
"""Relative standard error of every parameter of the model."""
LEAST_PRIOR = 0.002
"""The same in the parameter's unit, for those that are zero."""
REMAINDER_V = 0.03
"""What friction of another law is expected to leave [V]."""
ROWS_A_SECOND, CORRELATED_ROWS = 200, 30
MOTION_HZ, COMMAND_HZ = 120.0, 60.0
CREEP_RAD_PER_S = 0.02
"""Width of Coulomb friction's jump."""


def _low_pass(signal, hz):
    """Zero phase, -6 dB at `hz`; n x k, without what its ends spoil."""
    half = round(1.5 / hz / PERIOD)
    time = np.arange(-half, half + 1) * PERIOD
    kernel = np.sinc(2 * hz * time) * np.blackman(len(time))
    kernel /= kernel.sum()
    columns = [np.convolve(column, kernel, "valid") for column in signal.T]
    return np.array(columns).T


def _rows(recording):
    """Columns n x 3 x 22 and command n x 3 of a log, filtered alike [V]."""
    q = _low_pass(recording.counts / COUNTS_PER_RAD, MOTION_HZ)
    v = np.gradient(q, PERIOD, axis=0)
    columns = np.zeros((len(q), 3, 22))
    columns[:, :, :16] = regressor(q, v, np.gradient(v, PERIOD, axis=0))
    columns[:, :, :16] /= TORQUE_CONSTANT[:, None]
    for joint in range(3):
        columns[:, joint, 16 + joint] = np.tanh(v[:, joint] / CREEP_RAD_PER_S)
        columns[:, joint, 19 + joint] = v[:, joint]
    cut = (len(recording.command) - len(q)) // 2
    # A command acts over the interval that begins at its row: the mean of two is centred.
    command = recording.command.copy()
    command[1:] = 0.5 * (command[1:] + command[:-1])
    command = command[cut : cut + len(q)]
    stride = round(1 / PERIOD / ROWS_A_SECOND)
    flat = _low_pass(columns.reshape(len(q), -1), COMMAND_HZ)[::stride]
    return flat.reshape(-1, 3, 22), _low_pass(command, COMMAND_HZ)[::stride]


class Gap:
    """The rows of a case, and what a model leaves of their commands."""

    def __init__(self, recordings, base, friction):
        parts = [_rows(recording) for recording in recordings]
        self.columns = np.concatenate([part[0] for part in parts])
        self.given = np.concatenate([base, friction[:, 0], friction[:, 3]])
        command = np.concatenate([part[1] for part in parts])
        self.missing = command - self.columns @ self.given

    def refit(self):
        """What is to be added to the 22 parameters."""
        flat = self.columns.reshape(-1, 22)
        weight = 1 / (REMAINDER_V**2 * CORRELATED_ROWS)
        prior = np.maximum(PRIOR * np.abs(self.given), LEAST_PRIOR) ** -2
        normal = weight * flat.T @ flat + np.diag(prior)
        return np.linalg.solve(normal, weight * flat.T @ self.missing.ravel())

    def left(self, change):
        """Mean square of what is left of each joint's command [V^2]."""
        return ((self.missing - self.columns @ change) ** 2).mean(axis=0)


def compare(case, twin, joint):
    """What the cause makes of the gap, on its joint (on all for 0), as truth.json has it."""
    on = slice(None) if joint == 0 else slice(joint - 1, joint)
    clean, nothing = twin.refit(), np.zeros(22)
    pairs = {
        "gap_share": (case.left(clean), twin.left(clean)),
        "gap_share_refitted": (case.left(case.refit()), twin.left(clean)),
        "gap_share_as_given": (case.left(nothing), twin.left(nothing)),
    }
    figures = {
        name: round(float(1 - without[on].sum() / whole[on].sum()), 4)
        for name, (whole, without) in pairs.items()
    }
    whole, without = pairs["gap_share"]
    added = float(np.sqrt(max(whole[on].sum() - without[on].sum(), 0.0)))
    figures["gap_mV"], figures["gap_without_mV"] = _millivolts(whole), _millivolts(without)
    return added, figures


def _millivolts(squares):
    return [round(1e3 * float(np.sqrt(square)), 2) for square in squares]
