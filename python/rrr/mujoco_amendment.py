"""A MuJoCo specification that takes effects, and what its joints and drives are called."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from rrr.mujoco_chain import SLIDE, Inertial, Link, body_inertial
from rrr.mujoco_drive import drive
from rrr.mujoco_model import from_mujoco

Parameters = dict[str, Any]


class Amendment:
    """A specification that takes effects; `left` are those that it has no form for.

    `constants` is the torque by command of each joint [Nm by the command's unit].
    """

    def __init__(
        self,
        spec: Any,
        m: Any,
        links: list[Link],
        constants: list[float],
        joints: list[dict[str, Any]],
    ) -> None:
        self.spec, self.m, self.links = spec, m, links
        self.constants, self.joints = constants, joints
        # What the engine's model has already.
        self.given = from_mujoco(m).to_dict().get("effect", [])
        self.left: list[dict[str, Any]] = []

    def actuator(self, index: int) -> Any | None:
        """The actuator that drives a joint, by its number from 0."""
        found = drive(self.m, self.links[index].joint)
        return None if found.actuator is None else self.spec.actuators[found.actuator]

    def joint(self, index: int) -> Any:
        """A joint's element."""
        return self.spec.joints[self.links[index].joint]

    def joint_name(self, index: int) -> str:
        """A joint's name; one that has none is given one."""
        joint = self.joint(index)
        if not joint.name:
            joint.name = f"joint{index + 1}"
        return str(joint.name)

    def add_passive(self, index: int) -> Any:
        """A `dcmotor` on a joint that takes no command."""
        actuator = self.spec.add_actuator(
            target=self.joint_name(index), trntype=mujoco.mjtTrn.mjTRN_JOINT
        )
        actuator.gear = [1, 0, 0, 0, 0, 0]
        return actuator

    def leave(self, name: str, number: int, parameters: Parameters) -> None:
        """Hands an effect on, with what a callback must know."""
        left: dict[str, Any] = {"effect": name, "joint": number, "parameters": parameters}
        if number:
            left |= self._of_joint(number - 1)
        else:
            link = self.links[-1]
            body = self.spec.bodies[link.root]
            body.name = body.name or "tip"
            left |= {"body": str(body.name), "tip_m": [float(x) for x in link.anchor]}
        self.left.append(left)

    def _of_joint(self, index: int) -> dict[str, Any]:
        actuator = self.actuator(index)
        if actuator is not None and not actuator.name:
            actuator.name = f"drive{index + 1}"
        friction = self.joints[index].get("friction", {})
        value = {name.split("_")[0]: v for name, v in friction.items()}
        k = abs(self.constants[index])
        return {
            "name": self.joint_name(index),
            "actuator": None if actuator is None else str(actuator.name),
            "torque_constant": self.constants[index],
            "coulomb": k * value.get("alpha0", 0.0),
            "viscous": k * value.get("alpha2", 0.0),
        }


def inertial_of(body: Any, m: Any, root: int) -> Inertial:
    """A body's inertial: what the specification says by now, or what was compiled."""
    if not body.explicitinertial:
        return body_inertial(m, root)
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, np.array(body.iquat))
    matrix = turn.reshape(3, 3)
    about = matrix @ np.diag(body.inertia) @ matrix.T
    return Inertial(float(body.mass), np.array(body.ipos), about)


def in_own_unit(to: Amendment, link: Link, angles: list[float]) -> list[float]:
    """Ranges stand in degrees where the compiler reads degrees."""
    is_slide = to.m.jnt_type[link.joint] == SLIDE
    by = math.degrees(1.0) if to.spec.compiler.degree and not is_slide else 1.0
    return [by * angle for angle in angles]
