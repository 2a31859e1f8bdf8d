"""What is known of a robot: a robot.toml or model.toml."""

from __future__ import annotations

import tempfile
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrr import _rrr


class Model:
    """A robot or model file: rigid bodies, drives, friction, effects.

    `remarks` is what those who made it say of it, in sentences.
    """

    def __init__(self, file: _rrr.Model, remarks: list[str] | None = None) -> None:
        self._file = file
        self.remarks = remarks or []

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Model:
        """Reads a robot.toml or model.toml of format 1 or 2.

        Raises `rrr.Error` with file, line and remedy where it cannot be used.
        """
        return cls(_rrr.Model.load(path))

    @classmethod
    def parse(cls, text: str, name: str = "model.toml") -> Model:
        """Reads the text of such a file; `name` stands for it in messages."""
        return cls(_rrr.Model.parse(text, name))

    def to_toml(self) -> str:
        """The file's text."""
        return self._file.to_toml()

    def to_dict(self) -> dict[str, Any]:
        """The file's tables and keys."""
        return tomllib.loads(self.to_toml())

    def write(self, path: str | PathLike[str]) -> None:
        """Writes the file, whole or not at all."""
        self._file.write(path)

    @property
    def columns(self) -> list[tuple[str, str, str]]:
        """Names of a log's columns, joint by joint: position, command, reference."""
        return [(q, u, r) for q, u, r in self._file.columns()]

    def inverse_dynamics(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike
    ) -> NDArray[np.float64]:
        """Torques that a motion needs of the rigid body, rotors included, without friction.

        `q` [rad; m of prismatic joints], `qd` [rad/s; m/s] and `qdd` [rad/s^2; m/s^2] have the shape
        (n,) or (m, n) of n joints; torques [Nm; N] come in the same. Arrays of 64-bit floats are
        taken without a copy.
        """
        motion = (np.asarray(x, dtype=np.float64) for x in (q, qd, qdd))
        return self._file.inverse_dynamics(*motion)

    @contextmanager
    def as_file(self) -> Iterator[Path]:
        """The model as a file, as long as the context lasts."""
        with tempfile.TemporaryDirectory(prefix="rrr-") as folder:
            path = Path(folder) / "model.toml"
            self.write(path)
            yield path


@contextmanager
def as_path(model: Model | str | PathLike[str]) -> Iterator[Path]:
    """The path of a model that is at hand, or of a file."""
    if isinstance(model, Model):
        with model.as_file() as path:
            yield path
    else:
        yield Path(model)
