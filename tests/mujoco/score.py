#!/usr/bin/env python3
"""Runs `rrr diagnose` on recorded cases and counts how often it is right."""

import argparse
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from verdicts import KINDS, judge

DECISIVE = 0.5
"""Share of the gap from which on a cause must be found."""
HEAD = (
    "| case | friction | truth (joint): size; share of the gap | verdict "
    "| causes (joint): size; share, probability | s |\n| --- | --- | --- | --- | --- | --- |"
)


def diagnose(rrr, case):
    """Runs the diagnosis on a case; the judged report."""
    with tempfile.TemporaryDirectory() as out:
        begin = time.monotonic()
        command = ["nice", rrr, "diagnose", case, "--model", case / "model.toml", "--out", out]
        subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return judge(case, Path(out) / "report.json", time.monotonic() - begin)


def _size(parameters):
    """The first parameter in a few digits."""
    if not parameters:
        return ""
    name, value = next(iter(parameters.items()))
    values = value if isinstance(value, list) else [value]
    return f"{name} " + " ".join(v if isinstance(v, str) else f"{v:.3g}" for v in values)


def _cause(cause):
    probability = cause.get("probability", cause.get("confidence"))
    figures = [cause.get("share", cause.get("shrinkage")), probability]
    words = ", ".join(f"{figure:.2f}" for figure in figures if figure is not None)
    return f"{cause['effect']} ({cause['joint']}): {_size(cause['parameters'])}; {words}"


def _true_cause(effect):
    share = effect.get("gap_share")
    words = f"; {share:.2f}" if share is not None else ""
    name = effect["effect"].split(":")[0]
    return f"{name} ({effect['joint']}): {_size(effect['parameters'])}{words}"


def row(judged):
    """The line of a case in the table."""
    truth = "<br>".join(map(_true_cause, judged.effects)) or "nothing"
    causes = "<br>".join(map(_cause, judged.causes)) or "-"
    law = judged.truth.get("friction_law", judged.truth["friction"].split(":")[0])
    cells = [judged.name, law, truth, judged.verdict, causes, f"{judged.seconds:.0f}"]
    return f"| {' | '.join(cells)} |"


def _count(cases, holds):
    right = sum(holds(case) for case in cases)
    return f"{right} of {len(cases)}" + (f" ({100 * right / len(cases):.0f} %)" if cases else "")


def sums(cases):
    """The counts of all cases, as lines of a table."""
    of = {kind: [c for c in cases if c.kind == kind] for kind in KINDS}
    decisive = [c for c in of["single"] if c.gap_share > DECISIVE]
    slight = [c for c in of["single"] if c.gap_share <= DECISIVE]
    first, every = (lambda c: c.first_is_right), (lambda c: c.all_are_named)
    silent, large = (lambda c: not c.causes), f"single, share above {DECISIVE}"
    wrong = sum(len(c.wrong) for c in cases)
    lines = {
        f"{large}: first cause right, with its joint": _count(decisive, first),
        f"{large}: no cause named": _count(decisive, silent),
        "other singles: first cause right, with its joint": _count(slight, first),
        "other singles: no cause named": _count(slight, silent),
        "pairs: both named": _count(of["pair"], every),
        "pairs: first cause right": _count(of["pair"], first),
        "triples: all named": _count(of["triple"], every),
        "nothing hidden: no cause named": _count(of["none"], silent),
        "foreign: no cause named": _count(of["foreign"], silent),
        "cases with a wrong name": _count(cases, lambda c: bool(c.wrong)),
        "wrong names": f"{wrong} in {len(cases)} cases",
        "failed": _count(cases, lambda c: c.verdict == "failed"),
        "seconds for a case: mean, largest": _seconds(cases),
    }
    return ["| count | |", "| --- | --- |", *(f"| {k} | {v} |" for k, v in lines.items())]


def _seconds(cases):
    seconds = [case.seconds for case in cases]
    return f"{sum(seconds) / max(len(seconds), 1):.1f}, {max(seconds, default=0):.1f}"


def case_directories(directory):
    """Directories with a truth in them, in the order of their numbers."""
    cases = [path.parent for path in directory.glob("*/truth.json")]
    visible = [case for case in cases if not case.name.startswith(".")]
    number = lambda case: [int(part) for part in case.name.split("-") if part.isdigit()]
    return sorted(visible, key=lambda case: (number(case), case.name))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", type=Path, help="directory of cases")
    parser.add_argument("--rrr", default="rrr", help="the program")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    directories = case_directories(options.directory)
    if not directories:
        parser.error(f"{options.directory} holds no case: no directory in it has a truth.json")
    print(HEAD, flush=True)
    judged = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for case in pool.map(lambda case: diagnose(options.rrr, case), directories):
            judged.append(case)
            print(row(case), flush=True)
    print("", *sums(judged), sep="\n")


if __name__ == "__main__":
    main()
