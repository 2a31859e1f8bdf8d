"""One robot, wherever it runs: fetch, hash, diagnose, store one row. What is listed as before is not fetched."""

from __future__ import annotations

import datetime
import os
import socket
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from rrr._rrr import Error
from rrr.diagnosing import diagnose
from rrr.fleet.content import Content, criteria_file, fetched, unread_key
from rrr.fleet.inventory import Robot
from rrr.fleet.listing import stamp
from rrr.fleet.row import FAILED, Row, empty_row, options_in_force, report_columns
from rrr.fleet.settings import Options
from rrr.fleet.store import Store


@dataclass(frozen=True)
class Done:
    """What became of a robot."""

    robot: str
    key: str
    state: Literal["diagnosed", "there", "failed"]
    error: str | None = None


def diagnose_robot(robot: Robot, output: str, night: datetime.date, options: Options) -> Done:
    """Diagnoses a robot and stores its row; nothing where a row of the same content is there.

    Files whose listing is that of an earlier run are not read. Whatever is wrong with the robot's
    files becomes a row with the verdict "failed". Raises only where the row cannot be stored.
    """
    store, in_force = Store(output), options_in_force(options)
    # Before the files are read: what changes meanwhile is read again by the next run.
    seen = stamp(robot, in_force)
    if known := store.has_of(seen):
        return _there(store, robot, known, night)
    with tempfile.TemporaryDirectory(prefix="rrr-") as scratch:
        try:
            content = fetched(robot, Path(scratch))
            key = content.key(robot, in_force)
        except Exception as error:
            # Stores of objects raise errors of their own kinds.
            return lost(robot, output, night, str(error) or type(error).__name__)
        if store.has(key):
            store.remember(_still(seen, robot, in_force), key)
            return _there(store, robot, key, night)
        still = _still(seen, robot, in_force)
        row = _row(robot, content, key, night, options, Path(scratch))
    store.put(row)
    store.remove(unread_key(robot.name, night))
    store.remember(still, key)
    return Done(robot.name, key, "failed" if row["error"] else "diagnosed", row["error"])


def _still(seen: str | None, robot: Robot, in_force: str) -> str | None:
    """The stamp of before the files were read, if it is theirs still."""
    return seen if seen is not None and stamp(robot, in_force) == seen else None


def lost(robot: Robot, output: str, night: datetime.date, why: str) -> Done:
    """Stores the row of a robot without a hash: its files could not be read, or its workers were lost.

    The next run tries it again; a row of its content then takes this one's place.
    """
    key = unread_key(robot.name, night)
    row = empty_row(robot, night, key) | {"verdict": FAILED, "error": why}
    Store(output).put(row)
    return Done(robot.name, key, "failed", why)


def _there(store: Store, robot: Robot, key: str, night: datetime.date) -> Done:
    """Nothing to do; a row that says that the files could not be read is no longer so."""
    store.remove(unread_key(robot.name, night))
    return Done(robot.name, key, "there")


def _row(
    robot: Robot, content: Content, key: str, night: datetime.date, options: Options, scratch: Path
) -> Row:
    row = empty_row(robot, night, key)
    row |= {"kind": robot.kind or content.kind, "worker": f"{socket.gethostname()}:{os.getpid()}"}
    cpu_s, wall_s = time.process_time(), time.monotonic()
    row |= _found(content, options, scratch)
    if row["error"]:
        # Where the robot's files come from, and not where they were copied to.
        row["error"] = row["error"].replace(str(content.folder), robot.folder.rstrip("/"))
    return row | {"cpu_s": time.process_time() - cpu_s, "wall_s": time.monotonic() - wall_s}


def _found(content: Content, options: Options, scratch: Path) -> Row:
    criteria = criteria_file(options, scratch)
    try:
        report = diagnose(
            content.folder,
            content.model,
            criteria=criteria,
            model_doubt=options.model_doubt,
            progress=False,
        )
        return report_columns(report)
    except (KeyboardInterrupt, SystemExit):
        raise
    except Error as error:
        return {"verdict": FAILED, "error": str(error)}
    except BaseException as error:
        # A panic of the compiled part is no Exception; one robot does not end the night.
        return {"verdict": FAILED, "error": f"{type(error).__name__}: {error}"}
