"""Causes that are not in the catalogue; nobody should name another in their place."""

import mujoco
import numpy as np

from causes import Cause, _log_uniform
from plant import Plant
from robot import TORQUE_CONSTANT

WORDS = {
    "x_tendon": "a spring between joints 2 and 3, torque -k (q2 + q3 - rest) on both",
    "x_hum": "a hum of the supply, added to the command, whatever the angle",
    "x_wall": "a wall that the tip touches now and then",
    "x_belt": "a belt that slips above a torque",
}


def draw_foreign(rng, name, robot, clean, law):
    """A foreign cause of that name; `clean` are the recordings without it."""
    joint = int(rng.integers(1, 4)) if name in ("x_hum", "x_belt") else 0
    if name == "x_tendon":
        p = {"stiffness_Nm_per_rad": _log_uniform(rng, 0.2, 2.0), "rest_rad": rng.uniform(-2, -1)}
    elif name == "x_hum":
        p = {"amplitude_V": _log_uniform(rng, 0.04, 0.3), "frequency_Hz": rng.uniform(10, 45)}
        p["phase_rad"] = rng.uniform(-np.pi, np.pi)
    elif name == "x_wall":
        p = _wall(rng, robot, clean, law)
    else:
        peak = max(np.abs(log.command[:, joint - 1]).max() for log in clean)
        p = {"slip_Nm": rng.uniform(0.6, 0.9) * peak * TORQUE_CONSTANT[joint - 1]}
    return Cause(name, joint, p)


def _wall(rng, robot, clean, law):
    """Where a small part of the motion would go beyond it."""
    direction = rng.uniform(-np.pi, np.pi)
    normal = np.array([np.cos(direction), np.sin(direction), 0.0])
    way = np.concatenate([log.plan.reference[::10] for log in clean])
    reach = tip_positions(robot, law, way) @ normal
    beyond = _log_uniform(rng, 0.005, 0.04)
    return {"normal": normal.tolist(), "distance_m": float(np.quantile(reach, 1 - beyond) + 0.02)}


def tip_positions(robot, law, way):
    """Where the tip is at n x 3 angles [rad], n x 3 [m], base frame."""
    plant = Plant(robot, law, [0.02] * 3, [])
    places = np.empty_like(way)
    for row, angle in enumerate(way):
        plant.data.qpos[:] = angle
        mujoco.mj_kinematics(plant.model, plant.data)
        places[row] = plant.data.body("tip").xpos
    return places
