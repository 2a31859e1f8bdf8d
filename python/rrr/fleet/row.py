"""One robot's row."""

from __future__ import annotations

import datetime
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from rrr.fleet.inventory import Robot
from rrr.fleet.needs import needed
from rrr.fleet.settings import Options
from rrr.report import Cause, Report

Row = dict[str, Any]
"""Values by the names of `SCHEMA`."""

FAILED = "failed"
"""The verdict on a robot whose files could not be used; `error` says why."""

_pa = needed("pyarrow")
_text, _number = _pa.string(), _pa.float64()
_curve = _pa.list_(_number)

CAUSE = _pa.struct(
    [
        ("effect", _text),
        ("joint", _pa.int32()),
        ("parameters", _pa.map_(_text, _curve)),
        ("probability", _number),
        ("share", _number),
        ("share_interval", _curve),
        ("shrinkage", _number),
        ("shrinkage_interval", _curve),
        ("deviations", _number),
    ]
)
PLACE = _pa.struct([("effect", _text), ("joint", _pa.int32()), ("probability", _number)])

SCHEMA = _pa.schema(
    [
        _pa.field("robot", _text, False),
        ("batch", _text),
        ("kind", _text),
        _pa.field("night", _pa.date32(), False),
        _pa.field("key", _text, False),
        _pa.field("verdict", _text, False),
        ("causes", _pa.list_(CAUSE)),
        ("alternatives", _pa.list_(PLACE)),
        ("model_fault", _text),
        ("as_given", _curve),
        ("refitted", _curve),
        ("with_effects", _curve),
        ("noise_floor", _curve),
        ("remarks", _pa.list_(_text)),
        ("error", _text),
        ("cpu_s", _number),
        ("wall_s", _number),
        ("rrr_version", _text),
        ("worker", _text),
        ("done_at", _pa.timestamp("s", tz="UTC")),
    ]
)
"""Columns of a row; docs/fleet.md tells what they mean."""


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
    return {name: None for name in SCHEMA.names} | lists | known


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
