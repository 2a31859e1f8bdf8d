"""One robot's row."""

from __future__ import annotations

import datetime
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from rrr.fleet.inventory import Robot
from rrr.fleet.needs import needed
from rrr.fleet.settings import Options
from rrr.report import Cause, Report

Row = dict[str, Any]
"""Values by the names of `schema()`."""

FAILED = "failed"
"""The verdict on a robot whose files could not be used; `error` says why."""


@lru_cache
def schema() -> Any:
    """Columns of a row, as pyarrow's schema; docs/fleet.md tells what they mean."""
    pa = needed("pyarrow")
    text, number = pa.string(), pa.float64()
    curve, place = pa.list_(number), [("effect", text), ("joint", pa.int32()), ("probability", number)]
    cause = [("parameters", pa.map_(text, curve)), ("share", number), ("share_interval", curve)]
    cause += [("shrinkage", number), ("shrinkage_interval", curve), ("deviations", number)]
    return pa.schema(
        [
            pa.field("robot", text, False),
            ("kind", text),
            ("batch", text),
            pa.field("night", pa.date32(), False),
            pa.field("key", text, False),
            pa.field("verdict", text, False),
            ("causes", pa.list_(pa.struct(place + cause))),
            ("alternatives", pa.list_(pa.struct(place))),
            ("model_fault", text),
            ("as_given", curve),
            ("refitted", curve),
            ("with_effects", curve),
            ("noise_floor", curve),
            ("remarks", pa.list_(text)),
            ("error", text),
            ("cpu_s", number),
            ("wall_s", number),
            ("rrr_version", text),
            ("worker", text),
            ("done_at", pa.timestamp("s", tz="UTC")),
        ]
    )


def rrr_version() -> str:
    """The version of the module that is installed."""
    try:
        return version("rrr")
    except PackageNotFoundError:
        return "unknown"


def empty_row(robot: Robot, night: datetime.date, key: str) -> Row:
    """A row in which nothing is found yet."""
    known: Row = {"robot": robot.name, "kind": robot.kind, "batch": robot.batch}
    known |= {"night": night, "key": key}
    known |= {"rrr_version": rrr_version(), "done_at": datetime.datetime.now(datetime.UTC)}
    lists: Row = {"causes": [], "alternatives": [], "remarks": []}
    return {name: None for name in schema().names} | lists | known


def report_columns(report: Report) -> Row:
    """What a report says, by columns."""
    content = report.to_dict()
    fault = content.get("model_fault")
    return {
        "verdict": report.verdict,
        "causes": [_cause(cause) for cause in report.causes],
        "alternatives": [
            {"effect": a.effect, "joint": a.joint, "probability": a.probability}
            for a in report.alternatives
        ],
        "model_fault": fault["what"] if fault else None,
        "remarks": report.remarks,
        **_gap(report.gap),
    }


def deviations(shrinkage: float, interval: list[float]) -> float:
    """How many standard deviations a shrinkage with this 95 % interval lies above zero."""
    half = 0.5 * (interval[1] - interval[0])
    return 1.96 * shrinkage / max(half, 1e-9)


def _cause(cause: Cause) -> Row:
    parameters = {
        name: [float(x) for x in (value if isinstance(value, list) else [value])]
        for name, value in cause.parameters.items()
    }
    return {
        "effect": cause.effect,
        "joint": cause.joint,
        "parameters": list(parameters.items()),
        "probability": cause.probability,
        "share": cause.share,
        "share_interval": cause.share_interval,
        "shrinkage": cause.shrinkage,
        "shrinkage_interval": cause.shrinkage_interval,
        "deviations": deviations(cause.shrinkage, cause.shrinkage_interval),
    }


def _gap(gap: dict[str, list[float]]) -> Row:
    """Rms by joint, of the command; of position servos, which have none, of the position."""
    names = ("as_given", "refitted", "with_effects", "noise_floor")
    unit = "V" if gap.get("refitted_V") else "rad"
    return {name: gap.get(f"{name}_{unit}") for name in names}


def options_in_force(options: Options) -> str:
    """Version and options, which enter the key."""
    return f"rrr={rrr_version()}\n{options.text()}"
