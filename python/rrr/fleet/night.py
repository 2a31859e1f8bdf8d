"""The end of a night: decisions and page, from the rows that are there."""

from __future__ import annotations

import datetime

from rrr._rrr import Error
from rrr.fleet.decision import Alarm, Night, decide
from rrr.fleet.needs import needed
from rrr.fleet.page import page
from rrr.fleet.row import Row
from rrr.fleet.settings import Prior
from rrr.fleet.store import Store, parquet
from rrr.fleet.words import summary

_pa = needed("pyarrow")
ALARMS = _pa.schema(
    [
        ("night", _pa.date32()),
        ("level", _pa.string()),
        ("subject", _pa.string()),
        ("effect", _pa.string()),
        ("joint", _pa.int32()),
        ("is_alarm", _pa.bool_()),
        ("is_new", _pa.bool_()),
        ("error", _pa.float64()),
        ("since", _pa.date32()),
        ("robots", _pa.list_(_pa.string())),
        ("group_size", _pa.int32()),
    ]
)
"""Columns of `alarms/NIGHT.parquet`."""


def finish(output: str, night: datetime.date, *, rate: float, prior: Prior) -> str:
    """Decides, writes `alarms/NIGHT.parquet`, `pages/NIGHT.html` and `fleet.html`; a sentence.

    Raises `rrr.Error` where no row is there.
    """
    store = Store(output)
    rows = store.rows()
    if not any(row["night"] <= night for row in rows):
        raise Error(f"{output} has no rows up to {night}\nhint: python -m rrr.fleet INPUT {output}")
    found = decide(rows, night, rate=rate, prior=prior)
    store.write(f"alarms/{night}.parquet", parquet(alarm_rows(found), ALARMS))
    content = page(found, rows, rate, output).encode()
    store.write(f"pages/{night}.html", content)
    store.write("fleet.html", content)
    return f"{summary(found)}\nPage: {output}/fleet.html"


def alarm_rows(found: Night) -> list[Row]:
    """Alarms and what is watched, as rows of `ALARMS`."""
    told = [_row(found, alarm, True) for alarm in found.alarms]
    return told + [_row(found, alarm, False) for alarm in found.watched]


def _row(found: Night, alarm: Alarm, is_alarm: bool) -> Row:
    own = {name: getattr(alarm, name) for name in ALARMS.names if hasattr(alarm, name)}
    return own | {"night": found.fleet.night, "is_alarm": is_alarm}
