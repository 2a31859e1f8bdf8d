#!/usr/bin/env python3
"""False alarms of drawn fleets, with names that are true or false by lot. Prints the table of docs/fleet.md."""

from __future__ import annotations

import argparse
from dataclasses import replace

import numpy as np
from fleet_rows import TONIGHT, fleet

from rrr.fleet import Prior, decide

CASES = (
    # Robots, of them ill, false names a robot, deviations of a false name in the middle.
    (10_000, 0, 0.02, 6.0),
    (10_000, 0, 0.04, 6.0),
    (10_000, 250, 0.02, 6.0),
    (10_000, 250, 0.0, 6.0),
    (10_000, 20, 0.02, 6.0),
    (200, 5, 0.02, 6.0),
    (10_000, 0, 0.02, 24.0),
    (10_000, 250, 0.02, 24.0),
    (10_000, 250, 0.02, 30.0),
)
HEAD = (
    "| robots | ill | false names a robot | their deviations | names a night | alarms | false | of the alarms |"
    " ill robots found |\n" + "| --- " * 9 + "|"
)


def row(case: tuple[int, int, float, float], nights: int, seed: int) -> str:
    """A line of the table: means over nights."""
    robots, ill, false_names, deviations = case
    drawn = replace(Prior(), false_deviations=deviations)
    names = alarms = false = 0
    found = set()
    for night in range(nights):
        rng = np.random.default_rng([seed, night])
        rows, sick = fleet(rng, robots, ill, false_names, prior=drawn)
        decided = decide(rows, TONIGHT)
        names, alarms = names + len(decided.fleet.names), alarms + len(decided.alarms)
        false += sum(alarm.subject not in sick for alarm in decided.alarms)
        found |= {(night, alarm.subject) for alarm in decided.alarms if alarm.subject in sick}
    cells = [str(robots), str(ill), f"{false_names:.2f}", f"{deviations:.0f}", f"{names / nights:.0f}"]
    cells += [f"{alarms / nights:.1f}", f"{false / nights:.1f}", f"{100 * false / alarms:.0f} %" if ill else "-"]
    return f"| {' | '.join([*cells, f'{len(found) / nights:.1f}' if ill else '-'])} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--nights", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print(HEAD)
    for case in CASES:
        print(row(case, options.nights, options.seed), flush=True)


if __name__ == "__main__":
    main()
