"""What the compiled part holds; `rrr` wraps it."""

from collections.abc import Callable
from os import PathLike

import numpy as np
from numpy.typing import NDArray

Path = str | PathLike[str]
Progress = Callable[[str], object]

class Error(Exception):
    """What is wrong with a file, its logs or arrays, and a remedy in a second line."""

class Diagnosed:
    """What a diagnosis found."""

    def json(self) -> str: ...
    def words(self) -> str: ...
    def html(self) -> str: ...
    def model_toml(self) -> str: ...
    def samples(
        self, count: int, seed: int
    ) -> tuple[list[str], list[list[float]], list[Model]]: ...
    def write(self, directory: Path) -> None: ...

class Model:
    """What is known of a robot."""

    @staticmethod
    def load(path: Path) -> Model: ...
    @staticmethod
    def parse(text: str, name: Path) -> Model: ...
    def to_toml(self) -> str: ...
    def write(self, path: Path) -> None: ...
    def columns(self) -> list[tuple[str, str, str]]: ...
    def inverse_dynamics(
        self, q: NDArray[np.float64], qd: NDArray[np.float64], qdd: NDArray[np.float64]
    ) -> NDArray[np.float64]: ...

def diagnose(
    dataset: Path,
    model: Path,
    criteria: Path | None = None,
    model_doubt: float | None = None,
    progress: Progress | None = None,
) -> Diagnosed: ...
def identify(
    dataset: Path, robot: Path, progress: Progress | None = None
) -> tuple[Model, list[str]]: ...
def default_criteria() -> str: ...
