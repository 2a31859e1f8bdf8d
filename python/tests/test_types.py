"""What editors and type checkers are told is so."""

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import rrr


def test_the_stubs_are_those_of_the_compiled_part() -> None:
    settings = Path(__file__).parent.parent / "pyproject.toml"
    command = [sys.executable, "-P", "-m", "mypy.stubtest", "rrr._rrr", "--ignore-disjoint-bases"]
    ran = subprocess.run([*command, "--mypy-config-file", str(settings)], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_checkers_are_told_that_there_are_types() -> None:
    assert (Path(rrr.__file__).parent / "py.typed").exists()


@pytest.mark.parametrize("name", rrr.__all__)
def test_all_that_is_public_is_described(name: str) -> None:
    found = getattr(rrr, name)
    public = [(key, value) for key, value in inspect.getmembers(found) if not key.startswith("_")]
    of_class = public if inspect.isclass(found) and found is not rrr.Error else []
    for key, value in [(name, found), *of_class]:
        is_described = callable(value) or isinstance(value, property)
        assert not is_described or inspect.getdoc(value), f"{name}.{key}"


@pytest.mark.parametrize("of", [rrr.Log, rrr.Model.inverse_dynamics])
def test_arrays_have_shapes_and_units(of: object) -> None:
    words = inspect.getdoc(of) or ""
    assert "rad" in words and "Nm" in words and ("(m, n)" in words or "m x n" in words)
