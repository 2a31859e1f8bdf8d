"""What the diagnoses of a fleet say on a night: names, and how long each has stood."""

from __future__ import annotations

import datetime
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

from rrr.fleet.row import FAILED, Row

Place = tuple[str, int]
"""An effect on a joint (0: the whole robot)."""


@dataclass(frozen=True)
class Name:
    """A cause that the diagnosis of one robot names."""

    robot: str
    kind: str
    batch: str | None
    effect: str
    joint: int
    parameters: dict[str, list[float]]
    probability: float
    share: float
    deviations: float
    since: datetime.date
    """First of the nights on which it stands without a break."""
    nights: int
    """How many nights with logs that is."""

    @property
    def place(self) -> Place:
        """Effect and joint."""
        return self.effect, self.joint


@dataclass(frozen=True)
class Fleet:
    """The last diagnosis of each robot up to a night, and all its names."""

    night: datetime.date
    rows: list[Row]
    names: list[Name]
    failed: list[Row]
    """Robots whose diagnosis of this very night failed."""

    @property
    def kinds(self) -> dict[str, list[Row]]:
        """Rows by kind of robot."""
        return _grouped(self.rows, "kind")

    def batches(self, rows: Iterable[Row]) -> dict[str, list[Row]]:
        """Rows by batch, of those that have one."""
        return _grouped([row for row in rows if row["batch"]], "batch")


def fleet_on(rows: Iterable[Row], night: datetime.date) -> Fleet:
    """What is known of the fleet on a night, from the rows up to it."""
    by_robot: dict[str, list[Row]] = defaultdict(list)
    failed = []
    for row in rows:
        if row["night"] > night:
            continue
        if row["verdict"] == FAILED:
            failed += [row] if row["night"] == night else []
        else:
            by_robot[row["robot"]].append(row)
    histories = {robot: _one_a_night(of_robot) for robot, of_robot in sorted(by_robot.items())}
    read = {history[-1]["robot"] for history in histories.values() if history[-1]["night"] == night}
    names = [name for history in histories.values() for name in _names(history)]
    failed = [row for row in failed if row["robot"] not in read]
    last = [history[-1] for history in histories.values()]
    return Fleet(night, last, names, sorted(failed, key=lambda row: row["robot"]))


def _one_a_night(rows: list[Row]) -> list[Row]:
    """The last row of each night, oldest first."""
    by_night = {row["night"]: row for row in sorted(rows, key=lambda row: row["done_at"])}
    return [by_night[night] for night in sorted(by_night)]


def _names(history: list[Row]) -> list[Name]:
    last = history[-1]
    return [_name(last, cause, _streak(history, cause)) for cause in last["causes"]]


def _streak(history: list[Row], cause: Row) -> list[Row]:
    """The nights, back from the last, on which a cause is named without a break."""
    place = cause["effect"], cause["joint"]
    standing = []
    for row in reversed(history):
        if place not in {(c["effect"], c["joint"]) for c in row["causes"]}:
            break
        standing.append(row)
    return standing


def _name(row: Row, cause: Row, standing: list[Row]) -> Name:
    return Name(
        robot=row["robot"],
        kind=row["kind"],
        batch=row["batch"],
        effect=cause["effect"],
        joint=cause["joint"],
        parameters=dict(cause["parameters"]),
        probability=cause["probability"],
        share=cause["share"],
        deviations=cause["deviations"],
        since=standing[-1]["night"],
        nights=len(standing),
    )


def _grouped(rows: Iterable[Row], column: str) -> dict[str, list[Row]]:
    groups: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        groups[row[column]].append(row)
    return dict(sorted(groups.items()))
