"""Geared arms under currents, of whose commands a log keeps one of several.

A robot's controller runs at 500 Hz or 1 kHz, and its log often at 125 Hz: a row holds the command
of its own instant, not the mean until the next.
"""

import argparse
import math
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

QUARTER = math.pi / 2
LOGS = [  # name, experiment, role, duration [s], lowest frequency [Hz], terms, part of the reach
    ("excitation", "excitation", "train", 20, 0.1, 5, 1.0),
    ("excitation-2", "excitation", "train", 20, 0.12, 5, 1.0),
    ("slow", "slow", "train", 25, 0.06, 2, 0.5),
    ("task", "task", "holdout", 20, 0.09, 4, 0.8),
    ("excitation-3", "excitation", "holdout", 20, 0.11, 5, 1.0),
]


@dataclass(frozen=True)
class GearedArm:
    """An arm, its controller, and how far the model that a diagnosis is given is off it."""

    name: str
    origins_m: list
    turns_rad: list
    axes: list
    masses_kg: list
    centres_m: list
    inertias_kg_m2: list
    rotors_kg_m2: list
    coulomb_nm: np.ndarray
    viscous_nm_s: np.ndarray
    nm_per_a: np.ndarray
    counts_per_rev: int
    home_rad: np.ndarray
    reach_rad: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    period_s: float
    payload_at_m: tuple
    # Standard deviation of the currents that are logged [A].
    noise_a: float = 0.0
    # Friction's torque by angle, velocity, motor's torque and second; else the engine's own.
    friction: Callable | None = None
    engine_step_s: float = 5e-4

    @property
    def joints(self):
        return range(len(self.origins_m))


def scene(arm, payload_kg):
    """MuJoCo's XML of the arm, with a load in its hand."""
    text = ""
    for k in arm.joints:
        own = f'damping="{arm.viscous_nm_s[k]}" frictionloss="{arm.coulomb_nm[k]}"'
        text += (
            f'<body pos="{_xml(arm.origins_m[k])}" euler="{_xml(arm.turns_rad[k])}">'
            f'<joint name="q{k + 1}" axis="{_xml(arm.axes[k])}" armature="{arm.rotors_kg_m2[k]}" '
            f'{own if arm.friction is None else ""}/><inertial mass="{arm.masses_kg[k]}" '
            f'pos="{_xml(arm.centres_m[k])}" diaginertia="{_xml(arm.inertias_kg_m2[k])}"/>'
        )
    if payload_kg > 0:
        text += f'<body pos="{_xml(arm.payload_at_m)}"><inertial mass="{payload_kg}" pos="0 0 0" '
        text += 'diaginertia="0.001 0.001 0.001"/></body>'
    text += "</body>" * len(arm.origins_m)
    step = f'timestep="{arm.engine_step_s}" integrator="implicitfast"'
    option = f'<option {step} gravity="0 0 -9.81"/>'
    return f'<mujoco><compiler angle="radian" eulerseq="XYZ"/>{option}<worldbody>{text}</worldbody></mujoco>'


def _xml(values):
    return " ".join(str(value) for value in values)


def series(arm, rng, duration_s, lowest_hz, terms, reach_rad):
    """A Fourier series about the home position, at every period of the controller [rad]."""
    order = np.arange(1, terms + 1)
    time = np.arange(0, duration_s + arm.period_s, arm.period_s)
    angle = 2 * np.pi * lowest_hz * np.outer(time, order)
    sines, cosines = rng.standard_normal((2, len(arm.origins_m), terms)) / order
    swing = np.sin(angle) @ sines.T + (np.cos(angle) - 1) @ cosines.T
    fade_in = np.minimum(time, 1.0)[:, None]
    return arm.home_rad + fade_in * swing * reach_rad / np.abs(swing).max(axis=0)


def recorded(arm, model, reference, keep_one_of, rng):
    """Plays a reference under PD and gravity's torque; time, angles [rad], currents [A] by row."""
    data = mujoco.MjData(model)
    data.qpos[:] = arm.home_rad
    mujoco.mj_forward(model, data)
    step = 2 * np.pi / arm.counts_per_rev
    rows = []
    for k in range(len(reference) - 1):
        angle = np.floor(data.qpos / step + 0.5) * step
        velocity = (reference[k + 1] - reference[k]) / arm.period_s
        torque = arm.stiffness * (reference[k] - angle) + arm.damping * (velocity - data.qvel)
        torque += data.qfrc_bias
        if k % keep_one_of == 0:
            noise_a = arm.noise_a * rng.standard_normal(len(torque)) if arm.noise_a else 0.0
            rows.append([k * arm.period_s, *angle, *(torque / arm.nm_per_a + noise_a)])
        _hold(arm, model, data, torque, k * arm.period_s)
    return np.array(rows)


