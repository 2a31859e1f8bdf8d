"""One robot's unit of work: keys, rows, stores."""

import datetime
import os
from collections.abc import Callable
from pathlib import Path

import fsspec
import numpy as np
import pytest
from turntables import Ills, write

import rrr
from rrr.fleet import Done, Options, Robot, Store, diagnose_robot, listing, robots_of, unit
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


@pytest.fixture
def unread(monkeypatch: pytest.MonkeyPatch) -> Callable[[], None]:
    """From its call on, a robot whose files are read could not be read."""
    monkeypatch.setattr(listing, "YOUNGEST_S", 0.0)

    def refuse(*_: object) -> None:
        raise OSError("read again")

    return lambda: monkeypatch.setattr(unit, "fetched", refuse)


def test_files_that_are_listed_as_before_are_not_read(
    robot: Robot, tmp_path: Path, unread: Callable[[], None]
) -> None:
    output, log = str(tmp_path / "out"), tmp_path / "in" / "r0" / "slow.csv"
    first = diagnose_robot(robot, output, NIGHT, Options())
    unread()
    assert diagnose_robot(robot, output, NIGHT, Options()) == Done(robot.name, first.key, "there")
    assert "read again" in str(diagnose_robot(robot, output, NIGHT, Options(model_doubt=0.05)).error)
    # Of the same size and dated back, as a copy is that keeps its times.
    before, text = log.stat(), log.read_text()
    log.write_text(text[:-2] + ("1" if text[-2] == "0" else "0") + "\n")
    os.utime(log, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert log.stat().st_size == before.st_size
    assert "read again" in str(diagnose_robot(robot, output, NIGHT, Options()).error)


def test_a_model_beside_the_robots_is_part_of_what_is_listed(
    robot: Robot, tmp_path: Path, unread: Callable[[], None]
) -> None:
    output, model = str(tmp_path / "out"), tmp_path / "in" / "model.toml"
    diagnose_robot(robot, output, NIGHT, Options())
    unread()
    model.write_text(model.read_text() + "# as good as new\n")
    assert "read again" in str(diagnose_robot(robot, output, NIGHT, Options()).error)


def test_files_just_written_are_judged_by_their_content_alone(robot: Robot, tmp_path: Path) -> None:
    for path in tmp_path.rglob("*.csv"):
        path.touch()
    assert listing.stamp(robot, "") is None
    assert diagnose_robot(robot, str(tmp_path / "out"), NIGHT, Options()).state == "diagnosed"
    assert not (tmp_path / "out" / "seen").exists()


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
