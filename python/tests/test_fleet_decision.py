"""Alarms of fleets whose names are drawn, so that it is known which are false."""

import datetime
from dataclasses import replace

import numpy as np
import pytest
from fleet_rows import TONIGHT, cause, fleet, row

from rrr.fleet import Prior, decide
from rrr.fleet.common import is_common
from rrr.fleet.decision import LOCAL, RATE, accepted
from rrr.fleet.row import Row


def counted(
    seeds: range, robots: int, ill: int, false_names: float, prior: Prior | None = None
) -> tuple[int, int, int]:
    """Alarms, false ones, and names before the decision, of several nights."""
    alarms = false = names = 0
    for seed in seeds:
        rows, sick = fleet(np.random.default_rng(seed), robots, ill, false_names, prior=prior)
        found = decide(rows, TONIGHT)
        names += len(found.fleet.names)
        alarms += len(found.alarms)
        false += sum(alarm.subject not in sick for alarm in found.alarms)
    return alarms, false, names


def test_ten_thousand_healthy_robots_are_next_to_silent() -> None:
    alarms, _, names = counted(range(2), 10_000, 0, 0.02)
    assert names > 350 and alarms <= 1


def test_the_part_that_is_false_is_bounded() -> None:
    alarms, false, _ = counted(range(2), 10_000, 250, 0.02)
    assert alarms > 300 and false <= RATE * alarms


@pytest.mark.parametrize("middle", [12.0, 24.0])
def test_it_is_bounded_where_false_names_are_stronger_than_told(middle: float) -> None:
    stronger = replace(Prior(), false_deviations=middle)
    alarms, false, _ = counted(range(2), 10_000, 250, 0.02, stronger)
    assert alarms > 250 and false <= RATE * alarms


def test_without_false_names_hardly_any_cause_is_missed() -> None:
    alarms, false, names = counted(range(2), 10_000, 250, 0.0)
    assert false == 0 and alarms > 0.8 * names


def test_a_cause_of_a_batch_is_told_once() -> None:
    rows = [row(f"a{i}", [cause("dead_zone", 2, 50)], batch="A") for i in range(19)]
    rows += [row("a19", batch="A"), *(row(f"b{i}", batch="B") for i in range(60))]
    found = decide(rows, TONIGHT)
    alarms = [(a.level, a.subject, len(a.robots), a.group_size) for a in found.alarms]
    assert alarms == [("batch", "A", 19, 20)]


def test_a_cause_of_all_batches_is_the_kinds() -> None:
    rows = [row(f"{b}{i}", [cause("payload", 0, 50)], batch=b) for b in "AB" for i in range(10)]
    rows += [row(f"c{i}", batch="C", kind="other") for i in range(20)]
    found = decide(rows, TONIGHT)
    assert [(a.level, a.subject, a.group_size) for a in found.alarms] == [("kind", "arm", 20)]


def test_two_robots_of_a_batch_stand_for_themselves() -> None:
    rows = [row(f"a{i}", [cause("delay", 1, 400)] if i < 2 else [], batch="A") for i in range(20)]
    found = decide(rows + [row(f"b{i}", batch="B") for i in range(80)], TONIGHT)
    assert [(a.level, a.subject) for a in found.alarms] == [("robot", "a0"), ("robot", "a1")]


def test_a_group_is_told_from_chance() -> None:
    prior = Prior()
    assert is_common(20, 20, 0.02, prior) > 0.99 and is_common(4, 4, 0.02, prior) > 0.9
    assert is_common(3, 3, 0.5, prior) < 0.2 and is_common(10, 20, 0.02, prior) < 0.7


def test_gaps_without_a_name_make_names_doubtful() -> None:
    ill = [row("ill", [cause("payload", 0, 300)])]
    silent = [row(f"r{i}") for i in range(100)]
    lost = [row(f"u{i}", verdict="unknown") for i in range(15)]
    assert len(decide(ill + silent, TONIGHT).alarms) == 1
    found = decide(ill + silent + lost, TONIGHT)
    assert not found.alarms and [a.subject for a in found.watched] == ["ill"]


def _nights(strengths: list[float | None]) -> list[Row]:
    """A robot over nights with these deviations, and others that are healthy."""
    rows = []
    for back, strength in enumerate(reversed(strengths)):
        night = TONIGHT - datetime.timedelta(back)
        causes = [] if strength is None else [cause("cogging", 3, strength)]
        rows += [row("r", causes, night=night), *(row(f"h{i}", night=night) for i in range(100))]
    return rows


def test_a_name_that_stands_for_nights_becomes_an_alarm() -> None:
    first, later = decide(_nights([40.0]), TONIGHT), decide(_nights([None, 40, 40, 40, 40, 40]), TONIGHT)
    assert not first.alarms and len(first.watched) == 1
    assert [(a.subject, a.since) for a in later.alarms] == [("r", TONIGHT - datetime.timedelta(4))]


def test_new_standing_and_gone() -> None:
    assert decide(_nights([None, 200]), TONIGHT).alarms[0].is_new
    assert not decide(_nights([200, 200]), TONIGHT).alarms[0].is_new
    gone = decide(_nights([200, None]), TONIGHT)
    assert not gone.alarms and [a.subject for a in gone.gone] == ["r"]


def test_a_robot_without_new_logs_keeps_its_alarm() -> None:
    rows = [r for r in _nights([200, 200]) if (r["robot"], r["night"]) != ("r", TONIGHT)]
    found = decide(rows, TONIGHT)
    assert [(a.subject, a.is_new) for a in found.alarms] == [("r", False)]


def test_what_is_accepted_keeps_to_both_bounds() -> None:
    assert accepted([], RATE) == 0 and accepted([0.3], RATE) == 0
    assert accepted([0.02, 0.15, 0.18], 0.1) == 2
    assert accepted([0.0] * 50 + [LOCAL + 0.01], 0.1) == 50
