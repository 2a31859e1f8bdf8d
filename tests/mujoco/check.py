#!/usr/bin/env python3
"""Compares `rrr inverse-dynamics` with MuJoCo's inverse dynamics on random robots."""

import argparse
import subprocess
import tempfile
from pathlib import Path

import mujoco
import numpy as np

from plant import Plant
from regressor import inverse_dynamics
from robot import draw_robot, model_toml

AGREEMENT_NM = 1e-6
STATES = 200


def mujoco_torques(robot, states):
    """Torques of n states (q, qd, qdd; n x 9), n x 3 [Nm]."""
    plant = Plant(robot, "tanh", [0.02] * 3, [])
    torques = np.empty((len(states), 3))
    for row, state in enumerate(states):
        plant.data.qpos[:], plant.data.qvel[:], plant.data.qacc[:] = state.reshape(3, 3)
        mujoco.mj_inverse(plant.model, plant.data)
        torques[row] = plant.data.qfrc_inverse
    return torques


def rrr_torques(rrr, robot, states):
    """The same from the project's program."""
    with tempfile.TemporaryDirectory() as place:
        place = Path(place)
        base = [float(f"{p:.12g}") for p in robot.base]
        (place / "model.toml").write_text(model_toml(base, robot.friction, digits=12))
        names = [f"{n}{j}_{u}" for n, u in
                 (("q", "rad"), ("qd", "rad_per_s"), ("qdd", "rad_per_s2")) for j in (1, 2, 3)]
        np.savetxt(place / "states.csv", states, "%.12g", ",", header=",".join(names), comments="")
        files = [place / "states.csv", "--out", place / "torques.csv"]
        subprocess.run([rrr, "inverse-dynamics", "--model", place / "model.toml", *files],
                       check=True, stdout=subprocess.DEVNULL)
        table = np.genfromtxt(place / "torques.csv", delimiter=",", names=True)
        return np.stack([table[f"tau{joint}_Nm"] for joint in (1, 2, 3)], axis=1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rrr", help="the program; without it only this directory's own formulas")
    parser.add_argument("--robots", type=int, default=5)
    options = parser.parse_args()
    for number in range(options.robots):
        rng = np.random.default_rng(number)
        robot = draw_robot(rng).with_rotor(3, 0.1)
        states = np.around(rng.uniform(-1, 1, (STATES, 9)) * np.repeat([3, 6, 40], 3), 9)
        engine = mujoco_torques(robot, states)
        own = inverse_dynamics(robot.base, *np.split(states, 3, axis=1))
        worst = [np.abs(own - engine).max()]
        if options.rrr:
            worst.append(np.abs(rrr_torques(options.rrr, robot, states) - engine).max())
        print(f"robot {number}: largest difference " + ", ".join(f"{w:.1e} Nm" for w in worst))
        assert max(worst) < AGREEMENT_NM


if __name__ == "__main__":
    main()
