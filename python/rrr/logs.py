"""Logs that are arrays."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrr._rrr import Error
from rrr.model import Model

Columns = Sequence[tuple[str, str, str]]


@dataclass
class Log:
    """A recorded motion of n joints; row i of every array belongs to `t[i]`.

    `t` [s], m, increases; `q` [rad; m], m x n, are measured positions; `u` [V; A, Nm, N as the drives
    of the model have it], m x n, is the command that was put out during the interval that begins at
    its row; `qref` [rad; m], m x n, the reference, which is the command of a position servo. Arrays
    of one joint may have the shape (m,).

    `role` is "train" or "holdout"; where no log is held out the last 30 % of each are. `experiment`
    is a name of docs/files: "excitation", "slow", "driven-noise", "task", ...
    """

    t: ArrayLike
    q: ArrayLike
    u: ArrayLike | None = None
    qref: ArrayLike | None = None
    role: Literal["train", "holdout"] = "train"
    experiment: str = "task"

    def columns(self, name: str, names: Columns) -> dict[str, NDArray[np.float64]]:
        """The arrays by the names of a log's columns; `name` is the log's, for messages."""
        t = np.asarray(self.t, dtype=np.float64)
        if t.ndim != 1:
            raise Error(f"{name}: t has the shape {t.shape}, but must be (m,)")
        found = {"t_s": t}
        for key, place in (("q", 0), ("u", 1), ("qref", 2)):
            values = getattr(self, key)
            if values is not None:
                matrix = _matrix(f"{name}: {key}", values, len(t), len(names))
                found |= {column[place]: matrix[:, i] for i, column in enumerate(names)}
        return found


def _matrix(name: str, values: ArrayLike, rows: int, joints: int) -> NDArray[np.float64]:
    matrix = np.asarray(values, dtype=np.float64)
    if matrix.ndim == 1 and joints == 1:
        matrix = matrix[:, None]
    if matrix.shape != (rows, joints):
        raise Error(
            f"{name} has the shape {matrix.shape}, but must be ({rows}, {joints}):"
            f" as many rows as t, a column for each joint of the model"
        )
    return matrix


Logs = str | PathLike[str] | Log | Mapping[str, ArrayLike] | Sequence[Log | Mapping[str, ArrayLike]]
"""A folder with dataset.toml, or one log or several as arrays: `Log`, or a mapping with its fields."""


@contextmanager
def as_dataset(logs: Logs, model: Path) -> Iterator[Path]:
    """The folder of a data set; one of arrays is there as long as the context lasts."""
    if isinstance(logs, (str, PathLike)):
        yield Path(logs)
        return
    several = [logs] if isinstance(logs, (Log, Mapping)) else list(logs)
    if not several:
        raise Error("no log is given\nhint: give a folder, or arrays t, q, u")
    names = Model.load(model).columns
    with tempfile.TemporaryDirectory(prefix="rrr-") as folder:
        _write(Path(folder), [_log(log) for log in several], names)
        yield Path(folder)


def _log(log: Log | Mapping[str, ArrayLike]) -> Log:
    if isinstance(log, Log):
        return log
    fields = Log.__dataclass_fields__
    for key in log:
        if key not in fields:
            raise Error(f"a log has the key {key!r}\nhint: keys are {', '.join(fields)}")
    for key in ("t", "q"):
        if key not in log:
            raise Error(f"a log lacks {key!r}\nhint: it needs t, q, and u or (of servos) qref")
    return Log(**log)  # type: ignore[arg-type]


def _write(folder: Path, logs: Sequence[Log], names: Columns) -> None:
    text = "format = 1\n"
    for number, log in enumerate(logs, 1):
        name = f"log{number}.npz"
        # The index of arrays is as numpy writes it; nothing is compressed.
        np.savez(folder / name, **log.columns(name, names))  # type: ignore[arg-type]
        text += f'[[log]]\nfile = "{name}"\n'
        text += f'experiment = "{log.experiment}"\nrole = "{log.role}"\n'
    (folder / "dataset.toml").write_text(text)
