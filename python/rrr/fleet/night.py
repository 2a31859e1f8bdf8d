"""The end of a night: decisions and page, from the rows that are there."""

from __future__ import annotations

import datetime
from functools import lru_cache
from typing import Any

from rrr._rrr import Error
from rrr.fleet.decision import Alarm, Night, decide
from rrr.fleet.needs import needed
from rrr.fleet.page import page
from rrr.fleet.row import Row
from rrr.fleet.settings import Prior
from rrr.fleet.store import Store, parquet
from rrr.fleet.words import summary


@lru_cache
def alarm_schema() -> Any:
    """Columns of `alarms/NIGHT.parquet`."""
    pa = needed("pyarrow")
    text, flag = pa.string(), pa.bool_()
    return pa.schema(
        [
            ("night", pa.date32()),
            ("level", text),
            ("subject", text),
            ("effect", text),
            ("joint", pa.int32()),
            ("is_alarm", flag),
            ("is_new", flag),
            ("error", pa.float64()),
            ("since", pa.date32()),
            ("robots", pa.list_(text)),
            ("group_size", pa.int32()),
        ]
    )


def finish(output: str, night: datetime.date, *, rate: float, prior: Prior) -> str:
    """Decides, writes `alarms/NIGHT.parquet`, `pages/NIGHT.html` and `fleet.html`; a sentence.

    Raises `rrr.Error` where no row is there.
    """
    store = Store(output)
    rows = store.rows()
    if not any(row["night"] <= night for row in rows):
        raise Error(f"{output} has no rows up to {night}\nhint: python -m rrr.fleet INPUT {output}")
    found = decide(rows, night, rate=rate, prior=prior)
    store.write(f"alarms/{night}.parquet", parquet(alarm_rows(found), alarm_schema()))
    content = page(found, rows, rate, output).encode()
    store.write(f"pages/{night}.html", content)
    store.write("fleet.html", content)
    return f"{summary(found)}\nPage: {output}/fleet.html"


def alarm_rows(found: Night) -> list[Row]:
    """Alarms and what is watched, by the columns of `alarm_schema()`."""
    told = [_row(found, alarm, True) for alarm in found.alarms]
    return told + [_row(found, alarm, False) for alarm in found.watched]


def _row(found: Night, alarm: Alarm, is_alarm: bool) -> Row:
    own = {name: getattr(alarm, name) for name in alarm_schema().names if hasattr(alarm, name)}
    return own | {"night": found.fleet.night, "is_alarm": is_alarm}
