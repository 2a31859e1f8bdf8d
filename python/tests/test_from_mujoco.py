"""A MuJoCo model becomes a robot that needs the same torques."""

from typing import Any

import mujoco
import numpy as np
import pytest
from models import ALL, GANTRY, SERVOS

import rrr

AGREEMENT = 1e-9
"""Of the largest torque of a model."""


def passive(robot: rrr.Model, q: Any, qd: Any) -> Any:
    """Torques of viscous friction, springs and drag, as the robot's file has them."""
    content = robot.to_dict()
    torque = np.zeros_like(q)
    for j, joint in enumerate(content["joint"]):
        k = next((v for name, v in joint["drive"].items() if name.startswith("torque_")), 1.0)
        viscous = next(v for name, v in joint["friction"].items() if name.startswith("alpha2"))
        torque[j] -= abs(k) * viscous * qd[j]
        for effect in content.get("effect", []):
            if effect["joint"] == j + 1:
                torque[j] += k * _effect(effect["effect"], effect["parameters"], q[j], qd[j])
    return torque


def _effect(name: str, p: dict[str, float], q: float, qd: float) -> float:
    if name == "cable_spring":
        return -p["stiffness_V_per_rad"] * (q - p["rest_rad"])
    if name == "quadratic_drag":
        return -p["coefficient_V_s2_per_rad2"] * qd * abs(qd)
    return 0.0


@pytest.mark.parametrize("name", ALL)
def test_inverse_dynamics_are_those_of_mj_inverse(name: str) -> None:
    model = mujoco.MjModel.from_xml_string(ALL[name])
    # Dry friction and stops are constraints, which the rigid body does not have.
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    robot, data = rrr.from_mujoco(model), mujoco.MjData(model)
    rng = np.random.default_rng(3)
    q, qd, qdd = rng.uniform(-3, 3, (3, 50, model.nv))
    torques = robot.inverse_dynamics(q, qd, qdd)
    for row in range(len(q)):
        data.qpos[:], data.qvel[:], data.qacc[:] = q[row], qd[row], qdd[row]
        mujoco.mj_inverse(model, data)
        # Back-EMF is a part of the drive in the engine, and of friction here.
        own = torques[row] - passive(robot, q[row], qd[row]) + back_emf(model, qd[row])
        difference = np.abs(own - data.qfrc_inverse).max()
        assert difference < AGREEMENT * np.abs(torques).max(), (name, row)


def back_emf(model: Any, qd: Any) -> Any:
    """What damping of a voltage drive the robot counts as friction."""
    torque = np.zeros_like(qd)
    for a in range(model.nu):
        if model.actuator_gaintype[a] == int(mujoco.mjtGain.mjGAIN_DCMOTOR):
            resistance, constant = model.actuator_gainprm[a, :2]
            dof = model.jnt_dofadr[model.actuator_trnid[a, 0]]
            gear = model.actuator_gear[a, 0]
            torque[dof] -= gear**2 * constant**2 / resistance * qd[dof]
    return torque


def test_drives_are_taken_over() -> None:
    robot = rrr.from_mujoco(mujoco.MjModel.from_xml_string(GANTRY))
    x, y, turn, wrist = (joint["drive"] for joint in robot.to_dict()["joint"])
    assert x == {"kind": "voltage", "torque_constant_N_per_V": 30.0, "gear_ratio": 1.0}
    assert y["torque_constant_N_per_V"] == 40.0
    assert turn["kind"] == "position-servo"
    assert (turn["stiffness_V_per_rad"], turn["damping_V_s_per_rad"]) == (50.0, 2.0)
    assert turn["limit_V"] == 8.0
    assert wrist["torque_constant_Nm_per_V"] == pytest.approx(40 * 0.05 / 2)
    effects = {(e["effect"], e["joint"]): e["parameters"] for e in robot.to_dict()["effect"]}
    assert effects["actuator_lag", 2] == {"time_constant_s": 0.01}
    assert effects["delay", 4] == {"delay_s": 0.003}


def test_what_is_left_out_is_said() -> None:
    robot = rrr.from_mujoco(mujoco.MjModel.from_xml_string(GANTRY))
    assert any("contacts" in remark for remark in robot.remarks)
    assert not rrr.from_mujoco(mujoco.MjModel.from_xml_string(SERVOS)).remarks


@pytest.mark.parametrize(
    ("xml", "words"),
    [
        ("<worldbody><body><freejoint/><geom size='1'/></body></worldbody>", "neither hinge"),
        ("<worldbody><geom size='1'/></worldbody>", "no joint"),
        (
            "<worldbody><body name='a'><joint/><geom size='1'/></body>"
            "<body name='b'><joint/><geom size='1'/></body></worldbody>",
            "branches into the bodies a, b",
        ),
    ],
)
def test_what_is_no_chain_is_refused(xml: str, words: str) -> None:
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{xml}</mujoco>")
    with pytest.raises(rrr.Error, match=words):
        rrr.from_mujoco(model)
