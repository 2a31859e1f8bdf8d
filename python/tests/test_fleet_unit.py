"""One robot's unit of work: keys, rows, stores."""

import datetime
from pathlib import Path

import fsspec
import numpy as np
import pytest
from turntables import Ills, write

import rrr
from rrr.fleet import Options, Robot, Store, diagnose_robot, robots_of
from rrr.fleet.unit import lost

NIGHT = datetime.date(2026, 11, 22)


@pytest.fixture
def robot(tmp_path: Path) -> Robot:
    write(tmp_path / "in", Ills(np.array([0.05]), np.zeros(1)), ["A"], seed=2)
    return robots_of(str(tmp_path / "in"))[0]


def test_the_row_is_the_report(robot: Robot, tmp_path: Path) -> None:
    done = diagnose_robot(robot, str(tmp_path / "out"), NIGHT, Options())
    row = Store(str(tmp_path / "out")).rows()[0]
    folder = tmp_path / "in" / "r0"
    report = rrr.diagnose(folder, tmp_path / "in" / "model.toml", progress=False)
    assert (row["key"], row["verdict"]) == (done.key, report.verdict)
    assert (row["kind"], row["batch"]) == ("turntable", "A")
    cause, named = report.causes[0], row["causes"][0]
    assert (named["effect"], named["share"]) == (cause.effect, cause.share)
    assert dict(named["parameters"]) == {"offset_V": [cause.parameters["offset_V"]]}
    assert named["deviations"] > 20
    assert row["refitted"] == report.gap["refitted_V"]


def test_the_key_is_that_of_the_content(robot: Robot, tmp_path: Path) -> None:
    output, log = str(tmp_path / "out"), tmp_path / "in" / "r0" / "slow.csv"
    first = diagnose_robot(robot, output, NIGHT, Options())
    assert diagnose_robot(robot, output, NIGHT + datetime.timedelta(1), Options()).state == "there"
    assert diagnose_robot(robot, output, NIGHT, Options(model_doubt=0.05)).key != first.key
    log.write_text("\n".join(log.read_text().splitlines()[:-1]) + "\n")
    assert diagnose_robot(robot, output, NIGHT, Options()).key != first.key
    assert len(Store(output).rows()) == 3


def test_objects_in_memory_are_as_files(robot: Robot, tmp_path: Path) -> None:
    fs = fsspec.filesystem("memory")
    fs.put(str(tmp_path / "in"), "/lake/", recursive=True)
    far = next(r for r in robots_of("memory://lake/in") if r.name == robot.name)
    done = diagnose_robot(far, "memory://lake/out", NIGHT, Options())
    near = diagnose_robot(robot, str(tmp_path / "out"), NIGHT, Options())
    assert (done.state, done.key) == ("diagnosed", near.key)
    assert diagnose_robot(far, "memory://lake/out", NIGHT, Options()).state == "there"
    assert Store("memory://lake/out").rows()[0]["causes"] == Store(str(tmp_path / "out")).rows()[0]["causes"]
    fs.rm("/lake", recursive=True)


def test_a_robot_that_could_not_be_read_is_tried_again(robot: Robot, tmp_path: Path) -> None:
    output, folder = str(tmp_path / "out"), tmp_path / "in" / "r0"
    folder.rename(tmp_path / "away")
    assert "is no folder" in str(diagnose_robot(robot, output, NIGHT, Options()).error)
    lost(robot, output, NIGHT, "its worker was lost")
    assert [row["verdict"] for row in Store(output).rows()] == ["failed"]
    (tmp_path / "away").rename(folder)
    assert diagnose_robot(robot, output, NIGHT, Options()).state == "diagnosed"
    assert [row["verdict"] for row in Store(output).rows()] == ["effect"]


def test_packed_rows_are_the_same_and_still_there(robot: Robot, tmp_path: Path) -> None:
    output = str(tmp_path / "out")
    diagnose_robot(robot, output, NIGHT, Options())
    store, before = Store(output), Store(output).rows()
    assert store.pack(before=NIGHT) == 0
    assert store.pack(before=NIGHT + datetime.timedelta(1)) == 1
    assert not list(Path(output, "rows").iterdir()) and Store(output).rows() == before
    assert diagnose_robot(robot, output, NIGHT, Options()).state == "there"


def test_what_is_no_row_is_named(robot: Robot, tmp_path: Path) -> None:
    store = Store(str(tmp_path / "out"))
    store.write("rows/strange.parquet", b"nothing")
    with pytest.raises(rrr.Error, match=r"strange\.parquet(.|\n)*hint: "):
        store.rows()
    (tmp_path / "file").write_text("")
    with pytest.raises(rrr.Error, match=r"file/rows(.|\n)*hint: "):
        Store(str(tmp_path / "file")).write("rows/a.parquet", b"")
