"""What the compiled part holds; `rrr` wraps it."""

from collections.abc import Callable
from os import PathLike
from typing import final

import numpy as np
from numpy.typing import NDArray

__all__ = ["Diagnosed", "Error", "Model", "default_criteria", "diagnose", "identify"]

_Path = str | PathLike[str]
_Progress = Callable[[str], object]

class Error(Exception):
    """What is wrong with a file, its logs or arrays, and a remedy in a second line."""

@final
class Diagnosed:
    """What a diagnosis found."""

    def json(self) -> str: ...
    def words(self) -> str: ...
    def html(self) -> str: ...
    def model_toml(self) -> str: ...
    def samples(
        self, count: int, seed: int
    ) -> tuple[list[str], list[list[float]], list[Model]]: ...
    def write(self, directory: _Path) -> None: ...

@final
class Model:
    """What is known of a robot."""

    @staticmethod
    def load(path: _Path) -> Model: ...
    @staticmethod
    def parse(text: str, name: _Path) -> Model: ...
    def to_toml(self) -> str: ...
    def write(self, path: _Path) -> None: ...
    def columns(self) -> list[tuple[str, str, str]]: ...
    def inverse_dynamics(
        self, q: NDArray[np.float64], qd: NDArray[np.float64], qdd: NDArray[np.float64]
    ) -> NDArray[np.float64]: ...

def diagnose(
    dataset: _Path,
    model: _Path,
    criteria: _Path | None = None,
    model_doubt: float | None = None,
    progress: _Progress | None = None,
) -> Diagnosed: ...
def identify(
    dataset: _Path, robot: _Path, progress: _Progress | None = None
) -> tuple[Model, list[str]]: ...
def default_criteria() -> str: ...
