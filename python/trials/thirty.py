#!/usr/bin/env python3
"""Robots recorded in MuJoCo, identified and diagnosed: 30 of them, as a table.

Each robot is up to 10 % off its owner's MuJoCo model. It is recorded and identified; then something
happens to it (every fifth: nothing), it is recorded again, on other motions, and diagnosed by the
model that was identified. Prints the table of docs/mujoco.md.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from arm import model, robot
from causes import CAUSES, Cause
from recorder import Recording, Robot, plans, record

import rrr

HEAD = (
    "| robot | identified: left of the command [%] | hidden | verdict | named (share, probability) | s |\n"
    "| --- | --- | --- | --- | --- | --- |"
)
ERROR = 0.1
"""How far the robot is off its owner's model, rms."""
TWINS = ({"delay", "actuator_lag"},)
"""Names between which logs cannot tell, on the same joint."""


@dataclass
class Case:
    """A robot: what is hidden, what is left of its command after identification, its report."""

    number: int
    hidden: Cause | None
    left: list[float]
    report: rrr.Report
    seconds: float

    @property
    def is_right(self) -> bool:
        """Whether the first cause named is the hidden one; of nothing, whether none is named."""
        if self.hidden is None or not self.report.causes:
            return self.hidden is None and not self.report.causes
        return _same(self.report.causes[0], self.hidden)

    @property
    def wrong(self) -> list[rrr.Cause]:
        """Causes named that are not hidden."""
        named = self.report.causes
        return [c for c in named if self.hidden is None or not _same(c, self.hidden)]


def _same(named: rrr.Cause, hidden: Cause) -> bool:
    names = {named.effect, hidden.effect}
    same = len(names) == 1 or any(names <= twins for twins in TWINS)
    return same and named.joint == hidden.joint


def played(spec: Any, cause: Cause | None, rng: np.random.Generator, scale: float) -> list[Recording]:
    """A robot's logs."""
    arm = Robot(spec, cause)
    return [record(arm, plan, rng) for plan in plans(rng, scale)]


def case(number: int, seed: int, scale: float) -> Case:
    """Records, identifies, hides, records, diagnoses."""
    rng = np.random.default_rng([seed, number])
    order = np.random.default_rng(seed).permutation(len(CAUSES))
    hidden = None if number % 5 == 0 else CAUSES[order[(number - number // 5 - 1) % len(CAUSES)]]
    spec = robot(rng, ERROR)
    if hidden is not None and "motor_inertia_kg_m2" in hidden.parameters:
        # The motor that parts from its link is all of the joint's rotor.
        spec.joints[hidden.index].armature = hidden.parameters["motor_inertia_kg_m2"]
    healthy = played(spec.copy(), None, rng, scale)
    begin = time.monotonic()
    known = rrr.from_mujoco(model().compile(), sample_period_s=1e-3)
    identified = rrr.identify([log.log for log in healthy], known, progress=False)
    seconds = time.monotonic() - begin
    left = left_of_command(identified, healthy[-1])
    logs = played(spec, hidden, rng, scale)
    begin = time.monotonic()
    report = rrr.diagnose([log.log for log in logs], identified, progress=False)
    return Case(number, hidden, left, report, seconds + time.monotonic() - begin)


def left_of_command(found: rrr.Model, held: Recording) -> list[float]:
    """What the identified model leaves of each joint's command on the log held out [part of it].

    Accelerations are differences of the engine's own speeds; rows at standstill are left out.
    """
    qdd = (held.qd[2:] - held.qd[:-2]) / 2e-3
    torques = found.inverse_dynamics(held.q[1:-1], held.qd[1:-1], qdd)
    parts = []
    for i, joint in enumerate(found.to_dict()["joint"]):
        friction = {name.split("_")[0]: value for name, value in joint["friction"].items()}
        v = held.qd[1:-1, i]
        u = torques[:, i] / joint["drive"]["torque_constant_Nm_per_V"]
        u += friction["alpha0"] * np.sign(v) + friction["alpha2"] * v
        measured = 0.5 * (held.acted[1:-1, i] + held.acted[:-2, i])
        moving = np.abs(v) > 0.1
        parts.append(float((measured - u)[moving].std() / measured[moving].std()))
    return parts


def row(found: Case) -> str:
    """A line of the table."""
    hidden = f"`{found.hidden.effect}` of joint {found.hidden.joint}" if found.hidden else "nothing"
    named = [
        f"`{c.effect}` of joint {c.joint} ({c.share:.2f}, {c.probability:.2f})" for c in found.report.causes
    ]
    left = " ".join(f"{100 * part:.1f}" for part in found.left)
    cells = [str(found.number), left, hidden, found.report.verdict, "<br>".join(named) or "-"]
    return f"| {' | '.join([*cells, f'{found.seconds:.0f}'])} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scale", type=float, default=0.5, help="length of the logs, times 54 s")
    options = parser.parse_args()
    print(HEAD, flush=True)
    cases = []
    for number in range(options.first, options.first + options.count):
        cases.append(case(number, options.seed, options.scale))
        print(row(cases[-1]), flush=True)
    hidden = [c for c in cases if c.hidden]
    clean = [c for c in cases if not c.hidden]
    print(f"\nHidden and named first: {sum(c.is_right for c in hidden)} of {len(hidden)}.", end=" ")
    print(f"Nothing hidden, nothing named: {sum(c.is_right for c in clean)} of {len(clean)}.", end=" ")
    print(f"Wrong names: {sum(len(c.wrong) for c in cases)}.")


if __name__ == "__main__":
    main()
