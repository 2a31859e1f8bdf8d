"""The model of an unknown robot."""

from __future__ import annotations

from os import PathLike

from rrr import _rrr
from rrr.logs import Logs, as_dataset
from rrr.model import Model, as_path
from rrr.progress import Progress, heard


def identify(
    logs: Logs,
    robot: Model | str | PathLike[str],
    *,
    progress: bool | Progress = True,
) -> Model:
    """Identifies a robot from its recorded experiments, as `rrr identify` does.

    `logs` is the folder of a campaign, or arrays as of `diagnose`; `robot` is a robot.toml or a
    `Model` with what the manufacturer tells. What else must be said of the model is in its
    `remarks`. Threads, `progress`, Ctrl-C and errors are as of `diagnose`.
    """
    with as_path(robot) as path, as_dataset(logs, path) as dataset, heard(progress) as hears:
        found, remarks = _rrr.identify(dataset, path, hears)
    return Model(found, remarks)
