"""The command `python -m rrr.fleet`."""

from __future__ import annotations

import argparse
import datetime
import os
import re
import sys
import tomllib
from collections import Counter
from collections.abc import Sequence

from rrr._rrr import Error, default_criteria
from rrr.fleet.decision import RATE
from rrr.fleet.inventory import Robot, one_robot, robots_of
from rrr.fleet.needs import needed
from rrr.fleet.night import finish
from rrr.fleet.ray_engine import on_ray
from rrr.fleet.settings import Options, Prior
from rrr.fleet.store import Store
from rrr.fleet.unit import Done, diagnose_robot

USAGE = """
  python -m rrr.fleet INPUT OUTPUT                      all robots of INPUT on Ray, then the page
  python -m rrr.fleet --one ROBOT OUTPUT                one robot, a folder or URL
  python -m rrr.fleet INPUT OUTPUT --index I --of N     each N-th robot from I, as a job of an array
  python -m rrr.fleet --page OUTPUT                     decisions and page of the rows that are there
  python -m rrr.fleet --pack OUTPUT                     rows of nights that are over into a file a night
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; 0 where all was done, 2 where something cannot be used."""
    options = _parser().parse_intermixed_args(arguments)
    try:
        _run(options)
    except Error as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("stopped; rows that are stored stay, and the same command goes on", file=sys.stderr)
        return 130
    return 0


def _run(options: argparse.Namespace) -> None:
    _check_places(options)
    output: str = options.places[-1]
    night = _night(options)
    Store(output)
    if options.pack:
        print(f"{Store(output).pack(before=night)} rows packed")
    elif options.page:
        _finish(output, night, options)
    elif options.one or options.index is not None:
        for robot in _few(options):
            _tell(diagnose_robot(robot, output, night, _diagnosis(options)))
    else:
        _whole_night(options.places[0], output, night, options)


def _whole_night(place: str, output: str, night: datetime.date, options: argparse.Namespace) -> None:
    done = on_ray(
        robots_of(place),
        _for_workers(output),
        night,
        _diagnosis(options),
        workers=options.workers,
        address=options.ray,
        progress=_progress,
    )
    counts = Counter(one.state for one in done)
    print(f"{len(done)} robots: " + ", ".join(f"{n} {state}" for state, n in sorted(counts.items())))
    _finish(output, night, options)


def _few(options: argparse.Namespace) -> list[Robot]:
    if options.one:
        return [one_robot(options.places[0], options.model, options.kind, options.batch)]
    robots = robots_of(options.places[0])
    count = options.of or len(robots)
    if not 0 <= options.index < count:
        raise Error(f"--index {options.index} is not from 0 to {count - 1}")
    return robots[options.index :: count]


def _finish(output: str, night: datetime.date, options: argparse.Namespace) -> None:
    prior = Prior() if options.false_names is None else Prior(false_names=options.false_names)
    print(finish(output, night, rate=options.rate, prior=prior))


def _check_places(options: argparse.Namespace) -> None:
    wanted = 1 if options.page or options.pack else 2
    if len(options.places) != wanted:
        what = "OUTPUT alone" if wanted == 1 else "INPUT (with --one: ROBOT) and OUTPUT"
        raise Error(f"{len(options.places)} places are given\nhint: give {what}; --help shows all forms")
    for name, least, most in (("rate", 0.0, 0.5), ("false_names", 0.0, 1.0)):
        value = getattr(options, name)
        if value is not None and not least < value < most:
            flag = name.replace("_", "-")
            raise Error(f"--{flag} is {value}, but must be between {least} and {most}")


def _night(options: argparse.Namespace) -> datetime.date:
    """As told, or the date with which INPUT ends, or today's in UTC."""
    end = re.search(r"(\d{4}-\d{2}-\d{2})/?$", options.places[0])
    text = options.night or (end.group(1) if end and not options.one else None)
    if text is None:
        return datetime.datetime.now(datetime.UTC).date()
    try:
        return datetime.date.fromisoformat(text)
    except ValueError:
        raise Error(f"{text!r} is no date\nhint: a night is written 2026-11-22") from None


def _diagnosis(options: argparse.Namespace) -> Options:
    return Options(options.model_doubt, _criteria(options.criteria))


def _criteria(place: str | None) -> str | None:
    """The text of a file of thresholds, whose form is checked before a night begins."""
    if place is None:
        return None
    try:
        with needed("fsspec").open(place, "rt", encoding="utf-8") as file:
            text: str = file.read()
        tomllib.loads(text)
    except (OSError, ValueError) as error:
        hint = f"keys are those of rrr.default_criteria() ({len(default_criteria().splitlines())} lines)"
        raise Error(f"{place}: {error}\nhint: {hint}") from error
    return text


def _for_workers(output: str) -> str:
    """OUTPUT as workers see it, whose folder is another."""
    return output if "://" in output else os.path.abspath(output)


def _progress(count: int, total: int, done: Done) -> None:
    if sys.stderr.isatty():
        print(f"\r{count} of {total}  {done.robot:40.40}", end="", file=sys.stderr, flush=True)
        if count == total:
            print(file=sys.stderr)
    if done.error:
        print(f"{done.robot}: {done.error.splitlines()[0]}", file=sys.stderr)


def _tell(done: Done) -> None:
    print(f"{done.robot}: {done.state}{': ' + done.error if done.error else ''}")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m rrr.fleet", USAGE, description=__doc__)
    add = parser.add_argument
    add("places", nargs="+", metavar="PLACE", help="folders or URLs of fsspec: file, s3, gs, memory, ...")
    forms = parser.add_mutually_exclusive_group()
    forms.add_argument("--one", action="store_true", help="the first place is a robot")
    forms.add_argument("--index", type=int, metavar="I", help="$SLURM_ARRAY_TASK_ID")
    forms.add_argument("--page", action="store_true", help="decisions and page alone")
    forms.add_argument("--pack", action="store_true", help="pack the rows of the nights before --night")
    add("--of", type=int, metavar="N", help="jobs in the array; without it, as many as robots")
    add("--night", help="a date, 2026-11-22; without it the one INPUT ends with, or today's in UTC")
    add("--workers", type=int, help="robots at a time on this machine; without it, its processors")
    add("--ray", metavar="ADDRESS", help="a cluster of Ray: auto, or ray://HOST:PORT")
    add("--model", help="with --one: the model, a file or URL")
    add("--kind", help="with --one: the robot's kind")
    add("--batch", help="with --one: the robot's batch")
    add("--model-doubt", type=float, help="as of rrr diagnose")
    add("--criteria", metavar="FILE", help="as of rrr diagnose")
    add("--rate", type=float, default=RATE, help="false alarms, in parts of all, in the mean (%(default)s)")
    add("--false-names", type=float, help="false names a healthy robot gets in a night (0.02)")
    return parser


if __name__ == "__main__":
    sys.exit(main())
