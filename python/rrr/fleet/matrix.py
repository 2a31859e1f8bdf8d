"""The picture of causes: places across, robots and groups down."""

from __future__ import annotations

from rrr.fleet.decision import Alarm, Night
from rrr.fleet.names import Place
from rrr.fleet.svg import ALONE, GREY, GRID, SHARED, WATCHED, line, picture, rectangle, slanted, text
from rrr.fleet.words import place_words, subject_words

MOST = 60
"""Lines that are drawn; the rest is in the table of alarms."""
Subject = tuple[str, str]
"""Level of an alarm and whose it is."""
LABEL, LINE, HEAD, WIDTH = 280, 22, 130, 960


def matrix(night: Night) -> str:
    """Which causes, and where: a line for each robot or group with an alarm or a watched name, a
    column for each effect on a joint; the number is the probability that it is true [%]."""
    entries = ([(a, True) for a in night.alarms] + [(a, False) for a in night.watched])[:MOST]
    subjects: list[Subject] = list(dict.fromkeys((a.level, a.subject) for a, _ in entries))
    subjects.sort(key=lambda subject: (subject[0] == "robot", subject[1]))
    places = sorted({(a.effect, a.joint) for a, _ in entries})
    if not entries:
        return picture(400, 20, [text(0, 14, "No cause is named at any robot.", ink=GREY)])
    cell = min(62.0, (WIDTH - LABEL) / len(places))
    parts = _frame(subjects, places, entries, cell)
    for alarm, is_alarm in entries:
        row, column = subjects.index((alarm.level, alarm.subject)), places.index((alarm.effect, alarm.joint))
        parts += _cell(alarm, is_alarm, LABEL + cell * column, HEAD + LINE * row, cell)
    width = LABEL + cell * len(places) + 120
    return picture(width, HEAD + LINE * len(subjects) + 6, parts)


def _frame(
    subjects: list[Subject], places: list[Place], entries: list[tuple[Alarm, bool]], cell: float
) -> list[str]:
    labels: dict[Subject, str] = {(a.level, a.subject): subject_words(a) for a, _ in entries}
    right = LABEL + cell * len(places)
    parts = [slanted(LABEL + cell * (i + 0.5), HEAD - 8, place_words(p)) for i, p in enumerate(places)]
    for row, subject in enumerate(subjects):
        y = HEAD + LINE * row
        parts += [line(0, y, right, y), text(0, y + 15, labels[subject])]
    bottom = HEAD + LINE * len(subjects)
    return [*parts, line(0, bottom, right, bottom, GRID)]


def _cell(alarm: Alarm, is_alarm: bool, x: float, y: float, width: float) -> list[str]:
    colour = (ALONE if alarm.level == "robot" else SHARED) if is_alarm else WATCHED
    title = f"{subject_words(alarm)}: {place_words((alarm.effect, alarm.joint))}, since {alarm.since}"
    is_new = is_alarm and alarm.is_new
    percent = f"{100 * (1 - alarm.error):.0f}"
    ink = "#ffffff" if is_alarm else "#282c34"
    return [
        rectangle(x + 2, y + 2, width - 4, LINE - 4, colour, title, framed=is_new),
        text(x + width / 2, y + 15, percent, anchor="middle", ink=ink),
    ]
