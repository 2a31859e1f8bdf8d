"""A pendulum or an arm of six hobby servos at 50 Hz, whose gears' friction is of nobody's formula.

Friction of each servo has a peak below 0.05 rad/s, grows with the motor's torque, and is viscous by a
power of the velocity; how much is drawn by the seed, and levels differ by a tenth from servo to servo. It
sticks: MuJoCo's dry friction without slip. A load is put into the hand, or the pendulum's mass exchanged.
The model that the diagnosis is given knows Coulomb and viscous friction, and masses 2 % off.
"""

import argparse
import shutil
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

PERIOD_S, ENGINE_STEP_S = 0.02, 5e-4
# A position is read so long after the goal of its row [s].
READ_AFTER_S = 8e-3
LOGS, OF_THEM_TRAIN, LOG_S = 9, 6, 30.0
COUNT_RAD = 2 * np.pi / 4096
NM_PER_V, V_PER_RAD, LIMIT_V = 0.5, 29.0, 10.6
COULOMB_V, VISCOUS_V_S = 0.104, 1.2


@dataclass(frozen=True)
class Link:
    """A link and the joint that moves it."""

    origin_m: tuple
    axis: tuple
    mass_kg: float
    centre_m: tuple
    inertia_kg_m2: tuple
    rotor_kg_m2: float
    reach_rad: float


PENDULUM = [Link((0, 0, 0), (0, 1, 0), 0.35, (0, 0, -0.16), (1e-3, 1e-3, 2e-4), 0.012, 1.1)]
ARM = [
    Link((0, 0, 0.06), (0, 0, 1), 0.11, (0, 0, 0.03), (8e-5, 8e-5, 4e-5), 0.028, 0.8),
    Link((0, 0, 0.055), (0, 1, 0), 0.12, (0, 0.004, 0.08), (2e-4, 2e-4, 4e-5), 0.028, 0.7),
    Link((0, 0, 0.12), (0, 1, 0), 0.10, (0.07, 0, 0), (3e-5, 1.6e-4, 1.5e-4), 0.028, 0.8),
    Link((0.135, 0, 0), (0, 1, 0), 0.08, (0.03, 0, 0), (3e-5, 4e-5, 4e-5), 0.028, 0.8),
    Link((0.06, 0, 0), (1, 0, 0), 0.09, (0.03, 0, 0.004), (3e-5, 5e-5, 5e-5), 0.028, 0.8),
    Link((0.05, 0.02, 0), (0, 0, 1), 0.02, (0.03, 0.01, 0), (1e-5, 2e-5, 2e-5), 0.028, 0.6),
]
HAND_M = (0.05, 0.0, 0.0)


@dataclass(frozen=True)
class Friction:
    """What friction takes of a servo's torque, by joint."""

    coulomb_nm: np.ndarray
    viscous_nm_s: np.ndarray
    peak: float
    by_torque: float
    power: float

    @classmethod
    def drawn(cls, rng, count):
        level = 1.3 + 0.6 * rng.random()
        return cls(
            NM_PER_V * COULOMB_V * level * (1 + 0.1 * rng.standard_normal(count)),
            NM_PER_V * VISCOUS_V_S * (1 + 0.1 * rng.standard_normal(count)),
            peak=0.1 + 0.3 * rng.random(),
            by_torque=0.05 + 0.1 * rng.random(),
            power=0.8 + 0.2 * rng.random(),
        )

    def dry(self, velocity, motor_nm):
        peak = 1 + self.peak * np.exp(-np.abs(velocity) / 0.05)
        return self.coulomb_nm * peak + self.by_torque * np.abs(motor_nm)

    def viscous(self, velocity):
        return self.viscous_nm_s * np.sign(velocity) * np.abs(velocity) ** self.power


def scene(links, load_kg):
    """MuJoCo's XML, with a load in the hand."""
    words = lambda values: " ".join(str(value) for value in values)  # noqa: E731
    text = ""
    for k, link in enumerate(links):
        text += (
            f'<body pos="{words(link.origin_m)}"><joint name="q{k}" axis="{words(link.axis)}" '
            f'armature="{link.rotor_kg_m2}" frictionloss="0.1"/><inertial mass="{link.mass_kg}" '
            f'pos="{words(link.centre_m)}" diaginertia="{words(link.inertia_kg_m2)}"/>'
        )
    if load_kg:
        text += f'<body pos="{words(HAND_M)}"><inertial mass="{load_kg}" pos="0 0 0" '
        text += f'diaginertia="{words([4e-4 * load_kg] * 3)}"/></body>'
    text += "</body>" * len(links)
    option = f'timestep="{ENGINE_STEP_S}" integrator="implicitfast" noslip_iterations="10"'
    return f'<mujoco><option {option} gravity="0 0 -9.81"/><worldbody>{text}</worldbody></mujoco>'


