"""What is set in an amended MuJoCo model is what `from_mujoco` finds in it."""

from typing import Any

import mujoco
import numpy as np
import pytest
from models import ALL, LUGRE

import rrr
from rrr.toml_text import toml_text

CHAINS = {name: xml for name, xml in ALL.items() if name != "gantry"} | {"lugre": LUGRE}


def changed(content: dict[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The same robot with every number of links, rotors and friction up to 5 % off."""
    for joint in content["joint"]:
        for name, value in joint.items():
            if name in ("mass_kg", "armature_kg_m2"):
                joint[name] = value * rng.uniform(0.95, 1.05)
            elif name in ("com_m", "inertia_kg_m2"):
                joint[name] = [float(x) * rng.uniform(0.99, 1.01) for x in value]
        joint["friction"] = {n: v * rng.uniform(0.95, 1.05) for n, v in joint["friction"].items()}
    return content


def assert_same(found: Any, wanted: Any, where: str = "") -> None:
    """Numbers within 1e-9 of their size, whatever the nesting."""
    if isinstance(wanted, dict):
        assert set(found) == set(wanted), where
        for key in wanted:
            assert_same(found[key], wanted[key], f"{where}.{key}")
    elif isinstance(wanted, list):
        for place, (a, b) in enumerate(zip(found, wanted, strict=True)):
            assert_same(a, b, f"{where}[{place}]")
    elif isinstance(wanted, float):
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9), where
    else:
        assert found == wanted, where


@pytest.mark.parametrize("name", CHAINS)
def test_parameters_are_set(name: str) -> None:
    spec = mujoco.MjSpec.from_string(CHAINS[name])
    given = rrr.from_mujoco(spec.compile())
    content = changed(given.to_dict(), np.random.default_rng(4))
    amended = rrr.amend_mujoco(spec, rrr.Model.parse(toml_text(content)))
    # As the XML has it, with the digits that it has.
    found = rrr.from_mujoco(mujoco.MjModel.from_xml_string(amended.to_xml())).to_dict()
    assert rrr.mujoco_forces(spec, rrr.Model.parse(toml_text(content))) is None
    for joint, wanted in zip(found["joint"], content["joint"], strict=True):
        joint.pop("name"), wanted.pop("name")
        joint.pop("origin_rpy_rad"), wanted.pop("origin_rpy_rad")
        for tables in (joint, wanted):
            tables["com_m"] = [round(x, 6) for x in tables["com_m"]]
        same = {key: joint[key] for key in ("mass_kg", "friction", "drive")}
        assert_close(same, {key: wanted[key] for key in same})
        assert_close(joint["inertia_kg_m2"], wanted["inertia_kg_m2"], 1e-5)


def assert_close(found: Any, wanted: Any, within: float = 1e-4) -> None:
    """Numbers as XML has them, with six digits."""
    if isinstance(wanted, dict):
        for key in wanted:
            assert_close(found[key], wanted[key], within)
    elif isinstance(wanted, list):
        assert found == pytest.approx(wanted, abs=within)
    elif isinstance(wanted, float):
        assert found == pytest.approx(wanted, rel=within)
    else:
        assert found == wanted


@pytest.mark.parametrize("name", CHAINS)
def test_a_model_that_is_right_stays_as_it_is(name: str) -> None:
    spec = mujoco.MjSpec.from_string(CHAINS[name])
    given = rrr.from_mujoco(spec.compile())
    amended = rrr.amend_mujoco(spec, given)
    found = rrr.from_mujoco(amended.compile()).to_dict()
    wanted = given.to_dict()
    # Joints without a name keep none; the order of rounding differs.
    for joint in found["joint"] + wanted["joint"]:
        joint["origin_rpy_rad"] = [round(x, 9) + 0.0 for x in joint["origin_rpy_rad"]]
    assert_same(found, wanted)
