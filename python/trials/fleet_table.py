"""What the fleet's trial found, as the table of docs/fleet.md."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from rrr.fleet.decision import Night
from rrr.fleet.row import Row

DOLLARS_PER_CORE_HOUR = 0.05


@dataclass
class Outcome:
    """A night's alarms against the truth."""

    night: Night
    rows: list[Row]
    wall_s: float
    killed: str | None
    found: int
    hidden: int
    false: int
    false_names: int


def table(outcomes: list[Outcome], workers: int) -> str:
    """The table of docs/fleet.md."""
    lines = ["| what | " + " | ".join(str(o.night.fleet.night) for o in outcomes) + " |"]
    lines.append("| --- " * (len(outcomes) + 1) + "|")
    for name, words in (
        ("robots, rows, robots with exactly one row", _rows),
        ("the robot whose worker was killed", _killed),
        ("causes found, of those hidden", lambda o: f"{o.found} of {o.hidden}"),
        ("alarms: of a robot, of a batch or kind", _alarms),
        ("false alarms", lambda o: str(o.false)),
        ("false names before the decision", lambda o: str(o.false_names)),
        ("new alarms", lambda o: str(sum(a.is_new for a in o.night.alarms))),
        ("watched names", lambda o: str(len(o.night.watched))),
        ("processor seconds a robot, mean and longest", _seconds),
        ("the whole night", lambda o: f"{o.wall_s:.0f} s on {workers} processors"),
        ("10,000 robots, diagnoses alone", lambda o: _price(sum(_cpu(o)) / len(o.rows))),
        ("10,000 robots, all that the night took", lambda o: _price(workers * o.wall_s / len(o.rows))),
    ):
        lines.append(f"| {name} | " + " | ".join(words(o) for o in outcomes) + " |")
    return "\n".join(lines)


def _rows(o: Outcome) -> str:
    counts = Counter(row["robot"] for row in o.rows)
    return f"{len(counts)}, {len(o.rows)}, {sum(n == 1 for n in counts.values())}"


def _killed(o: Outcome) -> str:
    row = [row for row in o.rows if row["robot"] == o.killed]
    return f"{o.killed}: {len(row)} row, {row[0]['verdict']}" if row else f"{o.killed}: no row"


def _alarms(o: Outcome) -> str:
    alone = sum(alarm.level == "robot" for alarm in o.night.alarms)
    return f"{alone}, {len(o.night.alarms) - alone}"


def _cpu(o: Outcome) -> list[float]:
    return [row["cpu_s"] for row in o.rows]


def _seconds(o: Outcome) -> str:
    return f"{sum(_cpu(o)) / len(o.rows):.2f}, {max(_cpu(o)):.1f}"


def _price(seconds: float) -> str:
    hours = 10_000 * seconds / 3600
    return f"{hours:.1f} core-hours, {hours * DOLLARS_PER_CORE_HOUR:.2f} dollars"
