"""The examples run."""

import subprocess
import sys
from pathlib import Path

import nbformat
from conftest import FOLDER
from nbclient import NotebookClient
from recorder import Recording
from test_diagnosis import given

import rrr

__all__ = ["given"]


def test_the_notebook_runs(tmp_path: Path) -> None:
    notebook = nbformat.read(FOLDER / "examples" / "mujoco.ipynb", as_version=4)
    resources = {"metadata": {"path": str(tmp_path)}}
    NotebookClient(notebook, timeout=300, resources=resources).execute()
    shown = "".join(str(cell.get("outputs")) for cell in notebook.cells)
    assert "cogging" in shown and "payload" in shown and "<iframe" in shown
    assert (tmp_path / "amended.xml").exists()


def test_the_typed_example_runs(
    recordings: list[Recording], given: rrr.Model, tmp_path: Path
) -> None:
    given.write(tmp_path / "model.toml")
    command = [sys.executable, str(FOLDER / "examples" / "typed.py"), str(tmp_path / "nowhere")]
    command += [str(tmp_path / "model.toml"), str(tmp_path / "out")]
    ran = subprocess.run(command, capture_output=True, text=True)
    assert ran.returncode == 1
    # Before it a line of progress that has been taken away.
    assert "error: " in ran.stderr and "hint: " in ran.stderr
