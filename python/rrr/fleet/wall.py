"""The picture of all robots: a square each, group by group."""

from __future__ import annotations

from rrr.fleet.decision import Night
from rrr.fleet.row import Row
from rrr.fleet.svg import ALONE, FAILED, GREY, QUIET, SHARED, WATCHED, legend, picture, rectangle, text
from rrr.fleet.words import place_words

WIDTH, LABEL = 1080, 190
MEANING = [
    (ALONE, "a cause of its own"),
    (SHARED, "what its batch or kind has in common"),
    (WATCHED, "a name that is watched, no alarm"),
    (QUIET, "silent"),
    (FAILED, "could not be read; framed: new"),
]


def wall(night: Night) -> str:
    """Every robot as a square in the colour of what was found, a line for each batch."""
    colours, words = _colours(night)
    groups = _groups(night)
    new = {robot for alarm in night.alarms if alarm.is_new for robot in alarm.robots}
    cell = 15 if sum(map(len, groups.values())) <= 2000 else 8
    across = (WIDTH - LABEL) // cell
    parts, y = legend(14, MEANING), 34
    for group, robots in groups.items():
        parts.append(text(LABEL - 10, y + cell - 3, group, anchor="end"))
        for index, robot in enumerate(robots):
            x = LABEL + cell * (index % across)
            top = y + cell * (index // across)
            title = f"{robot}: {words.get(robot, 'silent')}"
            square = (x, top, cell - 2.0, cell - 2.0, colours.get(robot, QUIET), title)
            parts.append(rectangle(*square, framed=robot in new and cell > 10))
        y += cell * (1 + (len(robots) - 1) // across) + 7
    if not groups:
        parts.append(text(0, y + 12, "no robot", ink=GREY))
    return picture(WIDTH, y + 4, parts)


def _groups(night: Night) -> dict[str, list[str]]:
    """Robots by batch; those without one by kind."""
    groups: dict[str, list[str]] = {}
    for row in [*night.fleet.rows, *night.fleet.failed]:
        robots = groups.setdefault(_group(row), [])
        if row["robot"] not in robots:
            robots.append(row["robot"])
    return {group: sorted(groups[group]) for group in sorted(groups)}


def _group(row: Row) -> str:
    return " ".join(part for part in (row["kind"], row["batch"]) if part) or "kind not known"


def _colours(night: Night) -> tuple[dict[str, str], dict[str, str]]:
    """Colours and words of the robots that are not silent; what matters more comes later."""
    colours, words = {}, {}
    found = [(alarm, WATCHED) for alarm in night.watched]
    found += [(alarm, SHARED) for alarm in night.alarms if alarm.level != "robot"]
    found += [(alarm, ALONE) for alarm in night.alarms if alarm.level == "robot"]
    for alarm, colour in found:
        for robot in alarm.robots:
            colours[robot] = colour
            words[robot] = place_words((alarm.effect, alarm.joint))
    for row in night.fleet.failed:
        colours[row["robot"]], words[row["robot"]] = FAILED, row["error"]
    return colours, words
