"""Springs and play between motor and link, as a second hinge on the axis of the first."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rrr.mujoco_amendment import Amendment, Parameters, in_own_unit, inertial_of
from rrr.mujoco_chain import SLIDE, Inertial
from rrr.mujoco_parameters import set_inertial


def elasticity(to: Amendment, index: int, p: Parameters) -> bool:
    """A second hinge on the same axis: the joint is the motor's, the new one how far the link is
    ahead of it."""
    new = _second_joint(to, index, p)
    new.stiffness = [p["stiffness_Nm_per_rad"], 0, 0]
    new.damping = [p["damping_Nm_s_per_rad"], 0, 0]
    return True


def _second_joint(to: Amendment, index: int, p: Parameters) -> Any:
    joint, link = to.joint(index), to.links[index]
    body = to.spec.bodies[link.root]
    # What the motor has is a part of the joint's own inertia: the rest of the rotor goes to the link.
    rest = float(joint.armature) - p["motor_inertia_kg_m2"]
    joint.armature = p["motor_inertia_kg_m2"]
    is_slide = to.m.jnt_type[link.joint] == SLIDE
    if rest and not is_slide:
        own = inertial_of(body, to.m, link.root)
        about = own.about_centre + rest * np.outer(link.axis, link.axis)
        set_inertial(body, Inertial(own.mass, own.centre, about))
    return body.add_joint(
        name=f"{to.joint_name(index)}_link", type=joint.type, axis=link.axis, pos=link.anchor
    )


def backlash(to: Amendment, index: int, p: Parameters) -> bool:
    """The same with a range for a spring: contact at its ends as stiff and as damped."""
    link = to.links[index]
    inertia = _reduced_inertia(to, index, p["motor_inertia_kg_m2"])
    stiffness, damping = p["stiffness_Nm_per_rad"], p["damping_Nm_s_per_rad"]
    frequency = math.sqrt(stiffness / inertia)
    ratio = max(damping / (2 * math.sqrt(stiffness * inertia)), 0.05)
    constant = max(1 / (ratio * frequency), 2 * to.spec.option.timestep)
    new = _second_joint(to, index, p)
    half = 0.5 * p["gap_rad"]
    new.limited, new.range = True, in_own_unit(to, link, [-half, half])
    new.solref_limit = [constant, ratio]
    return True


def _reduced_inertia(to: Amendment, index: int, motor: float) -> float:
    """That of motor and link against each other, in the model's own posture [kg m^2]."""
    dof = int(to.m.jnt_dofadr[to.links[index].joint])
    link = max(1.0 / float(to.m.dof_invweight0[dof]) - motor, motor)
    return motor * link / (motor + link)
