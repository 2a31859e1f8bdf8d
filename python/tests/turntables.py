"""A fleet of turntables for the tests: robots of one joint, simulated all at once.

A joint under a PD loop at 250 Hz with LuGre friction, as docs/model.md has it, and 16 bits of encoder.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fleet_robots import FRICTION, KINDS, RATE_HZ, model
from numpy.typing import NDArray

from rrr.toml_text import toml_text

Array = NDArray[np.float64]
STEPS = 20
"""Steps of integration in a sample."""
SECONDS = 8.0
NOISE_V = 0.002
COUNT_RAD = 2 * np.pi / 65536
PLANS = (("slow", 0.3, "train"), ("fast", 1.1, "train"), ("task", 0.7, "holdout"))
"""Logs: name, fastest sine of the reference [Hz], role."""


@dataclass
class Ills:
    """What is hidden, by robot: an offset of the command, cogging of order 7 [V]."""

    offset_v: Array
    cogging_v: Array


def write(place: Path, ills: Ills, batches: list[str], seed: int) -> None:
    """A fleet's INPUT: robots r0, r1, ... with their batches, and one model."""
    rng = np.random.default_rng(seed)
    inertias = _inertia() * (1 + 0.02 * rng.standard_normal(len(batches)))
    for name, fastest_hz, _ in PLANS:
        t, q, u = _recorded(fastest_hz, inertias, ills, rng)
        for robot in range(len(batches)):
            folder = place / f"r{robot}"
            folder.mkdir(parents=True, exist_ok=True)
            table = np.column_stack([t, q[:, robot], u[:, robot]])
            np.savetxt(folder / f"{name}.csv", table, "%.9g", ",", header="t_s,q1_rad,u1_V", comments="")
    entries = [f'[[log]]\nfile = "{n}.csv"\nexperiment = "task"\nrole = "{r}"\n' for n, _, r in PLANS]
    for robot in range(len(batches)):
        (place / f"r{robot}" / "dataset.toml").write_text("format = 1\n" + "".join(entries))
    (place / "model.toml").write_text(toml_text(model("turntable")))
    lines = [f"r{robot},{batch}" for robot, batch in enumerate(batches)]
    (place / "fleet.csv").write_text("\n".join(["robot,batch", *lines]) + "\n")


def _inertia() -> float:
    joint = KINDS["turntable"][0]
    own = joint["mass_kg"] * joint["com_m"][0] ** 2 + joint["inertia_kg_m2"][5]
    return float(own + joint["armature_kg_m2"])


def _recorded(
    fastest_hz: float, inertias: Array, ills: Ills, rng: np.random.Generator
) -> tuple[Array, Array, Array]:
    """Times (m,), positions and commands (m, robots)."""
    constant = KINDS["turntable"][0]["drive"]["torque_constant_Nm_per_V"]
    t = np.arange(int(SECONDS * RATE_HZ)) / RATE_HZ
    reference = _reference(t, fastest_hz, rng)
    q, v, bristle = (np.zeros(len(inertias)) for _ in range(3))
    q += reference[0]
    angles, commands = np.empty((len(t), len(q))), np.empty((len(t), len(q)))
    speeds = np.gradient(reference, t)
    for sample in range(len(t)):
        angles[sample] = COUNT_RAD * np.round(q / COUNT_RAD)
        u = 12.0 * (reference[sample] - angles[sample]) + 1.2 * (speeds[sample] - v)
        commands[sample] = u
        acted = u + ills.offset_v + NOISE_V * rng.standard_normal(len(q))
        for _ in range(STEPS):
            q, v, bristle = _step(q, v, bristle, acted, ills, inertias / constant)
    return t, angles, commands


def _step(q: Array, v: Array, bristle: Array, u: Array, ills: Ills, inertia: Array) -> tuple[Array, ...]:
    dt = 1 / RATE_HZ / STEPS
    stribeck = np.exp(-((v / FRICTION["stribeck_velocity_rad_per_s"]) ** 2))
    level = FRICTION["alpha0_V"] + FRICTION["alpha1_V"] * stribeck
    # Implicit, for bristles are much faster than a step.
    bent = (bristle + dt * v) / (1 + dt * FRICTION["sigma0_V_per_rad"] * np.abs(v) / level)
    rate = (bent - bristle) / dt
    friction = FRICTION["sigma0_V_per_rad"] * bent + FRICTION["sigma1_V_s_per_rad"] * rate
    drive = u + ills.cogging_v * np.sin(7 * q + 0.5) - friction - FRICTION["alpha2_V_s_per_rad"] * v
    v = v + dt * drive / inertia
    return q + dt * v, v, bent


def _reference(t: Array, fastest_hz: float, rng: np.random.Generator) -> Array:
    """Five sines over most of a turn."""
    sines = [
        np.sin(2 * np.pi * fastest_hz * part * t + phase) / (1 + 2 * part)
        for part, phase in zip((0.2, 0.37, 0.55, 0.8, 1.0), rng.uniform(-3, 3, 5), strict=True)
    ]
    whole: Array = np.sum(sines, axis=0)
    return 2.5 * whole / np.abs(whole).max()
