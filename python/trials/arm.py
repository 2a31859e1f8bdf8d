"""The arm of the trials: its MuJoCo model as its owner has it, and the robot that it is a model of."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

PERIOD_S = 1e-3
"""Of the commands."""
STEPS = 4
"""Of the engine in a period: 0.25 ms."""
TORQUE_CONSTANT = (12.0, 6.3, 3.0)
"""Nm by V of the three drives."""
MODEL = """
<mujoco model="arm">
  <compiler angle="radian"/>
  <option timestep="0.00025" integrator="implicitfast"><flag contact="disable"/></option>
  <worldbody>
    <body name="column" pos="0 0 0.5">
      <joint name="turn" axis="0 0 1" armature="0.35" damping="1.1" frictionloss="2.7"/>
      <inertial pos="0.01 0 0.05" mass="6" diaginertia="0.06 0.06 0.05"/>
      <body name="upper" pos="0 0.15 0.1">
        <joint name="shoulder" axis="0 -1 0" armature="0.25" damping="0.6" frictionloss="1.6"/>
        <inertial pos="0.09 0.03 0.01" mass="4" diaginertia="0.02 0.05 0.05"/>
        <body name="lower" pos="0.2 0.09 0">
          <joint name="elbow" axis="0 -1 0" armature="0.08" damping="0.2" frictionloss="0.6"/>
          <inertial pos="0.16 0.02 -0.01" mass="1.5" diaginertia="0.006 0.024 0.022"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor name="m1" joint="turn" gear="12" ctrlrange="-10 10"/>
    <motor name="m2" joint="shoulder" gear="6.3" ctrlrange="-10 10"/>
    <motor name="m3" joint="elbow" gear="3" ctrlrange="-10 10"/>
  </actuator>
</mujoco>
"""


def model() -> Any:
    """The owner's model, a `mujoco.MjSpec`."""
    return mujoco.MjSpec.from_string(MODEL)


def robot(rng: np.random.Generator, error: float = 0.02) -> Any:
    """The robot without causes: every parameter of the model off by `error`, rms, of itself."""
    spec = model()
    for body in spec.bodies[1:]:
        body.mass *= 1 + error * rng.standard_normal()
        body.ipos = np.array(body.ipos) * (1 + error * rng.standard_normal(3))
        body.inertia = np.array(body.inertia) * (1 + error * rng.standard_normal())
    for joint in spec.joints:
        joint.armature *= 1 + error * rng.standard_normal()
        joint.frictionloss *= 1 + error * rng.standard_normal()
        joint.damping = np.array(joint.damping) * (1 + error * rng.standard_normal())
    return spec
