"""A worker of Ray that dies in the middle of a robot."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Collection, Iterator
from pathlib import Path

from rrr.fleet.unit import Done

PATIENCE_S = 10.0


class Killer:
    """Progress of a night; kills a worker that has one of these robots in hand, once, when `share` of
    all are done."""

    def __init__(self, robots: Collection[str], share: float = 0.5) -> None:
        self.robots, self.share = set(robots), share
        self.killed: str | None = None
        """The robot that it had in hand."""

    def __call__(self, count: int, total: int, done: Done) -> None:
        if count < self.share * total or self.killed is not None:
            return
        until = time.monotonic() + PATIENCE_S
        while self.killed is None and time.monotonic() < until:
            for pid, name in running(self.robots):
                os.kill(pid, signal.SIGKILL)
                self.killed = name
                print(f"killed worker {pid} at {name}, when {count} of {total} were done", flush=True)
                return


def running(robots: Collection[str]) -> Iterator[tuple[int, str]]:
    """Workers of this process's Ray that have a robot in hand: their titles are the names of tasks."""
    for place in Path("/proc").iterdir():
        if not place.name.isdigit():
            continue
        try:
            title = (place / "cmdline").read_bytes().split(b"\0")[0].decode()
        except (OSError, UnicodeDecodeError):
            continue
        name = title.removeprefix("ray::")
        if name != title and name in robots and _is_ours(int(place.name)):
            yield int(place.name), name


def _is_ours(pid: int) -> bool:
    """Whether a process descends from this one."""
    while pid > 1 and pid != os.getpid():
        try:
            status = Path(f"/proc/{pid}/status").read_text()
        except OSError:
            return False
        pid = int(status.split("PPid:")[1].split()[0])
    return pid == os.getpid()
