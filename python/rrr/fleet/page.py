"""The page of the fleet."""

from __future__ import annotations

import datetime
import os
import time
from collections import defaultdict
from collections.abc import Iterable, Sequence
from html import escape

from rrr.fleet.decision import Alarm, Night
from rrr.fleet.matrix import matrix
from rrr.fleet.names import Place
from rrr.fleet.row import Row, rrr_version
from rrr.fleet.timeline import timeline
from rrr.fleet.wall import wall
from rrr.fleet.words import counted, place_words, size_words, subject_words, summary

STYLE = (
    "body{font:15px/1.5 system-ui,sans-serif;color:#282c34;max-width:1120px;margin:2rem auto;padding:0 1rem}"
    "h1{font-size:1.6rem;margin-bottom:.2rem}h2{font-size:1.15rem;margin-top:2rem;border-bottom:1px solid "
    "#e2e5e9}table{border-collapse:collapse;margin:.6rem 0}td,th{padding:.2rem .8rem .2rem 0;text-align:left;"
    "vertical-align:top;border-bottom:1px solid #e2e5e9}.lead{font-size:1.15rem}svg{max-width:100%;"
    "height:auto}.provenance{margin-top:2.5rem;color:#6b7280;font-size:.85rem}"
)
MOST = 200
"""Rows of a table; all are in the Parquet."""


def page(night: Night, rows: Sequence[Row], rate: float, output: str) -> str:
    """The page as HTML that needs no other file."""
    nights = sorted({row["night"] for row in rows if row["night"] <= night.fleet.night})
    parts = [
        f"<h1>Fleet, {night.fleet.night}</h1>\n<p class=lead>{escape(summary(night))}</p>",
        wall(night),
        _section("Which causes, and where", matrix(night), _how(rate)),
        _section("Since when", timeline(night, nights)),
        _alarms(night),
        _shared(night),
        _names("Watched: named, not sure enough for an alarm", night.watched),
        _names("No longer there since the night before", night.gone),
        _unexplained(night),
        _failed(night),
        _provenance(night, output),
    ]
    head = f'<meta charset="utf-8"><title>Fleet, {night.fleet.night}</title><style>{STYLE}</style>'
    body = "\n".join(parts)
    return f'<!doctype html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}</body></html>\n'


def _how(rate: float) -> str:
    return (
        f"The number is the probability [%] that the alarm is true, given the whole fleet; what is framed is "
        f"new since the night before. At most {100 * rate:.0f} % "
        "of the alarms of a night are false in the mean. What more than half of a batch or kind has is told "
        "once, of all of it."
    )


def _alarms(night: Night) -> str:
    head = ["whose", "cause", "since", "nights", "", "true [%]", "size"]
    rows = [
        [
            subject_words(alarm),
            place_words((alarm.effect, alarm.joint)),
            _day(alarm.since),
            str(max(name.nights for name in alarm.names)),
            "new" if alarm.is_new else "",
            f"{100 * (1 - alarm.error):.0f}",
            size_words(alarm.names),
        ]
        for alarm in night.alarms
    ]
    return _section("Alarms", _table(head, rows)) if rows else ""


def _shared(night: Night) -> str:
    """Places that several robots have named, whether alarms or not."""
    robots: dict[Place, set[str]] = defaultdict(set)
    for name in night.fleet.names:
        robots[name.place].add(name.robot)
    shared = sorted(((p, r) for p, r in robots.items() if len(r) > 1), key=lambda one: (-len(one[1]), one[0]))
    rows = [[place_words(place), str(len(names)), _listed(names)] for place, names in shared]
    return _section("Robots that share a cause", _table(["cause", "robots", ""], rows)) if rows else ""


def _names(heading: str, alarms: list[Alarm]) -> str:
    rows = [
        [subject_words(a), place_words((a.effect, a.joint)), _day(a.since), f"{100 * (1 - a.error):.0f}"]
        for a in alarms
    ]
    return _section(heading, _table(["whose", "cause", "since", "true [%]"], rows)) if rows else ""


def _unexplained(night: Night) -> str:
    """Robots with a gap that no cause explains."""
    unknown = [row for row in night.fleet.rows if row["verdict"] == "unknown"]
    rows = [[row["robot"], row["model_fault"] or "no cause is confirmed"] for row in unknown]
    return _section("A gap without a name", _table(["robot", ""], rows)) if rows else ""


def _failed(night: Night) -> str:
    rows = [[row["robot"], row["error"]] for row in night.fleet.failed]
    return _section("Could not be read", _table(["robot", "why"], rows)) if rows else ""


def _provenance(night: Night, output: str) -> str:
    seconds = float(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
    made = datetime.datetime.fromtimestamp(seconds, datetime.UTC)
    found = night.mixture
    rates = f"true {found.true_rate:.4f}, false {found.false_rate:.4f}, as taken for this night"
    rows = [
        ["Rows", output],
        ["Date", f"{made:%Y-%m-%d %H:%M} UTC"],
        ["Version", rrr_version()],
        ["Names a robot", rates],
    ]
    return _table([], rows).replace("<table", "<table class=provenance", 1)


def _section(heading: str, *parts: str) -> str:
    texts = [part if part.startswith("<") else f"<p>{escape(part)}</p>" for part in parts]
    return f"<h2>{escape(heading)}</h2>\n" + "\n".join(texts)


def _table(head: list[str], rows: list[list[str]]) -> str:
    def cells(tag: str, row: Iterable[str]) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row) + "</tr>"

    body = "".join(cells("td", row) for row in rows[:MOST])
    more = f"<p>and {counted(len(rows) - MOST, 'more row')}</p>" if len(rows) > MOST else ""
    return f"<table>{cells('th', head) if head else ''}{body}</table>{more}"


def _day(day: datetime.date) -> str:
    """A date that is not broken."""
    return str(day).replace("-", "\N{NON-BREAKING HYPHEN}")


def _listed(robots: set[str]) -> str:
    names = sorted(robots)
    return ", ".join(names[:25]) + (f" and {len(names) - 25} more" if len(names) > 25 else "")
