"""What a listing says of a robot's files: whether they are those of an earlier run, without reading the logs.

A store of objects lists a tag that stands for an object's content. A file system lists sizes and times of
change, which tell as much unless a file is changed twice within the clock's step; so files that have just
been written are not judged by them.
"""

from __future__ import annotations

import datetime
import hashlib
import json
import posixpath
import time
from typing import Any

from rrr.fleet.content import MODEL, urdf_of
from rrr.fleet.inventory import Robot
from rrr.fleet.places import filesystem

TAGS = ("ETag", "etag", "md5Hash", "generation")
"""What stands for an object's content: of S3, GCS and others."""
TIMES = ("mtime", "LastModified", "last_modified", "updated")
"""When a file was changed, by names that file systems of fsspec give it."""
CREATED = "created"
"""When its entry was changed, on a local disk; elsewhere when it was made, which alone tells nothing."""
YOUNGEST_S = 2.0
"""Files changed so shortly ago are not judged by their times."""


def stamp(robot: Robot, in_force: str) -> str | None:
    """SHA-256 over what is listed of a robot's files, the text of a model beside them, and options.

    None where that does not tell whether contents are the same, or where nothing can be listed.
    """
    try:
        marks = _marks(robot)
    except Exception:
        # Stores of objects raise errors of their own kinds; reading the files tells what is wrong.
        return None
    if not marks or None in marks:
        return None
    whole = [robot.name, robot.kind, robot.batch, robot.folder, robot.model, in_force, marks]
    return hashlib.sha256(json.dumps(whole).encode()).hexdigest()


def _marks(robot: Robot) -> list[Any]:
    fs, root = filesystem(robot.folder)
    fs.invalidate_cache()
    listing: dict[str, Any] = fs.find(root, detail=True)
    marks = [_mark(path, info) for path, info in sorted(listing.items())]
    if robot.model is not None:
        return marks + _of_model(robot.model)
    if f"{root}/{MODEL}" in listing:
        return marks
    return marks + _of_model(posixpath.join(posixpath.dirname(robot.folder.rstrip("/")), MODEL))


def _of_model(place: str) -> list[Any]:
    """The text of a model outside the folder, and what is listed of the URDF that it names."""
    fs, path = filesystem(place)
    text: str = fs.cat_file(path).decode()
    beside = [posixpath.join(posixpath.dirname(path), name) for name in urdf_of(text)]
    return [text, *(_mark(urdf, fs.info(urdf)) for urdf in beside if fs.isfile(urdf))]


def _mark(path: str, info: dict[str, Any]) -> list[Any] | None:
    """A file's path, size and tags or times; None where they do not stand for its content."""
    tags = [str(info[name]) for name in TAGS if info.get(name)]
    if tags:
        return [path, info["size"], *tags]
    times = [_seconds(info[name]) for name in TIMES if info.get(name)]
    if times and info.get(CREATED):
        times.append(_seconds(info[CREATED]))
    is_told = times and not info.get("islink") and max(times) < time.time() - YOUNGEST_S
    return [path, info["size"], info.get("ino"), *times] if is_told else None


def _seconds(moment: Any) -> float:
    """Seconds of the epoch."""
    return moment.timestamp() if isinstance(moment, datetime.datetime) else float(moment)
