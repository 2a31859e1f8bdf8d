"""A case of seven geared axes under currents, of whose commands its log keeps one of several.

A robot's controller runs at 1 kHz, and its log often at 125 Hz: a row holds the command of its own
instant, not the mean until the next. The links are like those of a well known arm for research,
friction is MuJoCo's (`frictionloss`, `damping`), and nothing of it is LuGre.
"""

import argparse
import math
import shutil
from pathlib import Path

import mujoco
import numpy as np

COUNTS_PER_REV = 2**19
NM_PER_A = 10.0
QUARTER = math.pi / 2
ORIGINS = [(0, 0, 0.333), (0, 0, 0), (0, -0.316, 0), (0.0825, 0, 0), (-0.0825, 0.384, 0), (0, 0, 0), (0.088, 0, 0)]
TURNS_ABOUT_X = [0, -QUARTER, QUARTER, QUARTER, -QUARTER, QUARTER, QUARTER]
MASSES_KG = [4.97, 2.4, 3.23, 3.59, 1.8, 1.67, 0.74]
CENTRES_M = [
    (0.004, 0.002, -0.05), (-0.003, -0.028, 0.0035), (0.0275, 0.039, -0.066), (-0.053, 0.104, 0.027),
    (-0.012, 0.041, -0.038), (0.06, -0.014, -0.01), (0.01, -0.004, 0.061),
]  # fmt: skip
INERTIAS_KG_M2 = [
    (0.05, 0.05, 0.01), (0.012, 0.012, 0.012), (0.02, 0.02, 0.01), (0.025, 0.02, 0.028),
    (0.02, 0.018, 0.006), (0.005, 0.006, 0.007), (0.004, 0.004, 0.003),
]  # fmt: skip
ROTORS_KG_M2 = [0.35, 0.35, 0.3, 0.3, 0.15, 0.12, 0.08]
COULOMB_NM = np.array([0.6, 0.8, 0.5, 0.7, 0.4, 0.3, 0.3])
VISCOUS_NM_S = np.array([1.2, 1.3, 0.9, 1.0, 0.5, 0.5, 0.35])
HOME_RAD = np.array([0, -0.4, 0, -1.9, 0, 1.7, 0.4])
REACH_RAD = np.array([0.9, 0.5, 0.8, 0.5, 0.9, 0.7, 0.9])
STIFFNESS = np.array([600, 600, 500, 500, 250, 150, 60.0])
DAMPING = np.array([40, 40, 35, 35, 15, 10, 4.0])
PERIOD_S = 1e-3
LOGS = [  # name, experiment, role, duration [s], lowest frequency [Hz], terms, part of the reach
    ("excitation", "excitation", "train", 20, 0.1, 5, 1.0),
    ("excitation-2", "excitation", "train", 20, 0.12, 5, 1.0),
    ("slow", "slow", "train", 25, 0.06, 2, 0.5),
    ("task", "task", "holdout", 20, 0.09, 4, 0.8),
    ("excitation-3", "excitation", "holdout", 20, 0.11, 5, 1.0),
]
PAYLOAD_AT_M = (0, 0, 0.2)


def scene(payload_kg):
    """MuJoCo's XML of the arm, with a load in its hand."""
    text, close = "", ""
    for k, (origin, turn) in enumerate(zip(ORIGINS, TURNS_ABOUT_X)):
        text += (
            f'<body pos="{_xml(origin)}" euler="{turn} 0 0"><joint name="q{k + 1}" axis="0 0 1" '
            f'armature="{ROTORS_KG_M2[k]}" damping="{VISCOUS_NM_S[k]}" '
            f'frictionloss="{COULOMB_NM[k]}"/><inertial mass="{MASSES_KG[k]}" '
            f'pos="{_xml(CENTRES_M[k])}" diaginertia="{_xml(INERTIAS_KG_M2[k])}"/>'
        )
        close += "</body>"
    if payload_kg > 0:
        text += f'<body pos="{_xml(PAYLOAD_AT_M)}"><inertial mass="{payload_kg}" pos="0 0 0" '
        text += 'diaginertia="0.001 0.001 0.001"/></body>'
    option = '<option timestep="0.0005" integrator="implicitfast" gravity="0 0 -9.81"/>'
    return (
        f'<mujoco><compiler angle="radian"/>{option}<worldbody>{text}{close}</worldbody></mujoco>'
    )


def _xml(values):
    return " ".join(str(value) for value in values)


