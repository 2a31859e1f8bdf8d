#!/usr/bin/env python3
"""A fleet of 200 robots on Ray with two workers, one of them killed in the middle, on two nights.

Five robots have a cause of their own, 20 of one batch have one in common; before the second night a
sixth robot falls ill. All others are 2 % off their models and have nothing hidden. Prints the table
of docs/fleet.md. Needs the command `rrr`, which records the logs (`cargo build --release`).
"""

from __future__ import annotations

import argparse
import datetime
import shutil
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from fleet_killer import Killer
from fleet_robots import KINDS, SIZES, Hidden, again, drawn, model, record, robot
from fleet_table import Outcome, table

from rrr.fleet.decision import Night, decide
from rrr.fleet.inventory import Robot, robots_of
from rrr.fleet.night import finish
from rrr.fleet.ray_engine import on_ray
from rrr.fleet.row import Row
from rrr.fleet.settings import Options, Prior
from rrr.fleet.store import Store
from rrr.toml_text import toml_text

TOOL = Path(__file__).parents[2] / "target" / "release" / "rrr"
BATCH = 20
ALONE = 5
NIGHTS = (datetime.date(2026, 11, 21), datetime.date(2026, 11, 22))


@dataclass
class Truth:
    """What is hidden: by robot on each night, and the cause of the sick batch."""

    robots: list[str]
    batch: str
    common: Hidden
    alone: list[dict[str, Hidden]]
    kinds: dict[str, str] = field(default_factory=dict)


def truth_of(count: int, seed: int) -> Truth:
    """Draws who is ill."""
    rng = np.random.default_rng([seed, 1])
    robots = [f"robot-{number:04}" for number in range(count)]
    kinds = {name: list(KINDS)[(i // BATCH) % len(KINDS)] for i, name in enumerate(robots)}
    sick = int(rng.integers(count // BATCH))
    healthy = [name for i, name in enumerate(robots) if i // BATCH != sick]
    ill = [str(name) for name in rng.permutation(healthy)[: ALONE + 1]]
    effects = [str(e) for e in rng.permutation(list(SIZES))]
    alone = {
        name: drawn(effect, int(rng.integers(1, len(KINDS[kinds[name]]) + 1)), rng)
        for name, effect in zip(ill, effects, strict=False)
    }
    common = drawn(effects[-1], 1, rng)
    first = {name: alone[name] for name in ill[:ALONE]}
    return Truth(robots, _batch(sick), common, [first, alone], kinds)


def _batch(number: int) -> str:
    return f"B{number + 1:02}"


def make(truth: Truth, night: int, seed: int, error: float, tool: str, place: Path) -> None:
    """Records all robots of a night."""
    for kind in KINDS:
        place.mkdir(parents=True, exist_ok=True)
        (place / f"{kind}.toml").write_text(toml_text(model(kind)))
    lines = ["robot,model,batch"]
    for number, name in enumerate(truth.robots):
        kind, batch = truth.kinds[name], _batch(number // BATCH)
        own = np.random.default_rng([seed, 2, number])
        content = robot(kind, own, error)
        hidden = [again(truth.common, own)] if batch == truth.batch else []
        hidden += [truth.alone[night][name]] if name in truth.alone[night] else []
        record(tool, content, hidden, 2 * (seed * len(truth.robots) + number) + night, place / name)
        lines.append(f"{name},{kind}.toml,{batch}")
    (place / "fleet.csv").write_text("\n".join(lines) + "\n")


def run(truth: Truth, night: int, place: Path, output: Path, workers: int) -> Outcome:
    """A night: all robots on Ray, and what its alarms are worth."""
    killer, begin = Killer(truth.robots), time.monotonic()
    robots: list[Robot] = robots_of(str(place))
    on_ray(robots, str(output), NIGHTS[night], Options(), workers=workers, progress=killer)
    wall_s = time.monotonic() - begin
    finish(str(output), NIGHTS[night], rate=0.1, prior=Prior())
    rows = Store(str(output)).rows()
    decided = decide(rows, NIGHTS[night])
    tonight = [row for row in rows if row["night"] == NIGHTS[night]]
    return outcome(truth, night, decided, tonight, wall_s, killer.killed)


def outcome(
    truth: Truth, night: int, decided: Night, rows: list[Row], wall_s: float, killed: str | None
) -> Outcome:
    """Counts causes found: each robot's own by its alarm, the batch's at each of its robots."""
    wanted = {(name, (h.effect, h.joint)) for name, h in truth.alone[night].items()}
    common = truth.common.effect, truth.common.joint
    sick = {row["robot"] for row in rows if row["batch"] == truth.batch}
    wanted |= {(name, common) for name in sick}
    told = [{(name, (a.effect, a.joint)) for name in a.robots} for a in decided.alarms]
    named = {(row["robot"], (c["effect"], c["joint"])) for row in rows for c in row["causes"]}
    found = len(wanted & set().union(*told))
    false = sum(not (alarm & wanted) for alarm in told)
    return Outcome(decided, rows, wall_s, killed, found, len(wanted), false, len(named - wanted))


def passes(outcomes: list[Outcome], robots: int) -> bool:
    """Whether every robot has one row, at most one alarm is false and 95 % of the causes are found."""
    return all(
        len(o.rows) == len({row["robot"] for row in o.rows}) == robots
        and o.killed is not None
        and o.false <= 1
        and o.found >= 0.95 * o.hidden
        for o in outcomes
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--nights", type=int, choices=(1, 2), default=2)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--error", type=float, default=0.02, help="how far robots are off their models")
    parser.add_argument("--tool", default=str(TOOL), help="the command rrr")
    parser.add_argument("--out", type=Path, help="where rows and pages stay")
    options = parser.parse_args()
    truth = truth_of(options.robots, options.seed)
    print(f"batch {truth.batch}: {truth.common.argument}")
    for name, hidden in truth.alone[-1].items():
        print(f"{name} ({truth.kinds[name]}): {hidden.argument}")
    outcomes = []
    with tempfile.TemporaryDirectory(prefix="rrr-fleet-") as scratch:
        output = options.out or Path(scratch) / "out"
        for night in range(options.nights):
            place = Path(scratch) / str(NIGHTS[night])
            make(truth, night, options.seed, options.error, options.tool, place)
            outcomes.append(run(truth, night, place, output, options.workers))
            shutil.rmtree(place)
    print("\n" + table(outcomes, options.workers))
    for o in outcomes:
        print(f"\n{o.night.fleet.night}, alarms and then what is watched:")
        for alarm in o.night.alarms + o.night.watched:
            mark = "" if alarm in o.night.alarms else "  watched"
            print(f"  {alarm.subject}: {alarm.effect} of joint {alarm.joint}, error {alarm.error:.3f}{mark}")
    is_good = passes(outcomes, options.robots)
    print("\npassed" if is_good else "\nfailed")
    return 0 if is_good else 1


if __name__ == "__main__":
    raise SystemExit(main())
