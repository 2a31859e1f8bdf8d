"""The serial chain of a compiled MuJoCo model: joints base to tip, each with what it moves.

A joint's frame has its origin at the joint's anchor and the axes of its body, turned and shifted so
that it moves by `qpos`, whatever the joint's `ref`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from rrr._rrr import Error

Array = NDArray[np.float64]
HINGE, SLIDE = int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)


@dataclass(frozen=True)
class Pose:
    """A frame in another: `turn`, 3 x 3, and `place` [m]."""

    turn: Array
    place: Array

    def then(self, other: Pose) -> Pose:
        """A frame that `other` says in this one."""
        return Pose(self.turn @ other.turn, self.place + self.turn @ other.place)


@dataclass(frozen=True)
class Inertial:
    """Mass [kg], centre [m] and inertia about it [kg m^2], 3 x 3, in a frame."""

    mass: float
    centre: Array
    about_centre: Array

    def about_origin(self) -> Array:
        """Inertia about the frame's origin [kg m^2]."""
        c = self.centre
        return self.about_centre + self.mass * (float(c @ c) * np.eye(3) - np.outer(c, c))

    def seen(self, pose: Pose) -> Inertial:
        """The same in the frame in which this one is `pose`."""
        turned = pose.turn @ self.about_centre @ pose.turn.T
        return Inertial(self.mass, pose.place + pose.turn @ self.centre, turned)


@dataclass(frozen=True)
class Link:
    """A joint and what it moves; `root` is the body whose joint it is, `pose` the joint's frame in
    the one before, `anchor` its origin in the body [m], `axis` in both."""

    joint: int
    root: int
    pose: Pose
    anchor: Array
    axis: Array
    inertial: Inertial


def whole(parts: list[Inertial]) -> Inertial:
    """Bodies that move together, as one."""
    mass = sum(part.mass for part in parts)
    if mass == 0.0:
        return Inertial(0.0, np.zeros(3), np.zeros((3, 3)))
    centre = sum((part.mass * part.centre for part in parts), np.zeros(3)) / mass
    about = sum((part.about_origin() for part in parts), np.zeros((3, 3)))
    return Inertial(mass, centre, about - Inertial(mass, centre, np.zeros((3, 3))).about_origin())


def turned(quaternion: Array) -> Array:
    """The matrix, 3 x 3, of a quaternion."""
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, np.asarray(quaternion, dtype=np.float64))
    return matrix.reshape(3, 3)


def about(axis: Array, angle: float) -> Array:
    """The matrix, 3 x 3, of a turn about an axis of length 1 [rad]."""
    quaternion = np.empty(4)
    mujoco.mju_axisAngle2Quat(quaternion, axis, angle)
    return turned(quaternion)


def body_inertial(m: Any, body: int) -> Inertial:
    """A body's own, in its frame."""
    turn = turned(m.body_iquat[body])
    inertia = turn @ np.diag(m.body_inertia[body]) @ turn.T
    return Inertial(float(m.body_mass[body]), m.body_ipos[body].copy(), inertia)


def body_pose(m: Any, body: int, root: int) -> Pose:
    """A body's frame in that of one above it, no joint between them moved."""
    pose = Pose(np.eye(3), np.zeros(3))
    while body != root:
        pose = Pose(turned(m.body_quat[body]), m.body_pos[body].copy()).then(pose)
        body = int(m.body_parentid[body])
    return pose


def rigid_inertial(m: Any, root: int, *, without_root: bool = False) -> Inertial:
    """All that is welded to a body, in its frame."""
    bodies = [int(b) for b in np.flatnonzero(m.body_weldid == root)]
    bodies = [b for b in bodies if not (without_root and b == root)]
    return whole([body_inertial(m, b).seen(body_pose(m, b, root)) for b in bodies])


def chain(m: Any) -> list[Link]:
    """The joints of a model, base to tip.

    Raises `rrr.Error` where the model is no serial chain of hinges and slides.
    """
    links: list[Link] = []
    base = 0
    while roots := _next(m, base):
        if len(roots) > 1:
            names = ", ".join(m.body(root).name or str(root) for root in roots)
            raise Error(f"the model branches into the bodies {names}\nhint: {_ONE_CHAIN}")
        links += _of_body(m, roots[0], base, links)
        base = roots[0]
    if not links:
        raise Error("the model has no joint\nhint: " + _ONE_CHAIN)
    return links


_ONE_CHAIN = "give a model of one serial chain of hinges and slides, without loose objects"


def _next(m: Any, base: int) -> list[int]:
    """Bodies with joints of their own that hang on what is welded to another."""
    weld, parent = m.body_weldid, m.body_parentid
    bodies = range(1, m.nbody)
    return [b for b in bodies if weld[b] == b and weld[parent[b]] == base]


def _of_body(m: Any, root: int, base: int, before: list[Link]) -> list[Link]:
    """A body's joints; the last moves all that is welded to the body."""
    first = int(m.body_jntadr[root])
    joints = list(range(first, first + int(m.body_jntnum[root])))
    pose = body_pose(m, root, base)
    if before:
        pose = Pose(np.eye(3), -before[-1].anchor).then(pose)
    inertial = rigid_inertial(m, root)
    links, anchor = [], np.zeros(3)
    for joint in joints:
        if m.jnt_type[joint] not in (HINGE, SLIDE):
            name = m.joint(joint).name or str(joint)
            raise Error(f"the joint {name} is neither hinge nor slide\nhint: {_ONE_CHAIN}")
        new = m.jnt_pos[joint].copy()
        pose = _from_zero(m, joint, pose.then(Pose(np.eye(3), new - anchor)))
        own = inertial if joint == joints[-1] else whole([])
        seen = own.seen(Pose(np.eye(3), -new)) if own.mass else own
        links.append(Link(joint, root, pose, new, m.jnt_axis[joint].copy(), seen))
        pose, anchor = Pose(np.eye(3), np.zeros(3)), new
    return links


def _from_zero(m: Any, joint: int, pose: Pose) -> Pose:
    """A joint's frame where `qpos` is zero, of that where it is its `ref`."""
    ref, axis = float(m.qpos0[m.jnt_qposadr[joint]]), m.jnt_axis[joint]
    if m.jnt_type[joint] == SLIDE:
        return pose.then(Pose(np.eye(3), -ref * axis))
    return pose.then(Pose(about(axis, -ref), np.zeros(3)))


def roll_pitch_yaw(turn: Array) -> Array:
    """Angles [rad] of a matrix = Rz(yaw) Ry(pitch) Rx(roll); exact also where pitch is a right
    angle, where roll and yaw are not told apart."""
    pitch = np.arctan2(-turn[2, 0], np.hypot(turn[0, 0], turn[1, 0]))
    roll = np.arctan2(turn[2, 1], turn[2, 2])
    s, c = np.sin(roll), np.cos(roll)
    yaw = np.arctan2(s * turn[0, 2] - c * turn[0, 1], c * turn[1, 1] - s * turn[1, 2])
    return np.array([roll, pitch, yaw])
