"""The robots below INPUT."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from typing import Any

from rrr._rrr import Error
from rrr.fleet.places import filesystem, used

TABLE = "fleet.csv"
"""The list of robots in INPUT; without it each folder with a dataset.toml is a robot."""
COLUMNS = ("robot", "folder", "model", "kind", "batch")


@dataclass(frozen=True)
class Robot:
    """A robot: its name, the folder or URL of its data set, its model, its kind and its batch.

    `model` is a file or URL; where it is None, `model.toml` in the robot's folder is meant, or else
    the one beside the folder. Robots of one `kind` have one design; where it is None the model tells
    it. Robots of one `batch` were made alike.
    """

    name: str
    folder: str
    model: str | None = None
    kind: str | None = None
    batch: str | None = None


def robots_of(place: str) -> list[Robot]:
    """The robots of a folder or URL, by name.

    Raises `rrr.Error` where there are none, or where its fleet.csv cannot be used.
    """
    fs, root = filesystem(place)
    table, whole = f"{root}/{TABLE}", fs.unstrip_protocol(root)
    with used(place, "INPUT is a folder or a URL of fsspec"):
        if fs.exists(table):
            robots = _listed(fs.cat_file(table), whole)
        else:
            robots = [Robot(_last(path), fs.unstrip_protocol(path)) for path in _folders(fs, root)]
    if not robots:
        raise Error(
            f"{place}: no robots\nhint: each robot is a folder with dataset.toml and its logs,"
            f" or a line of {TABLE}"
        )
    return sorted(robots, key=lambda robot: robot.name)


def one_robot(folder: str, model: str | None, kind: str | None, batch: str | None) -> Robot:
    """The robot of one folder or URL."""
    return Robot(_last(folder.rstrip("/")), folder, model, kind, batch)


def _folders(fs: Any, root: str) -> list[str]:
    found: list[str] = fs.glob(f"{root}/*/dataset.toml")
    return [path.rsplit("/", 1)[0] for path in found]


def _last(path: str) -> str:
    return path.rsplit("/", 1)[-1]


def _listed(content: bytes, place: str) -> list[Robot]:
    table = f"{place}/{TABLE}"
    try:
        reader = csv.DictReader(io.StringIO(content.decode("utf-8-sig")), strict=True)
        rows = list(reader)
    except (UnicodeDecodeError, csv.Error) as error:
        raise Error(f"{table}: {error}\nhint: it is a CSV in UTF-8") from error
    _check_columns(table, list(reader.fieldnames or []))
    robots = [_robot(table, number, row, place) for number, row in enumerate(rows, 2)]
    _check_once(table, robots)
    return robots


def _check_columns(table: str, names: list[str]) -> None:
    unknown = [name for name in names if name not in COLUMNS]
    if "robot" not in names or unknown:
        wrong = f"has the column {unknown[0]!r}" if "robot" in names else "lacks the column 'robot'"
        raise Error(f"{table} {wrong}\nhint: columns are {', '.join(COLUMNS)}; all but robot may lack")


def _robot(table: str, line: int, row: dict[str, str | None], place: str) -> Robot:
    name = (row.get("robot") or "").strip()
    if not name or None in row:
        raise Error(f"{table}, line {line}: a robot without a name, or too many columns")
    folder = _below(place, row.get("folder") or name)
    model = row.get("model")
    model = _below(place, model) if model else None
    return Robot(name, folder, model, row.get("kind") or None, row.get("batch") or None)


def _below(place: str, path: str) -> str:
    is_whole = "://" in path or path.startswith("/")
    return path if is_whole else f"{place}/{path}"


def _check_once(table: str, robots: list[Robot]) -> None:
    names = set()
    for robot in robots:
        if robot.name in names:
            raise Error(f"{table} has the robot {robot.name!r} twice")
        names.add(robot.name)
