#!/usr/bin/env python3
"""Compares chains' inverse dynamics, forward dynamics and mass matrix with MuJoCo's.

Reads the JSON that `cargo test --release -p mechanism --test mujoco` writes: chains, states, and
the project's answers. Ends with status 1 where one differs.
"""

import argparse
import json
import sys
from pathlib import Path

import mujoco
import numpy as np

AGREEMENT = 1e-10  # of the largest entry


def row(values):
    return " ".join(repr(float(value)) for value in values)


def scene(chain):
    """The chain as MuJoCo's XML: each body in the one before; roll, pitch, yaw about fixed axes."""
    head = (f'<mujoco><compiler angle="radian" eulerseq="XYZ" balanceinertia="false"/>'
            f'<option gravity="{row(chain["gravity"])}"/><worldbody>')
    bodies = ""
    for joint in chain["joints"]:
        xx, xy, xz, yy, yz, zz = joint["inertia"]
        bodies += (
            f'<body pos="{row(joint["xyz"])}" euler="{row(joint["rpy"])}">'
            f'<joint type="{joint["type"]}" axis="{row(joint["axis"])}"'
            f' armature="{joint["armature"]!r}"/>'
            f'<inertial pos="{row(joint["centre"])}" mass="{joint["mass"]!r}"'
            f' fullinertia="{row([xx, yy, zz, xy, xz, yz])}"/>')
    return head + bodies + "</body>" * len(chain["joints"]) + "</worldbody></mujoco>"


def difference(found, expected):
    """The largest difference relative to the largest entry."""
    found, expected = np.asarray(found), np.asarray(expected)
    return np.abs(found - expected).max() / np.abs(expected).max()


def compare(model, data, state):
    """Differences of torque, mass matrix and fall in a state."""
    data.qpos[:], data.qvel[:], data.qacc[:] = state["q"], state["qd"], state["qdd"]
    mujoco.mj_inverse(model, data)
    torque = difference(state["torque"], data.qfrc_inverse)
    data.qfrc_applied[:] = state["push"]
    mujoco.mj_forward(model, data)
    mass = np.empty((model.nv, model.nv))
    try:
        mujoco.mj_fullM(model, data, mass)
    except TypeError:  # before version 4
        mujoco.mj_fullM(model, mass, data.qM)
    return torque, difference(state["mass"], mass.ravel()), difference(state["fall"], data.qacc)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("answers", type=Path)
    chains = json.loads(parser.parse_args().answers.read_text())
    worst = np.zeros(3)
    for chain in chains:
        model = mujoco.MjModel.from_xml_string(scene(chain))
        data = mujoco.MjData(model)
        for state in chain["states"]:
            worst = np.maximum(worst, compare(model, data, state))
    print(f"{len(chains)} chains, MuJoCo {mujoco.__version__}, largest relative difference:")
    for name, value in zip(("inverse dynamics", "mass matrix", "forward dynamics"), worst):
        print(f"  {name} {value:.1e}")
    sys.exit(not (worst < AGREEMENT).all())


if __name__ == "__main__":
    main()
