"""Robot and model files from Python."""

from pathlib import Path

import numpy as np
import pytest

import rrr

PENDULUM = """
format = 2
[robot]
gravity_m_s2 = [0.0, 0.0, -9.81]
[[joint]]
kind = "revolute"
axis = [0.0, 1.0, 0.0]
mass_kg = 2.0
com_m = [0.5, 0.0, 0.0]
inertia_kg_m2 = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
[joint.drive]
kind = "torque"
"""


def test_a_pendulum_needs_the_torques_that_a_textbook_says() -> None:
    model = rrr.Model.parse(PENDULUM)
    q = np.linspace(-3, 3, 7)[:, None]
    torque = model.inverse_dynamics(q, np.zeros_like(q), np.ones_like(q))
    assert torque == pytest.approx(0.5 - 2 * 9.81 * 0.5 * np.cos(q))
    assert model.inverse_dynamics([0.0], [0.0], [0.0]).shape == (1,)
    assert model.columns == [("q1_rad", "u1_Nm", "qref1_rad")]


def test_shapes_that_do_not_fit_are_named() -> None:
    model = rrr.Model.parse(PENDULUM)
    with pytest.raises(rrr.Error, match=r"q has the shape \[3\], but must be \(1,\) or \(m, 1\)"):
        model.inverse_dynamics(np.zeros(3), np.zeros(3), np.zeros(3))
    with pytest.raises(rrr.Error, match="qd has the shape"):
        model.inverse_dynamics(np.zeros((3, 1)), np.zeros((2, 1)), np.zeros((3, 1)))


def test_files_are_read_as_they_were_written(tmp_path: Path) -> None:
    model = rrr.Model.parse(PENDULUM)
    model.write(tmp_path / "robot.toml")
    assert rrr.Model.load(tmp_path / "robot.toml").to_dict() == model.to_dict()


def test_a_text_that_is_wrong_is_named_with_its_line() -> None:
    with pytest.raises(rrr.Error, match=r"arm\.toml, line 6(.|\n)*kind"):
        rrr.Model.parse(PENDULUM.replace("revolute", "wheel"), "arm.toml")
