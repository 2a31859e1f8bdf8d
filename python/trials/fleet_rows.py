"""Rows of fleets that never were: names drawn, not found."""

from __future__ import annotations

import datetime
from collections.abc import Iterable
from typing import Any

import numpy as np

from rrr.fleet.inventory import Robot
from rrr.fleet.row import Row, empty_row
from rrr.fleet.settings import Prior

TONIGHT = datetime.date(2026, 11, 22)
EFFECTS = ("cogging", "delay", "dac_offset", "dead_zone", "cable_spring", "payload", "backlash")
JOINTS = 6


def row(name: str, causes: Iterable[Row] = (), **more: Any) -> Row:
    """A robot's row of tonight; of kind "arm", without a batch, if not told otherwise."""
    robot = Robot(name, "", kind=more.pop("kind", "arm"), batch=more.pop("batch", None))
    night = more.pop("night", TONIGHT)
    named = list(causes)
    verdict = "effect" if named else "none"
    return empty_row(robot, night, f"{name}-{night}") | {"verdict": verdict, "causes": named} | more


def cause(effect: str, joint: int, deviations: float, probability: float = 0.98, size: float = 0.1) -> Row:
    """A cause as a row holds it."""
    return {
        "effect": effect,
        "joint": joint,
        "parameters": [("size", [size])],
        "probability": probability,
        "share": 0.9,
        "share_interval": [0.8, 1.0],
        "shrinkage": 0.5,
        "shrinkage_interval": [0.4, 0.6],
        "deviations": deviations,
    }


def false_cause(rng: np.random.Generator, prior: Prior) -> Row:
    """A name that is false: anywhere, its evidence as the prior has that of false names."""
    x = rng.laplace(np.log(prior.false_deviations), prior.false_spread)
    return cause(*_place(rng), float(np.exp(x)), float(rng.uniform(0.7, 0.98)))


def true_cause(rng: np.random.Generator, prior: Prior) -> Row:
    """A name that is true."""
    x = rng.normal(np.log(prior.true_deviations), prior.true_spread)
    return cause(*_place(rng), float(np.exp(x)), 0.98)


def _place(rng: np.random.Generator) -> tuple[str, int]:
    return EFFECTS[int(rng.integers(len(EFFECTS)))], int(rng.integers(1, JOINTS + 1))


def fleet(
    rng: np.random.Generator,
    robots: int,
    ill: int = 0,
    false_names: float = 0.02,
    *,
    kinds: int = 5,
    prior: Prior | None = None,
) -> tuple[list[Row], set[str]]:
    """Rows of a night, and the robots that are ill; this part of all has a false name, too.

    Names have the evidence that `prior` tells.
    """
    prior, sick = prior or Prior(), {f"r{i:05}" for i in range(ill)}
    rows = []
    for i in range(robots):
        name = f"r{i:05}"
        causes = [true_cause(rng, prior)] if name in sick else []
        causes += [false_cause(rng, prior)] if rng.uniform() < false_names else []
        rows.append(row(name, causes, kind=f"arm-{i % kinds}", batch=f"B{i % 100:03}"))
    return rows, sick
