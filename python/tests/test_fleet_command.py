"""What the command and the list of robots refuse, and in which words."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import FOLDER
from turntables import Ills, write

import rrr
from rrr.fleet import Store, robots_of
from rrr.fleet.__main__ import main


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nowhere", "out"], "no robots"),
        (["in"], "1 places are given"),
        (["--page", "out"], "has no rows up to"),
        (["in", "out", "--night", "yesterday"], "'yesterday' is no date"),
        (["in", "out", "--index", "3", "--of", "2"], "--index 3 is not from 0 to 1"),
        (["in", "out", "--rate", "2"], "--rate is 2.0"),
        (["in", "out", "--criteria", "none.toml"], "none.toml"),
        (["in", "nosuch://out"], "nosuch"),
    ],
)
def test_what_cannot_be_used_is_named(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in" / "r1").mkdir(parents=True)
    (tmp_path / "in" / "r1" / "dataset.toml").write_text("format = 1\n")
    assert main(arguments) == 2
    message = capsys.readouterr().err
    assert message.startswith("error: ") and words in message


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("name,batch\nr1,A\n", "lacks the column 'robot'"),
        ("robot,colour\nr1,red\n", "has the column 'colour'"),
        ("robot,batch\nr1,A\nr1,B\n", "'r1' twice"),
        ("robot,batch\n,A\n", "line 2"),
        ("robot\nr1,A\n", "line 2"),
        ("", "lacks the column 'robot'"),
    ],
)
def test_a_list_that_cannot_be_used_is_named(table: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "fleet.csv").write_text(table)
    with pytest.raises(rrr.Error, match=words):
        robots_of(str(tmp_path))


def test_a_list_tells_folders_models_kinds_and_batches(tmp_path: Path) -> None:
    table = "robot,folder,model,kind,batch\nr2,deep/r2,models/a.toml,arm,A\nr1,s3://lake/r1,,,\n"
    (tmp_path / "fleet.csv").write_text(table)
    first, second = robots_of(str(tmp_path))
    assert (first.name, first.folder, first.model, first.batch) == ("r1", "s3://lake/r1", None, None)
    place = f"file://{tmp_path}"
    assert (second.folder, second.model) == (f"{place}/deep/r2", f"{place}/models/a.toml")
    assert (second.kind, second.batch) == ("arm", "A")


def test_an_array_of_slurm_does_every_robot_once(tmp_path: Path) -> None:
    write(tmp_path / "in", Ills(np.zeros(3), np.zeros(3)), ["A"] * 3, seed=4)
    told = {"INPUT": str(tmp_path / "in"), "OUTPUT": str(tmp_path / "out"), "NIGHT": "2026-11-22"}
    told |= {"SLURM_ARRAY_TASK_MIN": "5", "SLURM_ARRAY_TASK_COUNT": "2"}
    told |= {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    for task in ("5", "6"):
        environment = os.environ | told | {"SLURM_ARRAY_TASK_ID": task}
        # Not in the sources, whose folder would hide the installed module.
        command = ["bash", str(FOLDER / "examples" / "fleet.slurm")]
        subprocess.run(command, check=True, env=environment, cwd=tmp_path)
    rows = Store(str(tmp_path / "out")).rows()
    assert sorted(row["robot"] for row in rows) == ["r0", "r1", "r2"]
    assert {str(row["night"]) for row in rows} == {"2026-11-22"}
