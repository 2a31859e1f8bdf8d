"""The robots of the fleet's trial: their models, what is hidden in some, and their logs.

Every robot is 2 % off the model of its kind in masses, inertias and friction. Logs are those of
`rrr simulate --dataset gap`: four of 20 s, of which the last confirms.
"""

from __future__ import annotations

import copy
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rrr.toml_text import toml_text

ERROR = 0.02
"""How far a robot is off its model, rms, in parts."""
SCATTER = 0.1
"""How far the sizes of a batch's common cause scatter, in parts."""
VARIED = ("mass_kg", "com_m", "inertia_kg_m2", "armature_kg_m2")
RATE_HZ = 250.0

FRICTION = {
    "alpha0_V": 0.2,
    "alpha1_V": 0.05,
    "stribeck_velocity_rad_per_s": 0.02,
    "alpha2_V_s_per_rad": 0.1,
    "sigma0_V_per_rad": 400.0,
    "sigma1_V_s_per_rad": 2.0,
}


def _joint(mass: float, com: float, armature: float, constant: float, **more: Any) -> dict[str, Any]:
    return {
        "kind": "revolute",
        "axis": [0.0, 1.0, 0.0],
        "mass_kg": mass,
        "com_m": [com, 0.0, 0.0],
        "inertia_kg_m2": [mass * r * com**2 for r in (0.1, 0.0, 0.0, 0.4, 0.0, 0.4)],
        "armature_kg_m2": armature,
        "limits_rad": [-3.0, 3.0],
        "drive": {"kind": "voltage", "torque_constant_Nm_per_V": constant, "limit_V": 12.0},
        "encoder": {"counts_per_rev": 65536},
        "friction": dict(FRICTION),
        **more,
    }


KINDS = {
    "swing": [_joint(1.0, 0.2, 0.01, 1.0)],
    "turntable": [_joint(2.0, 0.15, 0.03, 1.5, axis=[0.0, 0.0, 1.0])],
    "twin": [_joint(1.2, 0.15, 0.02, 2.0), _joint(0.6, 0.15, 0.01, 1.0, origin_xyz_m=[0.3, 0.0, 0.0])],
}
"""Joints of each kind of robot."""


@dataclass(frozen=True)
class Hidden:
    """What a robot has that its model has not."""

    effect: str
    joint: int
    parameters: dict[str, float] = field(hash=False)

    @property
    def argument(self) -> str:
        """As `rrr simulate --effect` takes it."""
        values = ",".join(f"{name}={value:.6g}" for name, value in self.parameters.items())
        return f"{self.effect}:{self.joint}:{values}"


SIZES: dict[str, dict[str, float]] = {
    "cogging": {"amplitude_V": 0.03, "harmonic": 7, "phase_rad": 0.5},
    "torque_ripple": {"relative_amplitude": 0.04, "harmonic": 6, "phase_rad": 1.0},
    "delay": {"delay_s": 0.004},
    "dac_offset": {"offset_V": 0.03},
    "asymmetric_friction": {"relative_asymmetry": 0.1},
    "cable_spring": {"stiffness_V_per_rad": 0.04, "rest_rad": 0.3},
    "dead_zone": {"half_width_V": 0.05},
    "position_friction": {"relative_amplitude": 0.15, "harmonic": 2, "phase_rad": 0.7},
    "quadratic_drag": {"coefficient_V_s2_per_rad2": 0.03},
    "friction_drift": {"relative_change": 0.25, "time_constant_s": 8.0},
}
"""Causes that are hidden, with their smallest sizes; the largest are twice these."""
SIZE = {name: next(iter(values)) for name, values in SIZES.items()}


def drawn(effect: str, joint: int, rng: np.random.Generator) -> Hidden:
    """A cause of a size up to twice the smallest; phases anywhere."""
    values = dict(SIZES[effect])
    values[SIZE[effect]] *= float(2 ** rng.uniform())
    if "phase_rad" in values:
        values["phase_rad"] = float(rng.uniform(-3, 3))
    return Hidden(effect, joint, values)


def again(hidden: Hidden, rng: np.random.Generator) -> Hidden:
    """The same cause at another robot of the batch: its size up to scatter, its phase its own."""
    values = dict(hidden.parameters)
    values[SIZE[hidden.effect]] *= float(1 + SCATTER * rng.standard_normal())
    if "phase_rad" in values:
        values["phase_rad"] = float(rng.uniform(-3, 3))
    return Hidden(hidden.effect, hidden.joint, values)


def model(kind: str) -> dict[str, Any]:
    """The model of a kind, as its maker tells it."""
    head = {"name": kind, "gravity_m_s2": [0.0, 0.0, -9.81], "sample_period_s": 1 / RATE_HZ}
    return {"format": 2, "robot": head, "joint": copy.deepcopy(KINDS[kind])}


def robot(kind: str, rng: np.random.Generator, error: float = ERROR) -> dict[str, Any]:
    """A robot of a kind, off its model."""

    def off(value: Any) -> Any:
        if isinstance(value, list):
            return [off(x) for x in value]
        return value * float(1 + error * rng.standard_normal())

    content = model(kind)
    for number, joint in enumerate(content["joint"]):
        own = {name: off(joint[name]) for name in VARIED}
        friction = {name: off(value) for name, value in joint["friction"].items()}
        content["joint"][number] = {**joint, **own, "friction": friction}
    return content


def record(tool: str, content: dict[str, Any], hidden: list[Hidden], seed: int, folder: Path) -> None:
    """Has the command `rrr` record a robot's logs into a folder."""
    truth = folder.with_suffix(".truth.toml")
    truth.parent.mkdir(parents=True, exist_ok=True)
    truth.write_text(toml_text(content))
    command = [tool, "simulate", "--model", str(truth), "--dataset", "gap", "--seed", str(seed)]
    command += [word for h in hidden for word in ("--effect", h.argument)]
    subprocess.run([*command, "--out", str(folder)], check=True, capture_output=True, text=True)
    truth.unlink()
