#!/usr/bin/env python3
"""Robots recorded in MuJoCo, diagnosed, and their amended models tried in MuJoCo again.

For each hidden cause: by how much prediction errors shrink from the model as given to the amended one,
as `rrr` says and as MuJoCo shows. Prints the table of docs/mujoco.md.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from arm import model, robot
from causes import CAUSES, SHORT, Cause
from numpy.typing import NDArray
from prediction import of_amended, of_given
from recorder import Recording, Robot, plans, record

import rrr

Array = NDArray[np.float64]
HEAD = (
    "| hidden | found (probability) | one step: `rrr` says | MuJoCo shows "
    "| 0.25 s: `rrr` says | MuJoCo shows | form | s |\n| --- | --- | --- | --- | --- | --- | --- | --- |"
)
DOUBT = 0.03
"""The owner knows the model to so many parts of itself; the robot's parameters are 2 % off."""
WANTED = 0.9
"""Of what `rrr` says of the shrinkage."""


@dataclass
class Outcome:
    """Of one cause: the report, what it says of shrinkage and what MuJoCo shows, one step and 0.25 s."""

    cause: Cause | None
    report: rrr.Report
    said: tuple[float, float]
    shown: tuple[float, float]
    is_native: bool
    seconds: float

    @property
    def holds(self) -> bool:
        """Whether MuJoCo shows nine tenths of what is said."""
        return all(b >= WANTED * a for a, b in zip(self.said, self.shown, strict=True))

    @property
    def is_found(self) -> bool:
        """Whether the cause is named."""
        hidden = self.cause
        return hidden is not None and any(
            (c.effect, c.joint) == (hidden.effect, hidden.joint) for c in self.report.causes
        )


def recorded(cause: Cause | None, seed: int, scale: float) -> list[Recording]:
    """The logs of a robot; the last is held out."""
    rng = np.random.default_rng([seed, 7])
    arm = Robot(robot(rng), cause)
    return [record(arm, plan, rng) for plan in plans(rng, scale)]


def tried(cause: Cause | None, seed: int = 1, scale: float = 1.0) -> Outcome:
    """Records, diagnoses, amends and predicts."""
    logs = recorded(cause, seed, scale)
    spec, begin = model(), time.monotonic()
    given = rrr.from_mujoco(spec.compile(), sample_period_s=1e-3)
    arrays = [log.log for log in logs]
    report = rrr.diagnose(arrays, given, model_doubt=DOUBT, progress=False)
    seconds = time.monotonic() - begin
    before = of_given(spec).errors(logs[-1])
    after = of_amended(spec, report).errors(logs[-1])
    joint = cause.joint if cause else 0
    shown = tuple(_shrinkage(a, b, joint) for a, b in zip(before, after, strict=True))
    gap = report.gap
    said = (
        _shrinkage(np.array(gap["as_given_V"]), np.array(gap["with_effects_V"]), joint),
        _shrinkage(np.array(gap["as_given_rad"]), np.array(gap["with_effects_rad"]), joint),
    )
    is_native = rrr.mujoco_forces(spec, report) is None
    return Outcome(cause, report, said, (shown[0], shown[1]), is_native, seconds)


def _shrinkage(before: Array, after: Array, joint: int) -> float:
    """1 - rms after / rms before, on a joint or (0) on all, each by its own size."""
    on = slice(None) if joint == 0 else slice(joint - 1, joint)
    return float(1 - np.sqrt(((after / before)[on] ** 2).mean()))


def row(outcome: Outcome) -> str:
    """A line of the table."""
    hidden, report = outcome.cause, outcome.report
    found = "<br>".join(f"{_words(c)} ({c.probability:.2f})" for c in report.causes) or "none"
    figures = [
        figure for pair in zip(outcome.said, outcome.shown, strict=True) for figure in pair
    ]
    cells = [_words(hidden) if hidden else "nothing", found]
    cells += [f"{100 * figure:.1f} %" for figure in figures]
    cells += ["XML" if outcome.is_native else "XML and callbacks", f"{outcome.seconds:.0f}"]
    return f"| {' | '.join(cells)} |"


def _words(cause: Any) -> str:
    name, value = next(iter(cause.parameters.items()))
    size = " ".join(f"{v:.3g}" for v in value) if isinstance(value, list) else f"{value:.3g}"
    return f"`{cause.effect}` of joint {cause.joint}: {name} {size}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("effects", nargs="*", help="effects to hide; all if none is named")
    parser.add_argument("--short", action="store_true", help=f"those of the tests: {', '.join(SHORT)}")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scale", type=float, default=1.0, help="length of the logs, times 54 s")
    options = parser.parse_args()
    wanted = SHORT if options.short else options.effects
    causes = [cause for cause in CAUSES if not wanted or cause.effect in wanted]
    print(HEAD, flush=True)
    outcomes = []
    for cause in causes:
        outcomes.append(tried(cause, options.seed, options.scale))
        print(row(outcomes[-1]), flush=True)
    held = sum(outcome.holds for outcome in outcomes)
    named = sum(outcome.is_found for outcome in outcomes)
    print(f"\nAt least nine tenths of what is said: {held} of {len(outcomes)}; named: {named}.")


if __name__ == "__main__":
    main()
