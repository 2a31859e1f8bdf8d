"""The robot in the engine: takes motor voltages, gives what the encoders read."""

import math

import mujoco
import numpy as np

from drive import STEPS, Drive
from forces import SCALES, VOLTAGES, BristleFriction, JointFriction, SmoothFriction
from robot import COUNTS_PER_REV, TORQUE_CONSTANT
from scene import scene

COUNTS_PER_RAD = COUNTS_PER_REV / (2 * math.pi)
STRIDE = 2
"""Steps of the engine between evaluations of what is added from outside."""


class Plant:
    """A robot with its friction law and its causes; `width` is that of each joint's tanh."""

    def __init__(self, robot, law, width, causes):
        self.model = mujoco.MjModel.from_xml_string(scene(robot, law, causes))
        self.data = mujoco.MjData(self.model)
        joints = [self.model.joint(f"q{joint}") for joint in (1, 2, 3)]
        self.motor_dof = [int(joint.dofadr[0]) for joint in joints]
        self.link_dof = self._link_dofs()
        self.causes, self.law = causes, law
        self._choose_friction(robot, width)
        self.voltages = [(c, VOLTAGES[c.effect]) for c in causes if c.effect in VOLTAGES]
        self.readings = [c for c in causes if c.effect == "encoder_eccentricity"]
        self._choose_steps()

    def _link_dofs(self):
        names = {self.model.joint(i).name for i in range(self.model.njnt)}
        links = [f"t{j}" if f"t{j}" in names else f"q{j}" for j in (1, 2, 3)]
        return [int(self.model.joint(name).dofadr[0]) for name in links]

    def _choose_friction(self, robot, width):
        scaled = {c.joint - 1: c for c in self.causes if c.effect in SCALES}
        self.friction = []
        for index in range(3):
            cause = scaled.get(index)
            if cause is None and self.law != "tanh":
                continue
            alpha, k_t = robot.friction[index].tolist(), float(TORQUE_CONSTANT[index])
            if self.law == "tanh":
                played = SmoothFriction(index, alpha, width[index])
            else:
                kind = {"joint": JointFriction, "lugre": BristleFriction}[self.law]
                played = kind(index, alpha, k_t, self)
            self.friction.append((index, played, cause))

    def _choose_steps(self):
        outside = bool(self.voltages or self.friction)
        stride = (1 if self.law == "tanh" else STRIDE) if outside else STEPS
        cuts = set(range(0, STEPS, stride)) | Drive(self.causes).cuts
        cuts = sorted(cuts)
        self.pieces = list(zip(cuts, np.diff(cuts + [STEPS]).tolist()))
        self.outside = outside

    def start(self, angle):
        """Puts the robot at rest at three angles [rad]."""
        mujoco.mj_resetData(self.model, self.data)
        for joint, q in zip((1, 2, 3), angle):
            self.data.joint(f"q{joint}").qpos[0] = q
        self.drive = Drive(self.causes)
        for cause in self.causes:
            if cause.effect == "tip_force":
                body = self.model.body("tip").id
                self.data.xfrc_applied[body, :3] = cause.parameters["force_N"]
        mujoco.mj_forward(self.model, self.data)

    def counts(self):
        """What the three encoders read [counts]."""
        position = self.data.qpos.tolist()
        angle = [position[dof] for dof in self.motor_dof]
        for cause in self.readings:
            q, p = angle[cause.joint - 1], cause.parameters
            angle[cause.joint - 1] += p["amplitude_rad"] * math.sin(q + p["phase_rad"])
        return [math.floor(q * COUNTS_PER_RAD + 0.5) for q in angle]

    def advance(self, command, time):
        """A tick with a command [V] on each joint, given at `time` [s] since the log began."""
        timed = self.drive(command, time)
        data, voltage = self.data, timed[0][1]
        changed = dict(timed)
        for first, steps in self.pieces:
            voltage = changed.get(first, voltage)
            data.ctrl[:3] = voltage
            if self.outside:
                self._apply(voltage, time + first * 1e-4)
            mujoco.mj_step(self.model, data, nstep=steps)

    def _apply(self, voltage, time):
        q, v = self.data.qpos.tolist(), self.data.qvel.tolist()
        added = [0.0, 0.0, 0.0]
        for cause, of in self.voltages:
            i = cause.joint - 1
            dof = self.motor_dof[i]
            added[i] += of(cause.parameters, q[dof], v[dof], voltage[i])
        for i, played, cause in self.friction:
            dof, scale, effect, p = self.motor_dof[i], (1.0, 0.0, 1.0), "", None
            if cause is not None:
                effect, p = cause.effect, cause.parameters
                load = self.data.qfrc_bias[self.link_dof[i]]
                scale = SCALES[effect](p, q[dof], v[dof], load, time)
            added[i] += played.voltage(scale, effect, p, v[dof])
        for i in range(3):
            self.data.qfrc_applied[self.motor_dof[i]] = TORQUE_CONSTANT[i] * added[i]
