"""From MuJoCo to a diagnosis and back: what is amended predicts the robot in MuJoCo."""

import importlib.util
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from arm import model
from causes import CAUSES, SHORT
from conftest import SCALE
from round_trip import Outcome, tried

import rrr


def check(outcome: Outcome) -> None:
    assert outcome.is_found, outcome.report
    assert min(outcome.said) > 0.5
    assert outcome.holds, (outcome.said, outcome.shown)


def test_cogging_is_amended_in_the_xml(cogging: Outcome) -> None:
    check(cogging)
    assert cogging.is_native


@pytest.mark.parametrize("effect", [effect for effect in SHORT if effect != "cogging"])
def test_predictions_shrink_as_the_report_says(effect: str) -> None:
    check(tried(next(c for c in CAUSES if c.effect == effect), seed=1, scale=SCALE))


EFFECTS: list[tuple[str, int, dict[str, Any]]] = [
    *((c.effect, c.joint, c.parameters) for c in CAUSES),
    ("viscous_asymmetry", 2, {"relative_asymmetry": 0.2}),
    ("stribeck", 1, {"alpha1_V": 0.1, "stribeck_velocity_rad_per_s": 0.05}),
    ("encoder_eccentricity", 2, {"amplitude_rad": 0.05, "phase_rad": 0.3}),
    ("encoder_offset", 3, {"offset_rad": 0.1}),
    ("contact", 0, {"stiffness_N_per_m": 1000.0, "height_m": 0.9}),
    ("table", 3, {"axis": "velocity", "knots": [-1.0, 1.0], "values_V": [0.1, -0.1]}),
]


@pytest.mark.parametrize(("effect", "joint", "parameters"), EFFECTS, ids=[e[0] for e in EFFECTS])
def test_every_effect_has_a_form(
    effect: str, joint: int, parameters: dict[str, Any], tmp_path: Path
) -> None:
    """It compiles from the XML that is written, steps, and moves otherwise than without."""
    spec = model()
    content = rrr.from_mujoco(spec.compile()).to_dict()
    content["effect"] = [{"effect": effect, "joint": joint, "parameters": parameters}]
    from rrr.toml_text import toml_text

    amended = rrr.Model.parse(toml_text(content))
    files = rrr.save_mujoco(spec, amended, tmp_path / "arm.xml")
    forces = load(files[1]) if len(files) > 1 else None
    before, _ = moved(spec.compile(), None)
    after, read = moved(mujoco.MjModel.from_xml_path(str(files[0])), forces)
    names = ("turn", "shoulder", "elbow")
    shown = [read.get(name, q) for name, q in zip(names, after, strict=True)]
    assert np.isfinite(shown).all()
    assert np.abs(np.array(shown) - before).max() > 1e-5


def load(path: Path) -> Any:
    """The file of callbacks as a module."""
    place = importlib.util.spec_from_file_location("forces", path)
    assert place is not None and place.loader is not None
    module = importlib.util.module_from_spec(place)
    place.loader.exec_module(module)
    return module


def moved(m: Any, forces: Any) -> tuple[Any, dict[str, float]]:
    """Positions after half a second under a command [rad], and what encoders say otherwise."""
    data = mujoco.MjData(m)
    if forces is not None:
        forces.install(m)
    try:
        for step in range(2000):
            data.ctrl[:] = [1.3, -3.5, 0.9 * np.sin(0.01 * step)]
            mujoco.mj_step(m, data)
    finally:
        mujoco.set_mjcb_passive(None)
    q = np.array([data.joint(name).qpos[0] for name in ("turn", "shoulder", "elbow")])
    return q, forces.read(m, data) if forces is not None else {}


def test_another_model_is_refused(cogging: Outcome) -> None:
    spec = model()
    spec.joint("elbow").name = "wrist"
    with pytest.raises(rrr.Error, match="turn, shoulder, wrist(.|\n)*turn, shoulder, elbow"):
        rrr.amend_mujoco(spec, cogging.report)