def _hold(arm, model, data, torque, second):
    """Plays a period with a torque of the motors."""
    steps = round(arm.period_s / arm.engine_step_s)
    if arm.friction is None:
        data.qfrc_applied[:] = torque
        mujoco.mj_step(model, data, nstep=steps)
        return
    for _ in range(steps):
        data.qfrc_applied[:] = torque - arm.friction(data.qpos, data.qvel, torque, second)
        mujoco.mj_step(model, data)


def model_toml(arm, rng, sample_period_s):
    """The model that a diagnosis is given: masses 3 % off, inertias 5 %, friction 10 %."""
    off = lambda size: 1 + size * rng.standard_normal()  # noqa: E731
    text = f'format = 2\n[robot]\nname = "{arm.name}"\ngravity_m_s2 = [0.0, 0.0, -9.81]\n'
    text += f"sample_period_s = {sample_period_s}\n"
    for k in arm.joints:
        xx, yy, zz = (value * off(0.05) for value in arm.inertias_kg_m2[k])
        text += f"""[[joint]]
kind = "revolute"
axis = {_toml(arm.axes[k])}
origin_xyz_m = {_toml(arm.origins_m[k])}
origin_rpy_rad = {_toml(arm.turns_rad[k])}
mass_kg = {arm.masses_kg[k] * off(0.03)}
com_m = {[float(value * off(0.03)) for value in arm.centres_m[k]]}
inertia_kg_m2 = [{xx}, 0.0, 0.0, {yy}, 0.0, {zz}]
armature_kg_m2 = {arm.rotors_kg_m2[k] * off(0.05)}
drive = {{ kind = "current", torque_constant_Nm_per_A = {arm.nm_per_a[k]} }}
encoder = {{ counts_per_rev = {arm.counts_per_rev} }}
[joint.friction]
alpha0_A = {arm.coulomb_nm[k] / arm.nm_per_a[k] * off(0.1)}
alpha2_A_s_per_rad = {arm.viscous_nm_s[k] / arm.nm_per_a[k] * off(0.1)}
"""
    return text


def _toml(values):
    return [float(value) for value in values]


def _dataset_toml():
    of_log = '[[log]]\nfile = "{0}.csv"\nexperiment = "{1}"\nrole = "{2}"\n'
    return "format = 1\n" + "".join(of_log.format(*log) for log in LOGS)


def write_case(arm, directory, seed, payload_kg, rate_hz):
    """Writes all files of a case beside its place, then puts them there."""
    rng = np.random.default_rng(seed)
    new = directory.with_name(f".{directory.name}")
    shutil.rmtree(new, ignore_errors=True)
    new.mkdir(parents=True)
    keep_one_of = round(1 / (arm.period_s * rate_hz))
    model = mujoco.MjModel.from_xml_string(scene(arm, payload_kg))
    columns = ["t_s", *(f"q{k + 1}_rad" for k in arm.joints), *(f"u{k + 1}_A" for k in arm.joints)]
    for name, _, _, duration_s, lowest_hz, terms, part in LOGS:
        reference = series(arm, rng, duration_s, lowest_hz, terms, part * arm.reach_rad)
        rows = recorded(arm, model, reference, keep_one_of, rng)
        file = new / f"{name}.csv"
        np.savetxt(file, rows, "%.9g", ",", header=",".join(columns), comments="")
    (new / "model.toml").write_text(model_toml(arm, rng, keep_one_of * arm.period_s))
    (new / "dataset.toml").write_text(_dataset_toml())
    shutil.rmtree(directory, ignore_errors=True)
    new.rename(directory)


def write_as_asked(arm, description):
    """Writes the case of an arm that the command line asks for."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--out", type=Path, required=True, help="directory of the case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--payload", type=float, default=0.0, help="load in the hand [kg]")
    parser.add_argument("--rate", type=int, default=125, help="rows per second")
    arguments = parser.parse_args()
    write_case(arm, arguments.out, arguments.seed, arguments.payload, arguments.rate)
