"""A MuJoCo model as a robot of this package."""

from __future__ import annotations

from typing import Any

import numpy as np

from rrr.model import Model
from rrr.toml_text import toml_text


def from_mujoco(m: Any, *, sample_period_s: float | None = None) -> Model:
    """The robot of a compiled `mujoco.MjModel`: a serial chain of hinges and slides.

    MuJoCo's compiler has read MJCF or URDF, defaults and meshes. Taken over are axes, inertias of all
    that is welded to a link, armature, damping, frictionloss or LuGre friction, and the drives: motor
    and `general` with a fixed gain (command times gain and gear is the torque), `dcmotor` by its
    voltage, `position` (a servo, whose goals are taken in the joint's unit), with their limits.
    Lag, delay, springs, cogging and drag stand among the model's effects. Joints are
    numbered from the base and keep their names; the base frame is the world's.

    `sample_period_s` is the period of the logs to come, the model's time step if it is not given.
    What is left out is said in `remarks`. Raises `rrr.Error` where the model is no such chain.
    """
    from rrr.mujoco_chain import chain

    links = chain(m)
    remarks: list[str] = []
    joints, effects = [], []
    for number, link in enumerate(links, 1):
        joint, of_joint = _joint(m, link, number, remarks)
        joints.append(joint)
        effects += of_joint
    robot = {
        "name": _name(m),
        "gravity_m_s2": [float(g) for g in m.opt.gravity],
        "sample_period_s": float(sample_period_s or m.opt.timestep),
    }
    content = {"format": 2, "robot": robot, "joint": joints, "effect": effects}
    remarks += _left_out(m)
    found = Model.parse(toml_text(content), "mujoco.toml")
    found.remarks += remarks
    return found


def _joint(
    m: Any, link: Any, number: int, remarks: list[str]
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """`[[joint]]`, and the effects on it."""
    from rrr.mujoco_chain import SLIDE, roll_pitch_yaw
    from rrr.mujoco_drive import armature, drive

    found = drive(m, link.joint)
    is_slide = m.jnt_type[link.joint] == SLIDE
    unit, inertia = ("m", "kg") if is_slide else ("rad", "kg_m2")
    body = link.inertial
    i = body.about_centre
    joint: dict[str, Any] = {
        "name": m.joint(link.joint).name or f"joint{number}",
        "kind": "prismatic" if is_slide else "revolute",
        "origin_xyz_m": _floats(link.pose.place),
        "origin_rpy_rad": _floats(roll_pitch_yaw(link.pose.turn)),
        "axis": _floats(link.axis),
        "mass_kg": body.mass,
        "com_m": _floats(body.centre),
        "inertia_kg_m2": _floats([i[0, 0], i[0, 1], i[0, 2], i[1, 1], i[1, 2], i[2, 2]]),
        f"armature_{inertia}": armature(m, link.joint),
    }
    if m.jnt_limited[link.joint]:
        joint[f"limits_{unit}"] = _floats(m.jnt_range[link.joint])
    joint["drive"] = _drive(found, unit)
    joint["friction"] = _friction(m, link.joint, found, joint["name"], remarks)
    return joint, _effects(m, link.joint, number, found, joint["name"], remarks)


def _floats(values: Any) -> list[float]:
    return [float(value) for value in np.asarray(values)]


def _drive(found: Any, unit: str) -> dict[str, Any]:
    torque = "N" if unit == "m" else "Nm"
    table: dict[str, Any] = {"kind": found.kind}
    command = torque if found.kind == "torque" else "V"
    if found.kind != "torque":
        table[f"torque_constant_{torque}_per_V"] = found.constant
    if found.kind == "position-servo":
        table[f"stiffness_V_per_{unit}"] = found.stiffness
        table[f"damping_V_s_per_{unit}"] = found.damping
    if np.isfinite(found.limit):
        table[f"limit_{command}"] = found.limit
    return table


def _friction(
    m: Any, joint: int, found: Any, name: str, remarks: list[str]
) -> dict[str, float]:
    """`[joint.friction]`, in the command's unit; V and rad stand for whatever that is."""
    from rrr.mujoco_drive import damping

    k = abs(found.constant)
    viscous, _, cube = damping(m, joint)
    if found.kind != "position-servo":
        viscous += found.damping
    if cube:
        remarks.append(f"joint {name}: damping with the cube of speed is left out")
    level = float(m.dof_frictionloss[m.jnt_dofadr[joint]])
    table = {"alpha0_V": level / k, "alpha2_V_s_per_rad": viscous / k}
    if b := found.bristles:
        if level:
            remarks.append(f"joint {name}: frictionloss beside LuGre friction is taken together")
        table["alpha0_V"] = (level + b["coulomb"]) / k
        table["alpha1_V"] = (b["static"] - b["coulomb"]) / k
        table["stribeck_velocity_rad_per_s"] = b["stribeck"]
        table["sigma0_V_per_rad"], table["sigma1_V_s_per_rad"] = b["sigma0"] / k, b["sigma1"] / k
    return table


def _effects(
    m: Any, joint: int, number: int, found: Any, name: str, remarks: list[str]
) -> list[dict[str, Any]]:
    """What the engine has beyond rigid body and friction, by the names of docs/effects.md."""
    from rrr.mujoco_drive import damping

    k = found.constant
    effects: list[tuple[str, dict[str, float]]] = []
    if found.lag_s:
        effects.append(("actuator_lag", {"time_constant_s": found.lag_s}))
    if found.delay_s:
        effects.append(("delay", {"delay_s": found.delay_s}))
    if stiffness := float(m.jnt_stiffness[joint]):
        rest = float(m.qpos_spring[m.jnt_qposadr[joint]])
        effects.append(("cable_spring", {"stiffness_V_per_rad": stiffness / k, "rest_rad": rest}))
    if square := damping(m, joint)[1]:
        effects.append(("quadratic_drag", {"coefficient_V_s2_per_rad2": square / k}))
    amplitude, order, phase = found.cogging
    if amplitude:
        wave = {"amplitude_V": amplitude / k, "harmonic": order, "phase_rad": phase}
        effects.append(("cogging", wave))
    if np.any(m.jnt_stiffnesspoly[joint]):
        remarks.append(f"joint {name}: stiffness that changes with the deflection is left out")
    return [{"effect": e, "joint": number, "parameters": p} for e, p in effects]


def _name(m: Any) -> str:
    """The model's name: the first in the list of names."""
    return bytes(m.names).split(b"\0", 1)[0].decode() or "robot"


def _left_out(m: Any) -> list[str]:
    """What acts in the engine and has no form here, in sentences."""
    parts = {
        "gravity compensation": np.any(m.body_gravcomp),
        "tendons": m.ntendon,
        "equality constraints": m.neq,
        "air and wind": m.opt.density or m.opt.viscosity,
        "contacts": _has_contacts(m),
    }
    return [f"{part} of the MuJoCo model are left out" for part, there in parts.items() if there]


def _has_contacts(m: Any) -> bool:
    import mujoco

    if m.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_CONTACT):
        return False
    return bool(m.ngeom and np.any(m.geom_contype) and np.any(m.geom_conaffinity))