def series(rng, duration_s, lowest_hz, terms, reach_rad):
    """A Fourier series about the home position, at every period of the controller [rad]."""
    order = np.arange(1, terms + 1)
    time = np.arange(0, duration_s + PERIOD_S, PERIOD_S)
    angle = 2 * np.pi * lowest_hz * np.outer(time, order)
    sines, cosines = rng.standard_normal((2, len(ORIGINS), terms)) / order
    swing = np.sin(angle) @ sines.T + (np.cos(angle) - 1) @ cosines.T
    fade_in = np.minimum(time, 1.0)[:, None]
    return HOME_RAD + fade_in * swing * reach_rad / np.abs(swing).max(axis=0)


def recorded(model, reference, keep_one_of):
    """Plays a reference under PD and gravity's torque; time, angles [rad], currents [A] by row."""
    data = mujoco.MjData(model)
    data.qpos[:] = HOME_RAD
    mujoco.mj_forward(model, data)
    rows = []
    for k in range(len(reference) - 1):
        counts = np.floor(data.qpos * COUNTS_PER_REV / (2 * np.pi) + 0.5)
        angle = counts * 2 * np.pi / COUNTS_PER_REV
        velocity = (reference[k + 1] - reference[k]) / PERIOD_S
        torque = STIFFNESS * (reference[k] - angle) + DAMPING * (velocity - data.qvel)
        torque += data.qfrc_bias
        if k % keep_one_of == 0:
            rows.append([k * PERIOD_S, *angle, *(torque / NM_PER_A)])
        data.qfrc_applied[:] = torque
        mujoco.mj_step(model, data, nstep=2)
    return np.array(rows)


def model_toml(rng, period_s):
    """The model that a diagnosis is given: masses 3 % off, inertias 5 %, friction 10 %."""
    off = lambda size: 1 + size * rng.standard_normal()  # noqa: E731
    text = 'format = 2\n[robot]\nname = "seven axes"\ngravity_m_s2 = [0.0, 0.0, -9.81]\n'
    text += f"sample_period_s = {period_s}\n"
    for k, (origin, turn) in enumerate(zip(ORIGINS, TURNS_ABOUT_X)):
        xx, yy, zz = (value * off(0.05) for value in INERTIAS_KG_M2[k])
        text += f"""[[joint]]
kind = "revolute"
axis = [0.0, 0.0, 1.0]
origin_xyz_m = {[float(value) for value in origin]}
origin_rpy_rad = [{float(turn)}, 0.0, 0.0]
mass_kg = {MASSES_KG[k] * off(0.03)}
com_m = {[value * off(0.03) for value in CENTRES_M[k]]}
inertia_kg_m2 = [{xx}, 0.0, 0.0, {yy}, 0.0, {zz}]
armature_kg_m2 = {ROTORS_KG_M2[k] * off(0.05)}
drive = {{ kind = "current", torque_constant_Nm_per_A = {NM_PER_A} }}
encoder = {{ counts_per_rev = {COUNTS_PER_REV} }}
[joint.friction]
alpha0_A = {COULOMB_NM[k] / NM_PER_A * off(0.1)}
alpha2_A_s_per_rad = {VISCOUS_NM_S[k] / NM_PER_A * off(0.1)}
"""
    return text


def dataset_toml():
    """The list of the logs."""
    of_log = '[[log]]\nfile = "{0}.csv"\nexperiment = "{1}"\nrole = "{2}"\n'
    return "format = 1\n" + "".join(of_log.format(*log) for log in LOGS)


def write_case(directory, seed, payload_kg, rate_hz):
    """Writes all files of a case beside its place, then puts them there."""
    rng = np.random.default_rng(seed)
    new = directory.with_name(f".{directory.name}")
    shutil.rmtree(new, ignore_errors=True)
    new.mkdir(parents=True)
    keep_one_of = round(1 / (PERIOD_S * rate_hz))
    model = mujoco.MjModel.from_xml_string(scene(payload_kg))
    joints = range(1, len(ORIGINS) + 1)
    columns = ["t_s", *(f"q{k}_rad" for k in joints), *(f"u{k}_A" for k in joints)]
    for name, _, _, duration_s, lowest_hz, terms, part in LOGS:
        reference = series(rng, duration_s, lowest_hz, terms, part * REACH_RAD)
        rows = recorded(model, reference, keep_one_of)
        file = new / f"{name}.csv"
        np.savetxt(file, rows, "%.9g", ",", header=",".join(columns), comments="")
    (new / "model.toml").write_text(model_toml(rng, keep_one_of * PERIOD_S))
    (new / "dataset.toml").write_text(dataset_toml())
    shutil.rmtree(directory, ignore_errors=True)
    new.rename(directory)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="directory of the case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--payload", type=float, default=0.0, help="load in the hand [kg]")
    parser.add_argument("--rate", type=int, default=125, help="rows per second")
    arguments = parser.parse_args()
    write_case(arguments.out, arguments.seed, arguments.payload, arguments.rate)


if __name__ == "__main__":
    main()
