"""Alarms in words."""

from __future__ import annotations

from rrr.fleet.decision import Alarm, Night
from rrr.fleet.names import Name, Place


def place_words(place: Place) -> str:
    """An effect and where it acts."""
    effect, joint = place
    where = f"joint {joint}" if joint else "whole robot"
    return f"{effect.replace('_', ' ')}, {where}"


def subject_words(alarm: Alarm) -> str:
    """Whose cause it is."""
    if alarm.level == "robot":
        return alarm.subject
    return f"{alarm.level} {alarm.subject}: {len(alarm.robots)} of {alarm.group_size} robots"


def size_words(names: list[Name]) -> str:
    """The parameters of a cause; of several robots the range of each."""
    words = []
    for parameter in names[0].parameters:
        values = [x for name in names for x in name.parameters.get(parameter, [])]
        low, high = f"{min(values):.3g}", f"{max(values):.3g}"
        words.append(f"{parameter} {low}" if low == high else f"{parameter} {low} to {high}")
    return ", ".join(words)


def summary(night: Night) -> str:
    """The night in one sentence."""
    alone = sum(alarm.level == "robot" for alarm in night.alarms)
    shared = [alarm for alarm in night.alarms if alarm.level != "robot"]
    new = sum(alarm.is_new for alarm in night.alarms)
    parts = [f"{counted(alone, 'robot')} with a cause of {'its' if alone == 1 else 'their'} own"]
    parts += [f"{place_words((a.effect, a.joint))}, common to {subject_words(a)}" for a in shared]
    read = sum(row["night"] == night.fleet.night for row in night.fleet.rows)
    head = f"{night.fleet.night}: {counted(read, 'robot')} diagnosed; " + "; ".join(parts)
    failed = f"; {counted(len(night.fleet.failed), 'robot')} could not be read" if night.fleet.failed else ""
    return f"{head}{failed}. {counted(new, 'alarm')} new, {len(night.watched)} watched."


def counted(count: int, what: str) -> str:
    """A number with its noun."""
    return f"{count or 'no'} {what}{'' if count == 1 else 's'}"
