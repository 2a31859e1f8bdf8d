"""From the names of a night to its alarms, with a bound on the part of them that is false.

Every alarm has an error: the probability that it is false, given all that the fleet says. Alarms
are the names of smallest error whose mean stays below `rate`, which bounds the false discovery rate
of the night (Efron; Storey), each of them below `LOCAL`. What is common to a group is one alarm.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rrr.fleet.common import Common, common_places, members
from rrr.fleet.mixture import Array, Mixture, evidence, fitted
from rrr.fleet.names import Fleet, Name, Place, fleet_on
from rrr.fleet.row import Row
from rrr.fleet.settings import Prior

RATE = 0.1
"""Part of a night's alarms that may be false, in the mean."""
LOCAL = 0.2
"""No alarm has a larger error than this, however sure the others are."""


@dataclass(frozen=True)
class Alarm:
    """A cause of one robot, or one that a batch or a kind of robots has in common.

    `error` is the probability that it is false; `robots` are those that have it named, of
    `group_size` in the group.
    """

    level: Literal["robot", "batch", "kind"]
    subject: str
    effect: str
    joint: int
    error: float
    robots: list[str]
    group_size: int
    names: list[Name]
    is_new: bool = True
    """Whether it did not stand on the night before."""

    @property
    def since(self) -> datetime.date:
        """The first night on which it stood at one of its robots, and has since."""
        return min(name.since for name in self.names)

    @property
    def identity(self) -> tuple[str, str, str, int]:
        """What an alarm of another night must have to be the same."""
        return self.level, self.subject, self.effect, self.joint


@dataclass(frozen=True)
class Night:
    """A night's decisions: `alarms`, and `watched`, names that are not sure enough."""

    fleet: Fleet
    alarms: list[Alarm]
    watched: list[Alarm]
    gone: list[Alarm]
    """Alarms of the night before that no longer stand."""
    mixture: Mixture


def decide(
    rows: Sequence[Row], night: datetime.date, *, rate: float = RATE, prior: Prior | None = None
) -> Night:
    """The alarms of a night, from all rows up to it; the night before is decided in the same way."""
    prior = prior or Prior()
    today = _decided(rows, night, rate, prior)
    earlier = [row["night"] for row in rows if row["night"] < night]
    if not earlier:
        return today
    before = _decided(rows, max(earlier), rate, prior)
    known = {alarm.identity for alarm in before.alarms}
    stand = {alarm.identity for alarm in today.alarms}
    alarms = [replace(a, is_new=a.identity not in known) for a in today.alarms]
    gone = [a for a in before.alarms if a.identity not in stand]
    return replace(today, alarms=alarms, gone=gone)


def _decided(rows: Iterable[Row], night: datetime.date, rate: float, prior: Prior) -> Night:
    fleet = fleet_on(rows, night)
    common, mixture = _common_and_rest(fleet, prior)
    found = [_of_group(c) for c in common] + _of_robots(fleet, members(common), mixture, prior)
    found.sort(key=lambda alarm: (alarm.error, alarm.identity))
    count = accepted([alarm.error for alarm in found], rate)
    return Night(fleet, found[:count], found[count:], [], mixture)


def accepted(errors: Sequence[float], rate: float) -> int:
    """How many of these errors, smallest first, are accepted: their mean stays below `rate`."""
    sums = np.cumsum(errors)
    fits = [
        error <= LOCAL and total <= rate * count
        for count, (error, total) in enumerate(zip(errors, sums, strict=True), 1)
    ]
    return max((count for count, fit in enumerate(fits, 1) if fit), default=0)


def _common_and_rest(fleet: Fleet, prior: Prior) -> tuple[list[Common], Mixture]:
    """What groups have in common, and the mixture of all other names, which depend on each other."""
    common = common_places(fleet, prior)
    taken, misfit = members(common), misfit_rates(fleet, prior)
    rest = [name for name in fleet.names if (name.robot, name.place) not in taken]
    rates = np.array([misfit[name.kind] for name in rest], dtype=np.float64)
    return common, fitted(_evidence(rest), rates, len(fleet.rows), prior)


def misfit_rates(fleet: Fleet, prior: Prior) -> dict[str, float]:
    """By kind of robot, how many false names misfit gives a robot: in proportion to the robots whose
    gap has no name, those of other kinds counting as `prior.neighbours` robots."""
    unknown = {kind: sum(r["verdict"] == "unknown" for r in rows) for kind, rows in fleet.kinds.items()}
    everywhere = sum(unknown.values()) / max(len(fleet.rows), 1)
    return {
        kind: prior.misfit_names
        * (unknown[kind] + prior.neighbours * everywhere)
        / (len(rows) + prior.neighbours)
        for kind, rows in fleet.kinds.items()
    }


def _of_group(common: Common) -> Alarm:
    named = float(np.mean([name.probability for name in common.names]))
    robots = [name.robot for name in common.names]
    error = 1 - common.probability * named
    return Alarm(common.level, common.group, *common.place, error, robots, common.robots, common.names)


def _of_robots(
    fleet: Fleet, taken: set[tuple[str, Place]], mixture: Mixture, prior: Prior
) -> list[Alarm]:
    names = [name for name in fleet.names if (name.robot, name.place) not in taken]
    rates = misfit_rates(fleet, prior)
    misfit = np.array([rates[name.kind] for name in names], dtype=np.float64)
    x = _evidence(names)
    # A name that stood on earlier nights, too.
    again = np.array([(prior.again / prior.false_again) ** (name.nights - 1) for name in names])
    odds = mixture.odds(x, misfit, prior) * again
    return [_of_robot(name, o / (1 + o)) for name, o in zip(names, odds, strict=True)]


def _of_robot(name: Name, true: float) -> Alarm:
    error = float(1 - true * name.probability)
    return Alarm("robot", name.robot, *name.place, error, [name.robot], 1, [name])


def _evidence(names: Sequence[Name]) -> Array:
    return evidence(np.array([name.deviations for name in names], dtype=np.float64))
