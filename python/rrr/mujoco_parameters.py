"""Inertias, rotors and friction of an amended model in a MuJoCo specification."""

from __future__ import annotations

import warnings
from typing import Any

import mujoco
import numpy as np

from rrr.mujoco_chain import Inertial, Link, rigid_inertial, whole
from rrr.mujoco_drive import armature, damping, drive, on_joint

LEAST_MOMENT_KG_M2 = 1e-10
"""MuJoCo takes no body without inertia."""


def set_parameters(spec: Any, m: Any, link: Link, joint: dict[str, Any]) -> float:
    """Sets what a `[[joint]]` says of link, rotor and friction; torque by command [Nm by its unit]."""
    found = drive(m, link.joint)
    if "mass_kg" in joint:
        _set_inertial(spec, m, link, joint)
    element = spec.joints[link.joint]
    rotor = float(joint.get("armature_kg_m2", joint.get("armature_kg", 0.0)))
    element.armature = max(float(element.armature) + rotor - armature(m, link.joint), 0.0)
    _set_friction(spec, m, link.joint, joint.get("friction", {}), abs(found.constant), found)
    return float(found.constant)


def _set_inertial(spec: Any, m: Any, link: Link, joint: dict[str, Any]) -> None:
    """Puts the change onto the body that has the joint; what is welded to it stays as it is."""
    xx, xy, xz, yy, yz, zz = joint["inertia_kg_m2"]
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    centre = np.array(joint["com_m"]) + link.anchor
    found = Inertial(float(joint["mass_kg"]), centre, about)
    others = rigid_inertial(m, link.root, without_root=True)
    own = whole([found, _negative(others)]) if others.mass else found
    set_inertial(spec.bodies[link.root], own)


def _negative(part: Inertial) -> Inertial:
    return Inertial(-part.mass, part.centre, -part.about_centre)


def set_inertial(body: Any, own: Inertial) -> None:
    """Gives a body an inertial, which must be one that matter can have."""
    if own.mass <= 0.0:
        if own.mass < -1e-9:
            warnings.warn(f"the link {body.name} would have {own.mass:.3g} kg and stays", stacklevel=2)
        return
    moments, turn = np.linalg.eigh(own.about_centre)
    possible = _possible(moments)
    if np.abs(possible - moments).max() > 1e-9 + 1e-6 * np.abs(moments).max():
        what = f"no matter has the inertia found for {body.name}: the nearest that it can have is taken"
        warnings.warn(what, stacklevel=2)
    if np.linalg.det(turn) < 0:
        turn[:, 0] *= -1
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(turn).ravel())
    body.explicitinertial, body.mass = True, own.mass
    body.ipos, body.iquat, body.inertia = own.centre, quaternion, possible
    # Not a number stands for "not given".
    body.fullinertia = [np.nan, 0, 0, 0, 0, 0]


def _possible(moments: Any) -> Any:
    """Principal moments, none below zero and none above the sum of the others."""
    low, middle, high = np.maximum(moments, LEAST_MOMENT_KG_M2)
    missing = max(high - low - middle, 0.0) * (1 + 1e-9)
    return np.array([low + missing / 2, middle + missing / 2, high])


def _set_friction(
    spec: Any, m: Any, joint: int, friction: dict[str, float], k: float, found: Any
) -> None:
    """Coulomb and viscous friction in the joint's own form; with bristles as LuGre friction."""
    value = {name.split("_")[0]: v for name, v in friction.items()}
    element = spec.joints[joint]
    back_emf = 0.0 if found.kind == "position-servo" else found.damping
    change = k * value.get("alpha2", 0.0) - back_emf - damping(m, joint)[0]
    coefficients = np.array(element.damping, dtype=np.float64)
    coefficients[0] = max(coefficients[0] + change, 0.0)
    element.damping = coefficients
    if not found.bristles:
        element.frictionloss = k * max(value.get("alpha0", 0.0), 0.0)
        return
    element.frictionloss = 0.0
    _set_bristles(spec, m, joint, value, k)


def _set_bristles(spec: Any, m: Any, joint: int, value: dict[str, float], k: float) -> None:
    """LuGre friction of the `dcmotor` that has it; `frictionloss` has gone into it."""
    for a in on_joint(m, joint):
        if m.actuator_dynprm[a, 5] > 0:
            actuator, gear = spec.actuators[a], abs(float(m.actuator_gear[a, 0]))
            bias, dynamics = np.array(actuator.biasprm), np.array(actuator.dynprm)
            level = k * value["alpha0"]
            bias[3:6] = (
                level / gear,
                (level + k * max(value.get("alpha1", 0.0), 0.0)) / gear,
                value.get("stribeck", bias[5] / gear) * gear,
            )
            dynamics[5:7] = k * value["sigma0"] / gear**2, k * value.get("sigma1", 0.0) / gear**2
            actuator.biasprm, actuator.dynprm = bias, dynamics
