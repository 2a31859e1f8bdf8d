"""A joint with MuJoCo's own LuGre friction, cogging, spring and stop: recorded there, identified, diagnosed."""

from typing import Any

import mujoco
import numpy as np
import pytest

import rrr

PENDULUM = """
<mujoco model="pendulum">
  <compiler angle="radian"/>
  <option timestep="0.0002" integrator="implicitfast"><flag contact="disable"/></option>
  <worldbody>
    <body>
      <joint name="swing" axis="0 1 0" armature="0.05" {joint}/>
      <inertial pos="0.15 0 0" mass="1.2" diaginertia="0.002 0.01 0.01"/>
    </body>
  </worldbody>
  <actuator>
    <motor joint="swing" gear="3" ctrlrange="-8 8"/>
    <dcmotor joint="swing" input="none" resistance="1" motorconst="0 0" damping="0.2" {motor}
      lugre="900 3 {coulomb} {static} 0.02"/>
  </actuator>
</mujoco>
"""
PERIOD_S, STEPS, SECONDS = 1e-3, 5, 6.0
COUNT_RAD = 2 * np.pi / 655360
NOISE_V = 0.003
PLANS = (("excitation", 1.2, "train"), ("slow", 0.3, "train"), ("task", 0.8, "holdout"))
"""Logs: experiment, fastest sine of the reference [Hz], role."""


def pendulum(more_friction: float = 0.0, joint: str = "", motor: str = "") -> Any:
    """The compiled model with so much more friction, in parts, and what else is hidden."""
    levels = {"coulomb": 0.6 * (1 + more_friction), "static": 0.8 * (1 + more_friction)}
    return mujoco.MjModel.from_xml_string(PENDULUM.format(joint=joint, motor=motor, **levels))


def recorded(m: Any, seed: int) -> list[rrr.Log]:
    """Its logs under a PD loop."""
    rng = np.random.default_rng(seed)
    return [_log(m, rng, *plan) for plan in PLANS]


def _log(m: Any, rng: np.random.Generator, experiment: str, fastest_hz: float, role: str) -> rrr.Log:
    t = np.arange(round(SECONDS / PERIOD_S)) * PERIOD_S
    reference = _reference(t, fastest_hz, rng)
    speeds, noise = np.gradient(reference, t), NOISE_V * rng.standard_normal(len(t))
    data = mujoco.MjData(m)
    data.qpos[0] = before = reference[0]
    q, u, speed = np.empty(len(t)), np.empty(len(t)), 0.0
    for k in range(len(t)):
        q[k] = round(data.qpos[0] / COUNT_RAD) * COUNT_RAD
        speed += 0.5 * ((q[k] - before) / PERIOD_S - speed)
        before = q[k]
        u[k] = np.clip(14 * (reference[k] - q[k]) + 1.2 * (speeds[k] - speed), -8, 8)
        data.ctrl[0] = u[k] + noise[k]
        mujoco.mj_step(m, data, STEPS)
    return rrr.Log(t, q, u, role=role, experiment=experiment)  # type: ignore[arg-type]


def _reference(t: Any, fastest_hz: float, rng: np.random.Generator) -> Any:
    """Five sines, 1.8 rad either way."""
    parts = zip((0.2, 0.37, 0.55, 0.8, 1.0), rng.uniform(-3, 3, 5), strict=True)
    sines = [np.sin(2 * np.pi * fastest_hz * p * t + phase) / (1 + 2 * p) for p, phase in parts]
    return 1.8 * sum(sines) / np.abs(sum(sines)).max()


@pytest.fixture(scope="module")
def given() -> rrr.Model:
    return rrr.from_mujoco(pendulum(), sample_period_s=PERIOD_S)


def diagnosed(given: rrr.Model, **hidden: str) -> rrr.Report:
    """The report on a robot with 3 % more friction than its model."""
    logs = recorded(pendulum(0.03, **hidden), seed=2)
    return rrr.diagnose(logs, given, model_doubt=0.03, progress=False)


def test_friction_is_identified(given: rrr.Model) -> None:
    found = rrr.identify(recorded(pendulum(0.07), seed=1), given, progress=False)
    friction = found.to_dict()["joint"][0]["friction"]
    assert friction["alpha0_V"] == pytest.approx(1.07 * 0.2, rel=0.03)
    assert friction["alpha2_V_s_per_rad"] == pytest.approx(0.2 / 3, rel=0.03)


def test_where_nothing_is_hidden_nothing_is_found(given: rrr.Model) -> None:
    report = diagnosed(given)
    assert (report.verdict, report.causes) == ("none", [])
    # The model's friction is that of the engine: refitted, noise alone is left.
    assert report.gap["refitted_V"][0] < 1.1 * report.gap["noise_floor_V"][0]


def test_cogging_of_the_motor_is_named(given: rrr.Model) -> None:
    report = diagnosed(given, motor='cogging="0.12 7 0.3"')
    (cause,) = report.causes
    assert (report.verdict, cause.effect, cause.parameters["harmonic"]) == ("effect", "cogging", 7)
    assert cause.parameters["amplitude_V"] == pytest.approx(0.12 / 3, rel=0.01)
    assert cause.share > 0.99


def test_a_spring_of_the_joint_is_named(given: rrr.Model) -> None:
    report = diagnosed(given, joint='stiffness="0.4" springref="0.3"')
    (cause,) = report.causes
    assert (report.verdict, cause.effect) == ("effect", "cable_spring")
    assert cause.parameters["stiffness_V_per_rad"] == pytest.approx(0.4 / 3, rel=0.05)
    assert cause.parameters["rest_rad"] == pytest.approx(0.3, abs=0.02)


def test_a_stop_that_no_effect_tells_is_placed_and_not_named(given: rrr.Model) -> None:
    report = diagnosed(given, joint='limited="true" range="-1.2 9" solreflimit="0.01 1"')
    assert (report.verdict, report.causes) == ("unknown", [])
    assert (report.remainder[0].joint, report.remainder[0].axis) == (1, "position")