def goals(links, rng, number):
    """Goals at every row: steps on every third joint in turn, sines on the others [rad]."""
    time = np.arange(0, LOG_S, PERIOD_S)
    found = np.zeros((len(time), len(links)))
    for k, link in enumerate(links):
        if (number + k) % 3 == 0:
            steps = rng.uniform(-link.reach_rad, link.reach_rad, int(LOG_S / 1.5) + 1)
            found[:, k] = np.repeat(steps, round(1.5 / PERIOD_S))[: len(time)]
            found[: round(1 / PERIOD_S), k] = 0
            continue
        order = np.arange(1, 5)
        angle = 2 * np.pi * 0.13 * np.outer(time, order)
        sines, cosines = rng.standard_normal((2, 4)) / order
        swing = np.minimum(time, 1) * (np.sin(angle) @ sines + (np.cos(angle) - 1) @ cosines)
        found[:, k] = link.reach_rad * swing / np.abs(swing).max()
    return found


def recorded(model, rows, friction):
    """Plays goals; time, positions and goals by row, positions rounded by the encoder."""
    data = mujoco.MjData(model)
    data.qpos[:] = rows[0]
    counts = lambda angle: np.round(angle / COUNT_RAD) * COUNT_RAD  # noqa: E731
    found = []
    for row, goal in enumerate(rows):
        for step in range(round(PERIOD_S / ENGINE_STEP_S)):
            if step == round(READ_AFTER_S / ENGINE_STEP_S):
                found.append([row * PERIOD_S, *counts(data.qpos), *goal])
            if step % 2 == 0:  # a drive at 1 kHz
                volts = V_PER_RAD * (counts(goal) - counts(data.qpos))
                motor_nm = NM_PER_V * np.clip(volts, -LIMIT_V, LIMIT_V)
            model.dof_frictionloss[:] = friction.dry(data.qvel, motor_nm)
            data.qfrc_applied[:] = motor_nm - friction.viscous(data.qvel)
            mujoco.mj_step(model, data)
    return np.array(found)


def model_toml(links, rng):
    """The model that a diagnosis is given."""
    listed = lambda values: [float(value) for value in values]  # noqa: E731
    text = 'format = 2\n[robot]\nname = "servos"\ngravity_m_s2 = [0.0, 0.0, -9.81]\n'
    text += f"sample_period_s = {PERIOD_S}\n"
    for link in links:
        xx, yy, zz = link.inertia_kg_m2
        text += f"""[[joint]]
kind = "revolute"
origin_xyz_m = {listed(link.origin_m)}
axis = {listed(link.axis)}
mass_kg = {link.mass_kg * (1 + 0.02 * rng.standard_normal())}
com_m = {listed(link.centre_m)}
inertia_kg_m2 = [{xx}, 0.0, 0.0, {yy}, 0.0, {zz}]
armature_kg_m2 = {link.rotor_kg_m2 * (1 + 0.05 * rng.standard_normal())}
encoder = {{ counts_per_rev = 4096 }}
friction = {{ alpha0_V = {COULOMB_V}, alpha2_V_s_per_rad = {VISCOUS_V_S} }}
[joint.drive]
kind = "position-servo"
torque_constant_Nm_per_V = {NM_PER_V}
stiffness_V_per_rad = {V_PER_RAD}
limit_V = {LIMIT_V}
"""
    return text


def write_case(directory, seed, links, load_kg):
    """Writes all files of a case beside its place, then puts them there."""
    rng = np.random.default_rng(seed)
    new = directory.with_name(f".{directory.name}")
    shutil.rmtree(new, ignore_errors=True)
    new.mkdir(parents=True)
    friction = Friction.drawn(rng, len(links))
    played = links
    if len(links) == 1:
        played, load_kg = [Link(**{**vars(links[0]), "mass_kg": links[0].mass_kg + load_kg})], 0
    model = mujoco.MjModel.from_xml_string(scene(played, load_kg))
    numbers = range(1, len(links) + 1)
    columns = ["t_s", *(f"q{k}_rad" for k in numbers), *(f"qref{k}_rad" for k in numbers)]
    dataset = "format = 1\n"
    for number in range(LOGS):
        rows = recorded(model, goals(links, rng, number), friction)
        name = f"motion-{number + 1}.csv"
        np.savetxt(new / name, rows, "%.9g", ",", header=",".join(columns), comments="")
        role = "train" if number < OF_THEM_TRAIN else "holdout"
        dataset += f'[[log]]\nfile = "{name}"\nexperiment = "task"\nrole = "{role}"\n'
    (new / "model.toml").write_text(model_toml(links, rng))
    (new / "dataset.toml").write_text(dataset)
    shutil.rmtree(directory, ignore_errors=True)
    new.rename(directory)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="directory of the case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pendulum", action="store_true", help="one servo, its mass exchanged")
    parser.add_argument("--load", type=float, default=0.0, help="mass more than the model's [kg]")
    arguments = parser.parse_args()
    links = PENDULUM if arguments.pendulum else ARM
    write_case(arguments.out, arguments.seed, links, arguments.load)
