"""The robot of a trial, recorded: PD control on a coarse encoder at 1 kHz, noisy amplifiers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from arm import PERIOD_S, STEPS
from causes import OF_FRICTION, WHILE_MOVING, Cause, Drive, friction, put_in, torque
from numpy.typing import NDArray

import rrr

Array = NDArray[np.float64]
COUNT_RAD = 2 * np.pi / 655360
NOISE_V = 0.004
"""Of the amplifiers, rms of a tick; not in the log."""
GAINS = np.array([[12.0, 1.4], [14.0, 1.5], [16.0, 1.0]])
"""V/rad and V s/rad of each loop."""


@dataclass
class Recording:
    """A log with what nobody sees of it: n x 3 states and the voltages that acted."""

    log: rrr.Log
    q: Array
    qd: Array
    acted: Array


class Robot:
    """A robot in the engine, with its cause."""

    def __init__(self, spec: Any, cause: Cause | None) -> None:
        if cause is not None:
            put_in(spec, cause)
        self.cause = cause
        self.m = spec.compile()
        self.d = mujoco.MjData(self.m)
        names = ("turn", "shoulder", "elbow")
        self.dofs = [int(self.m.joint(name).dofadr[0]) for name in names]
        self.friction = [
            (float(self.m.dof_frictionloss[dof]), float(self.m.dof_damping[dof])) for dof in self.dofs
        ]

    def start(self, q: Array) -> None:
        """At rest at three angles [rad]."""
        mujoco.mj_resetData(self.m, self.d)
        self.d.qpos[self.dofs] = q
        self.drive = Drive(self.cause)
        if self.cause is not None and self.cause.effect == "tip_force":
            body = int(self.m.body("lower").id)
            self.tip_force = (body, np.array(self.cause.parameters["force_N"]))
        mujoco.mj_forward(self.m, self.d)

    def advance(self, voltage: Array, time_s: float) -> None:
        """A period with three voltages [V]."""
        step_s = PERIOD_S / STEPS
        for step in range(STEPS):
            self._put_forces(time_s + step * step_s)
            q = [float(self.d.qpos[dof]) for dof in self.dofs]
            self.d.ctrl[:] = self.drive.voltage(voltage.tolist(), step_s, q)
            mujoco.mj_step(self.m, self.d)

    def _put_forces(self, time_s: float) -> None:
        cause, d = self.cause, self.d
        if cause is None:
            return
        if cause.effect == "tip_force":
            body, force = self.tip_force
            d.qfrc_applied[:] = 0
            place = d.xpos[body].copy()
            mujoco.mj_applyFT(self.m, d, force, np.zeros(3), place, body, d.qfrc_applied)
        elif cause.effect in WHILE_MOVING:
            dof = self.dofs[cause.index]
            state = float(d.qpos[dof]), float(d.qvel[dof])
            d.qfrc_applied[dof] = torque(cause, *state, *self.friction[cause.index])
        elif cause.effect in OF_FRICTION:
            dof = self.dofs[cause.index]
            coulomb, viscous = self.friction[cause.index]
            load = float(d.qfrc_bias[dof])
            level, added, scale = friction(cause, float(d.qpos[dof]), load, time_s)
            self.m.dof_frictionloss[dof] = max(coulomb * level + added, 0.0)
            self.m.dof_damping[dof] = viscous * scale


def record(robot: Robot, plan: tuple[str, str, Array, Array], rng: np.random.Generator) -> Recording:
    """Plays a plan (experiment, role, reference n x 3 [rad], added command n x 3 [V])."""
    experiment, role, reference, added = plan
    speed = np.gradient(reference, PERIOD_S, axis=0)
    noise = NOISE_V * rng.standard_normal(reference.shape)
    robot.start(reference[0])
    rows = len(reference)
    q, qd, seen, command, acted = (np.empty((rows, 3)) for _ in range(5))
    before, filtered = np.round(reference[0] / COUNT_RAD) * COUNT_RAD, np.zeros(3)
    for k in range(rows):
        q[k], qd[k] = robot.d.qpos[robot.dofs], robot.d.qvel[robot.dofs]
        seen[k] = np.round(q[k] / COUNT_RAD) * COUNT_RAD
        filtered += 0.5 * ((seen[k] - before) / PERIOD_S - filtered)
        before = seen[k]
        u = GAINS[:, 0] * (reference[k] - seen[k]) + GAINS[:, 1] * (speed[k] - filtered) + added[k]
        command[k] = np.round(np.clip(u, -10, 10) * 3276.8) / 3276.8
        acted[k] = command[k] + noise[k]
        robot.advance(acted[k], k * PERIOD_S)
    log = rrr.Log(
        np.arange(rows) * PERIOD_S, seen, command, reference, role=role, experiment=experiment  # type: ignore[arg-type]
    )
    return Recording(log, q, qd, acted)


def plans(rng: np.random.Generator, scale: float = 1.0) -> list[tuple[str, str, Array, Array]]:
    """Fast, slow and shaken motion to learn from, another motion to confirm on: 54 s times `scale`."""
    fast = _series(rng, 16 * scale, 8.0, [4.5, 5.5, 7.0])
    slow = _series(rng, 14 * scale, 14.0, [0.6, 1.0, 1.8])
    shaken = _series(rng, 10 * scale, 10.0, [1.0, 1.4, 2.5])
    task = _series(rng, 14 * scale, 7.0, [3.0, 4.0, 5.5])
    none = np.zeros_like
    return [
        ("excitation", "train", fast, none(fast)),
        ("slow", "train", slow, none(slow)),
        ("driven-noise", "train", shaken, _noise(rng, len(shaken)) * [0.6, 0.9, 0.6]),
        ("task", "holdout", task, none(task)),
    ]


def _series(rng: np.random.Generator, duration_s: float, period_s: float, peak: list[float]) -> Array:
    """A Fourier series of five terms on all joints, with these peak velocities [rad/s]."""
    time = np.arange(round(duration_s / PERIOD_S)) * PERIOD_S
    order = np.arange(1, 6)
    angle = 2 * np.pi / period_s * np.outer(time, order)
    reference = np.empty((len(time), 3))
    fade = np.clip(time / 1.5, 0, 1)
    fade = fade**3 * (10 + fade * (6 * fade - 15))
    for joint, centre in enumerate((0.0, -1.2, 0.3)):
        a, b = rng.standard_normal((2, 5)) / order
        whole = np.sin(angle) @ a + np.cos(angle) @ b
        size = peak[joint] / (np.abs(np.diff(whole)).max() / PERIOD_S)
        reference[:, joint] = centre + size * whole * fade
    return reference


def _noise(rng: np.random.Generator, rows: int) -> Array:
    """Noise up to 200 Hz, rms one, rows x 3."""
    spectrum = np.fft.rfft(rng.standard_normal((rows, 3)), axis=0)
    spectrum[np.fft.rfftfreq(rows, PERIOD_S) > 200.0] = 0
    noise: Array = np.fft.irfft(spectrum, rows, axis=0)
    return noise / noise.std(axis=0)

