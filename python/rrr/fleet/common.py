"""Causes that the robots of a kind or batch have in common."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from math import comb, exp, lgamma, log
from typing import Literal

from rrr.fleet.names import Fleet, Name, Place
from rrr.fleet.row import Row
from rrr.fleet.settings import Prior

LEAST_ROBOTS = 3
"""A group of fewer robots has nothing in common."""


SURE = 0.9
"""Probability from which a place is told as common; below, each robot stands for itself."""


@dataclass(frozen=True)
class Common:
    """A place that most robots of a group have named."""

    level: Literal["kind", "batch"]
    group: str
    place: Place
    names: list[Name]
    robots: int
    """How many the group has."""
    probability: float
    """That more than half of the group has it."""


def common_places(fleet: Fleet, prior: Prior) -> list[Common]:
    """Places that are surely a kind's, or else a batch's."""
    found: list[Common] = []
    for kind, rows in fleet.kinds.items():
        batches = fleet.batches(rows)
        of_kind = [c for c in _common("kind", kind, rows, fleet, prior) if _is_in_each(c, batches)]
        taken = {c.place for c in of_kind}
        of_batches = [c for b, own in batches.items() for c in _common("batch", b, own, fleet, prior)]
        found += of_kind + [c for c in of_batches if c.place not in taken]
    return found


def _common(
    level: Literal["kind", "batch"], group: str, rows: list[Row], fleet: Fleet, prior: Prior
) -> list[Common]:
    robots = {row["robot"] for row in rows}
    if len(robots) < LEAST_ROBOTS:
        return []
    inside: dict[Place, list[Name]] = defaultdict(list)
    outside: Counter[Place] = Counter()
    for name in fleet.names:
        if name.robot in robots:
            inside[name.place].append(name)
        else:
            outside[name.place] += 1
    others = len(fleet.rows) - len(robots)
    found = []
    for place, names in sorted(inside.items()):
        # As if one robot more had been seen, with the names that the prior expects of it.
        rate = (outside[place] + prior.true_names + prior.false_names) / (others + 1)
        probability = is_common(len(names), len(robots), rate, prior)
        found.append(Common(level, group, place, names, len(robots), probability))
    return [c for c in found if c.probability >= SURE]


def is_common(k: int, n: int, elsewhere: float, prior: Prior) -> float:
    """Probability that more than half of a group has what k of its n robots have named.

    Either the place is named at the rate of robots elsewhere, or, beforehand with the probability
    `prior.elevated`, at a rate of the group's own, which may be any.
    """
    own = -log(n + 1)
    usual = _log_binomial(k, n, min(max(elsewhere, 1e-6), 0.5))
    odds = prior.elevated / (1 - prior.elevated) * exp(min(own - usual, 700.0))
    return odds / (1 + odds) * _above_half(k, n)


def _above_half(k: int, n: int) -> float:
    """Probability that a rate exceeds one half, given k of n, any rate being as likely beforehand."""
    return sum(comb(n + 1, i) for i in range(k + 1)) / 2 ** (n + 1)


def _log_binomial(k: int, n: int, rate: float) -> float:
    ways = lgamma(n + 1) - lgamma(k + 1) - lgamma(n - k + 1)
    return ways + k * log(rate) + (n - k) * log(1 - rate)


def _is_in_each(common: Common, batches: dict[str, list[Row]]) -> bool:
    """Whether more than half of each batch has it, so that it is the kind's and no batch's."""
    counts = Counter(name.batch for name in common.names)
    sizes = {batch: len(rows) for batch, rows in batches.items() if len(rows) >= LEAST_ROBOTS}
    return len(sizes) != 1 and all(2 * counts[batch] > n for batch, n in sizes.items())


def members(found: Iterable[Common]) -> set[tuple[str, Place]]:
    """Robots and places that a common cause accounts for."""
    return {(name.robot, c.place) for c in found for name in c.names}
