"""A night on Ray: a task a robot."""

from __future__ import annotations

import datetime
import os
from collections.abc import Callable, Sequence
from typing import Any

from rrr._rrr import Error
from rrr.fleet.inventory import Robot
from rrr.fleet.needs import needed
from rrr.fleet.settings import Options
from rrr.fleet.unit import Done, diagnose_robot, lost

RETRIES = 3
"""How often a robot is done again whose worker was lost."""

Progress = Callable[[int, int, Done], object]
"""Hears of each robot: how many are done, of how many, and what became of it."""


def on_ray(
    robots: Sequence[Robot],
    output: str,
    night: datetime.date,
    options: Options,
    *,
    workers: int | None = None,
    address: str | None = None,
    progress: Progress | None = None,
) -> list[Done]:
    """Diagnoses robots on Ray, a processor each; Ray hands out, waits and tries again.

    `address` is a cluster's, or "auto"; without it this machine does the work, with so many
    `workers`. A Ray that runs in this process already is used as it is.
    """
    ray = needed("ray")
    is_ours = not ray.is_initialized()
    if is_ours:
        start(workers, address)
    try:
        return _all(ray, robots, (output, night, options), progress)
    finally:
        if is_ours:
            ray.shutdown()


def start(workers: int | None, address: str | None) -> None:
    """Starts Ray, or joins a cluster. A task has one processor, so it computes on one thread."""
    os.environ.setdefault("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")
    runtime = {"env_vars": {"RAYON_NUM_THREADS": "1"}}
    needed("ray").init(
        address=address,
        num_cpus=None if address else workers,
        include_dashboard=False,
        log_to_driver=False,
        logging_level="error",
        runtime_env=runtime,
    )


def _all(
    ray: Any, robots: Sequence[Robot], night: tuple[str, datetime.date, Options], progress: Progress | None
) -> list[Done]:
    task = ray.remote(num_cpus=1, max_retries=RETRIES)(diagnose_robot)
    waiting = {task.options(name=robot.name).remote(robot, *night): robot for robot in robots}
    total, done = len(waiting), []
    while waiting:
        ready, _ = ray.wait(list(waiting), num_returns=1)
        for reference in ready:
            done.append(_result(ray, reference, waiting.pop(reference), night))
            if progress is not None:
                progress(len(done), total, done[-1])
    return sorted(done, key=lambda one: one.robot)


def _result(ray: Any, reference: Any, robot: Robot, night: tuple[str, datetime.date, Options]) -> Done:
    try:
        found: Done = ray.get(reference)
        return found
    except (ray.exceptions.WorkerCrashedError, ray.exceptions.OutOfMemoryError) as error:
        why = f"its worker was lost {RETRIES + 1} times ({type(error).__name__}): too little memory?"
    except (ray.exceptions.LocalRayletDiedError, ray.exceptions.RaySystemError) as error:
        hint = "rows that are stored stay, and the same command goes on from there"
        words = f"Ray ended in the middle of the night ({type(error).__name__})"
        raise Error(f"{words}\nhint: {hint}") from error
    except ray.exceptions.RayError as error:
        why = f"Ray could not do it: {str(error).strip().splitlines()[-1]}"
    output, date, _ = night
    return lost(robot, output, date, why)
