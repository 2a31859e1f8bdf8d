"""The logs of a case: motions like those that the project's own campaigns play."""

from dataclasses import dataclass, field

import numpy as np

from regressor import inverse_dynamics
from robot import TORQUE_CONSTANT

PERIOD = 1e-3
"""Sample period [s]."""
HANGING = np.array([0.0, -np.pi / 2, 0.0])
LARGEST_COMMAND_V = 7.0
"""Excitations are slowed until the rigid robot needs no more than this [V]."""


@dataclass
class Plan:
    """A log to be recorded: reference [rad] n x 3, added command [V] n x 3."""

    experiment: str
    role: str
    reference: np.ndarray
    added: np.ndarray = field(default=None)
    name: str = ""

    def __post_init__(self):
        self.name = self.name or self.experiment
        if self.added is None:
            self.added = np.zeros_like(self.reference)


def plans(robot, rng, seconds):
    """The five logs of a case: 72 s in all, or as long as `seconds` says."""
    scale = seconds / 72.0
    excitation = [_excitation(robot, rng, duration * scale) for duration in (20.0, 10.0)]
    slow = _series(rng, 20.0 * scale, 20.0, [0.7, 1.2, 2.0])
    moderate = _series(rng, 12.0 * scale, 10.0, [1.0, 1.4, 2.5])
    noise = _noise(rng, len(moderate)) * [0.6, 1.0, 0.6]
    return [
        Plan("excitation", "train", excitation[0]),
        Plan("slow", "train", slow),
        Plan("driven-noise", "train", moderate, noise),
        Plan("task", "holdout", _task(10.0 * scale)),
        Plan("excitation", "holdout", excitation[1], name="excitation-2"),
    ]


def _series(rng, duration, period, peak):
    """A Fourier series of five terms on all joints, with these peak velocities [rad/s]."""
    time = np.arange(round(duration / PERIOD)) * PERIOD
    order = np.arange(1, 6)
    angle = 2 * np.pi / period * np.outer(np.arange(0, period, PERIOD), order)
    reference = np.empty((len(time), 3))
    for joint in range(3):
        a, b = rng.standard_normal((2, 5)) / order
        whole = np.sin(angle) @ a + np.cos(angle) @ b
        size = peak[joint] / (np.abs(np.diff(whole)).max() / PERIOD)
        repeated = np.resize(whole, len(time))
        reference[:, joint] = HANGING[joint] + size * repeated * _fade_in(time)
    return reference


def _fade_in(time, duration=2.0):
    part = np.clip(time / duration, 0, 1)
    return part**3 * (10 - 15 * part + 6 * part**2)


def _excitation(robot, rng, duration):
    """A fast series, slowed down as long as it would need too large a command."""
    peak = np.array([5.5, 7.5, 8.0]) * rng.uniform(0.8, 1.1)
    state = rng.bit_generator.state
    while True:
        rng.bit_generator.state = state
        reference = _series(rng, duration, 10.0, peak)
        if peak_command(robot, reference).max() < LARGEST_COMMAND_V or peak[0] < 0.5:
            return reference
        peak = 0.9 * peak


def peak_command(robot, reference):
    """The largest command of each joint along a reference, friction included [V]."""
    velocity = np.gradient(reference, PERIOD, axis=0)
    acceleration = np.gradient(velocity, PERIOD, axis=0)
    torque = inverse_dynamics(robot.base, reference, velocity, acceleration)
    friction = robot.friction[:, 0] * np.sign(velocity) + robot.friction[:, 3] * velocity
    return np.abs(torque / TORQUE_CONSTANT + friction).max(axis=0)


def _task(duration):
    """A half turn to and fro in 5 s on every joint."""
    time = np.arange(round(duration / PERIOD)) * PERIOD
    wave = np.pi / 2 * np.sin(2 * np.pi * time / 5.0) * _fade_in(time, 1.0)
    return np.array([np.pi / 2, -np.pi / 2, 0.0]) + wave[:, None]


def _noise(rng, rows):
    """Noise up to 200 Hz, rms one, rows x 3."""
    spectrum = np.fft.rfft(rng.standard_normal((rows, 3)), axis=0)
    spectrum[np.fft.rfftfreq(rows, PERIOD) > 200.0] = 0
    noise = np.fft.irfft(spectrum, rows, axis=0)
    return noise / noise.std(axis=0)
