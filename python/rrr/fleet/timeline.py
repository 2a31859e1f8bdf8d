"""The picture of time: since when each alarm stands."""

from __future__ import annotations

import datetime

from rrr.fleet.decision import Alarm, Night
from rrr.fleet.svg import ALONE, GREY, SHARED, line, picture, rectangle, text
from rrr.fleet.words import place_words, subject_words

WIDTH, LABEL, LINE, MOST = 1080, 430, 20, 60
LONGEST = 30
"""Nights that are drawn, the last of those there are."""


def timeline(night: Night, nights: list[datetime.date]) -> str:
    """A bar for each alarm, from the night on which it began to this one."""
    nights = nights[-LONGEST:]
    step = min(60.0, (WIDTH - LABEL) / len(nights))
    alarms = sorted(night.alarms, key=lambda a: (a.since, a.level == "robot", a.subject))[:MOST]
    parts = _dates(nights, step, 24 + LINE * len(alarms))
    for row, alarm in enumerate(alarms):
        parts += _bar(alarm, nights, step, 24 + LINE * row)
    if not alarms:
        parts.append(text(0, 40, "No alarm stands.", ink=GREY))
    return picture(WIDTH, 50 + LINE * len(alarms), parts)


def _bar(alarm: Alarm, nights: list[datetime.date], step: float, y: float) -> list[str]:
    first = next((i for i, night in enumerate(nights) if night >= alarm.since), len(nights) - 1)
    colour = ALONE if alarm.level == "robot" else SHARED
    words = f"{subject_words(alarm)}: {place_words((alarm.effect, alarm.joint))}"
    x, width = LABEL + step * first + 2, step * (len(nights) - first) - 4
    bar = rectangle(x, y + 3, width, LINE - 6, colour, words)
    return [text(0, y + 14, words), bar]


def _dates(nights: list[datetime.date], step: float, bottom: float) -> list[str]:
    every = max(1, round(70 / step))
    parts = []
    for index, night in enumerate(nights):
        x = LABEL + step * index
        parts.append(line(x, 20, x, bottom))
        if (len(nights) - 1 - index) % every == 0:
            parts.append(text(x + step / 2, 14, f"{night:%d %b}", anchor="middle", size=11, ink=GREY))
    return [*parts, line(LABEL + step * len(nights), 20, LABEL + step * len(nights), bottom)]
