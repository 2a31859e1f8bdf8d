"""What a diagnosis says."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from html import escape
from os import PathLike
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from rrr import _rrr
from rrr.model import Model

Value = float | list[float]


@dataclass(frozen=True)
class Cause:
    """A named cause; effects, parameters and units are those of docs/effects.md.

    `joint` is 0 for the whole robot. `share` is the part of the gap's squares above the noise that
    goes when the cause is added, `shrinkage` 1 - rms with it / rms without it; both on logs that
    chose nothing, with 95 % intervals. `probability` is calibrated, given all that was tried.
    """

    effect: str
    joint: int
    parameters: dict[str, Value]
    parameter_intervals: dict[str, list[float] | list[list[float]]]
    probability: float
    share: float
    share_interval: list[float]
    shrinkage: float
    shrinkage_interval: list[float]


@dataclass(frozen=True)
class Alternative:
    """A rival of a cause, `instead_of` its index; or an effect that was found and is not named, and why."""

    effect: str
    joint: int
    probability: float
    instead_of: int | None
    share: float
    why: str | None = None


@dataclass(frozen=True)
class ParameterChange:
    """A parameter that the refit alone moved; `share` is its part of the squares between the model
    as given and refitted."""

    parameter: str
    given: float
    found: float
    interval: list[float]
    share: float


@dataclass(frozen=True)
class Remainder:
    """What no cause explains on a joint over an axis; `curve` has x, y_V and deviation_V."""

    joint: int
    axis: str
    share: float
    detail: str
    curve: dict[str, list[float]]
    nearest: str | None


@dataclass(frozen=True)
class GapShare:
    """Where the gap of the refitted model lies, without any cause."""

    joint: int
    axis: str
    share: float
    detail: str


@dataclass(frozen=True)
class Untestable:
    """An effect that these logs cannot show, why, and which experiment would."""

    effect: str
    joint: int
    why: str


@dataclass(frozen=True)
class Samples(Sequence[Model]):
    """Models drawn from what the logs leave open.

    `values`, n x p, has a column for each parameter of model files that `names` names.
    """

    names: list[str]
    values: NDArray[np.float64]
    models: list[Model]

    def __len__(self) -> int:
        return len(self.models)

    @overload
    def __getitem__(self, index: int) -> Model: ...
    @overload
    def __getitem__(self, index: slice) -> list[Model]: ...
    def __getitem__(self, index: int | slice) -> Model | list[Model]:
        return self.models[index]


Entry = TypeVar("Entry", Cause, Alternative, ParameterChange, Remainder, GapShare, Untestable)


class Report:
    """A diagnosis: its verdict, causes and figures, its page, and the amended model."""

    def __init__(self, found: _rrr.Diagnosed) -> None:
        self._found = found
        self._content: dict[str, Any] = json.loads(found.json())

    @property
    def verdict(self) -> str:
        """ "effect", "partial", "unknown" or "none", as docs/diagnosis.md has it."""
        return str(self._content["verdict"])

    @cached_property
    def causes(self) -> list[Cause]:
        """The confirmed causes, largest share first."""
        return self._entries("causes", Cause)

    @cached_property
    def alternatives(self) -> list[Alternative]:
        """Rivals that the logs do not rule out, and what was found and is not named, likeliest first."""
        return self._entries("alternatives", Alternative)

    @cached_property
    def parameters_changed(self) -> list[ParameterChange]:
        """What the refit alone moved, largest share first."""
        return self._entries("parameters_changed", ParameterChange)

    @cached_property
    def remainder(self) -> list[Remainder]:
        """What no cause explains, largest first."""
        return self._entries("remainder", Remainder)

    @cached_property
    def where(self) -> list[GapShare]:
        """Where the gap lies before any cause, largest first."""
        return self._entries("where", GapShare)

    @cached_property
    def untestable(self) -> list[Untestable]:
        """What these logs cannot show."""
        return self._entries("untestable", Untestable)

    @property
    def gap(self) -> dict[str, list[float]]:
        """Rms values of each joint on the confirming logs, by the names of report.json:
        as_given_V, refitted_V, with_effects_V, with_tables_V, noise_floor_V, refitted_rad, ..."""
        return dict(self._content["gap"])

    @property
    def remarks(self) -> list[str]:
        """What else a reader must know, in sentences."""
        return list(self._content["remarks"])

    @cached_property
    def model(self) -> Model:
        """The model with the causes added, refitted: model.toml of `rrr diagnose`."""
        return Model.parse(self._found.model_toml(), "model.toml")

    def samples(self, n: int, seed: int = 1) -> Samples:
        """Draws n models from what the logs leave open, for domain randomisation.

        All that was fitted is normal about the fit, by its curvature; the causes are those of `model` in
        every draw. The same seed gives the same models. Raises `rrr.Error` for arms of position servos,
        whose diagnosis keeps no covariance.
        """
        names, values, models = self._found.samples(n, seed)
        rows = np.array(values, dtype=np.float64).reshape(n, len(names))
        return Samples(names, rows, [Model(model) for model in models])

    def to_dict(self) -> dict[str, Any]:
        """All of report.json."""
        copy: dict[str, Any] = json.loads(self._found.json())
        return copy

    def write(self, directory: str | PathLike[str]) -> None:
        """Writes report.json, report.html, model.toml and samples.csv, as `rrr diagnose --out` does."""
        self._found.write(directory)

    def show(self) -> None:
        """Shows the page in a notebook; elsewhere prints the verdict, the causes and the remarks."""
        try:
            from IPython import get_ipython
            from IPython.display import HTML, display
        except ImportError:
            print(self)
            return
        if get_ipython() is None:
            print(self)
        else:
            display(HTML(self._repr_html_()))

    def __str__(self) -> str:
        return self._found.words()

    def __repr__(self) -> str:
        causes = ", ".join(f"{cause.effect} of joint {cause.joint}" for cause in self.causes)
        return f"<rrr.Report {self.verdict}: {causes or 'no cause named'}>"

    def _repr_html_(self) -> str:
        """The page in a frame of its own, so that its style stays there."""
        page = escape(self._found.html(), quote=True)
        style = "width:100%;height:640px;border:1px solid #e2e5e9"
        return f'<iframe srcdoc="{page}" style="{style}"></iframe>'

    def _entries(self, key: str, kind: type[Entry]) -> list[Entry]:
        names = {field.name for field in fields(kind)}
        rows: list[dict[str, Any]] = self._content[key]
        return [kind(**{k: v for k, v in row.items() if k in names}) for row in rows]
