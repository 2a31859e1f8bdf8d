"""A robot's files at hand, and the hash of their content."""

from __future__ import annotations

import hashlib
import posixpath
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rrr._rrr import Error
from rrr.fleet.inventory import Robot
from rrr.fleet.places import filesystem, is_local
from rrr.fleet.settings import Options

MODEL = "model.toml"


@dataclass(frozen=True)
class Content:
    """The folder of a data set and the model's file, on this machine."""

    folder: Path
    model: Path

    @property
    def files(self) -> list[tuple[str, Path]]:
        """Every file with the name under which it is hashed, sorted; hidden ones do not count."""
        own = [(path.relative_to(self.folder).as_posix(), path) for path in self.folder.rglob("*")]
        shown = [(name, path) for name, path in own if path.is_file() and not _is_hidden(name)]
        beside = [("../" + path.name, path) for path in _model_files(self.model)]
        return sorted(shown if self.model.is_relative_to(self.folder) else shown + beside)

    @property
    def kind(self) -> str:
        """The name that the model's file gives its robots, or else the beginning of its SHA-256."""
        name = _robot_table(_text(self.model)).get("name")
        return name if isinstance(name, str) else hashlib.sha256(self.model.read_bytes()).hexdigest()[:12]

    def key(self, robot: Robot, in_force: str) -> str:
        """SHA-256 over names and bytes of all files, the robot's name, kind, batch, version and options."""
        found = hashlib.sha256()
        for text in (robot.name, robot.kind or "", robot.batch or "", in_force):
            _add(found, text.encode())
        for name, path in self.files:
            _add(found, name.encode())
            with path.open("rb") as file:
                found.update(hashlib.file_digest(file, "sha256").digest())
        return found.hexdigest()


def fetched(robot: Robot, scratch: Path) -> Content:
    """A robot's files; what is not on this machine is copied below `scratch`.

    Raises `rrr.Error` where the folder or the model is not there, and what fsspec raises.
    """
    folder = _folder(robot.folder, scratch / "logs")
    if robot.model is not None:
        return Content(folder, _model(robot.model, scratch))
    if (folder / MODEL).exists():
        return Content(folder, folder / MODEL)
    beside = posixpath.join(posixpath.dirname(robot.folder.rstrip("/")), MODEL)
    return Content(folder, _model(beside, scratch))


def criteria_file(options: Options, scratch: Path) -> Path | None:
    """The thresholds as a file, for `rrr.diagnose`."""
    if options.criteria is None:
        return None
    path = scratch / "criteria.toml"
    path.write_text(options.criteria)
    return path


def unread_key(name: str, night: object) -> str:
    """The key of a robot whose files could not be read, so that they have no hash."""
    return "unread-" + hashlib.sha256(f"{name}\n{night}".encode()).hexdigest()[:56]


def _folder(place: str, copy: Path) -> Path:
    fs, path = filesystem(place)
    if not fs.isdir(path):
        raise Error(f"{place} is no folder\nhint: each robot is a folder with dataset.toml and its logs")
    if is_local(fs):
        return Path(path)
    fs.get(path + "/", f"{copy}/", recursive=True)
    return copy


def _model(place: str, scratch: Path) -> Path:
    fs, path = filesystem(place)
    if not fs.isfile(path):
        raise Error(f"{place} is not there\nhint: put {MODEL} into the robot's folder, or beside the folders")
    if is_local(fs):
        return Path(path)
    copy = scratch / "model" / posixpath.basename(path)
    copy.parent.mkdir()
    fs.get_file(path, str(copy))
    for name in _urdf(copy):
        fs.get_file(posixpath.join(posixpath.dirname(path), name), str(copy.parent / name))
    return copy


def _model_files(model: Path) -> list[Path]:
    return [model, *(model.parent / name for name in _urdf(model) if (model.parent / name).is_file())]


def urdf_of(model: str) -> list[str]:
    """The URDF that the text of a model names."""
    name = _robot_table(model).get("urdf")
    return [name] if isinstance(name, str) and "/" not in name else []


def _urdf(model: Path) -> list[str]:
    return urdf_of(_text(model))


def _text(model: Path) -> str:
    """A model's text; nothing where it cannot be read, which the diagnosis tells."""
    try:
        return model.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return ""


def _robot_table(model: str) -> dict[str, Any]:
    """`[robot]` of a model's text; nothing where it is no TOML, which the diagnosis tells."""
    try:
        table = tomllib.loads(model).get("robot")
    except tomllib.TOMLDecodeError:
        return {}
    return table if isinstance(table, dict) else {}


def _is_hidden(name: str) -> bool:
    return any(part.startswith(".") for part in name.split("/"))


def _add(found: Any, content: bytes) -> None:
    # The length tells where a name ends.
    found.update(len(content).to_bytes(8, "little") + content)
