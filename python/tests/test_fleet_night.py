"""A small fleet on Ray: nothing lost, nothing twice, and what it says."""

import contextlib
import datetime
import shutil
from pathlib import Path

import duckdb
import numpy as np
import pytest
from fleet_killer import Killer
from turntables import Ills, write

from rrr.fleet import Options, Store, decide, on_ray, robots_of
from rrr.fleet.__main__ import main
from rrr.fleet.ray_engine import RETRIES, start

ray = pytest.importorskip("ray")
NIGHT = datetime.date(2026, 11, 22)
COUNT = 8
SICK, ALONE, BROKEN = 4, 6, 7
"""Robots 0 to 3 are a batch with an offset, 6 has cogging, 7 a broken log."""


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("fleet") / "2026-11-22"
    offset, cogging = np.zeros(COUNT), np.zeros(COUNT)
    offset[:SICK], cogging[ALONE] = 0.05, 0.06
    write(place, Ills(offset, cogging), ["A"] * SICK + ["B"] * (COUNT - SICK), seed=1)
    (place / f"r{BROKEN}" / "task.csv").write_text("t_s,q1_rad,u1_V\n0.0,0.1,volt\n")
    return place


@pytest.fixture(scope="module")
def night(place: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Killer]:
    """OUTPUT of a night on two workers, one of them killed with a robot in hand."""
    output = str(tmp_path_factory.mktemp("output"))
    killer = Killer([f"r{i}" for i in range(COUNT)], share=0.25)
    # Workers look for modules in the folder where Ray is started: not in the sources.
    with contextlib.chdir(place):
        start(workers=2, address=None)
        done = on_ray(robots_of(str(place)), output, NIGHT, Options(), progress=killer)
        ray.shutdown()
    assert [one.robot for one in done] == [f"r{i}" for i in range(COUNT)]
    return output, killer


def test_every_robot_has_one_row_though_a_worker_was_killed(night: tuple[str, Killer]) -> None:
    output, killer = night
    rows = {row["robot"]: row for row in Store(output).rows()}
    assert sorted(rows) == [f"r{i}" for i in range(COUNT)] and len(Store(output).rows()) == COUNT
    assert killer.killed in rows and RETRIES > 0
    assert rows[f"r{BROKEN}"]["verdict"] == "failed"
    assert "task.csv" in rows[f"r{BROKEN}"]["error"] and "volt" in rows[f"r{BROKEN}"]["error"]
    assert all(row["cpu_s"] > 0 for row in rows.values())


def test_the_same_again_computes_nothing(place: Path, night: tuple[str, Killer]) -> None:
    output, _ = night
    before = {path: path.stat().st_mtime_ns for path in Path(output, "rows").iterdir()}
    assert main([str(place), output, "--index", "0", "--of", "1"]) == 0
    assert {path: path.stat().st_mtime_ns for path in Path(output, "rows").iterdir()} == before


def test_the_alarms_are_the_batch_and_the_robot(night: tuple[str, Killer]) -> None:
    found = decide(Store(night[0]).rows(), NIGHT)
    alarms = {(a.level, a.subject, a.effect, a.joint) for a in found.alarms}
    assert alarms == {("batch", "A", "dac_offset", 1), ("robot", f"r{ALONE}", "cogging", 1)}
    assert [row["robot"] for row in found.fleet.failed] == [f"r{BROKEN}"]


def test_duckdb_opens_the_rows(night: tuple[str, Killer]) -> None:
    query = f"""
        select c.effect, c.joint, count(*) as robots
        from (select unnest(causes) as c from '{night[0]}/rows/*.parquet') group by all order by robots desc
    """
    assert duckdb.execute(query).fetchall() == [("dac_offset", 1, SICK), ("cogging", 1, 1)]


def test_the_page_tells_it(
    place: Path, night: tuple[str, Killer], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = str(tmp_path / "copy")
    shutil.copytree(night[0], output)
    assert main(["--page", output, "--night", str(NIGHT)]) == 0
    words = capsys.readouterr().out
    assert "dac offset, joint 1, common to batch A: 4 of 4 robots" in words
    page = Path(output, "fleet.html").read_text()
    assert f"r{ALONE}" in page and "volt" in page and page.count("<svg") == 3
    alarms = duckdb.execute(f"select subject from '{output}/alarms/*.parquet' where is_alarm order by 1")
    assert alarms.fetchall() == [("A",), (f"r{ALONE}",)]
