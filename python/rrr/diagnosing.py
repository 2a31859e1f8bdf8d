"""Where a robot differs from its model."""

from __future__ import annotations

from os import PathLike

from rrr import _rrr
from rrr.logs import Logs, as_dataset
from rrr.model import Model, as_path
from rrr.progress import Progress, heard
from rrr.report import Report


def diagnose(
    logs: Logs,
    model: Model | str | PathLike[str],
    *,
    criteria: str | PathLike[str] | None = None,
    model_doubt: float | None = None,
    progress: bool | Progress = True,
) -> Report:
    """Finds what causes the gap between a real robot and its model, as `rrr diagnose` does.

    `logs` is the folder of a data set, or arrays: a `Log`, a mapping with its keys (t, q, u, qref,
    role, experiment), or several of them. `model` is a model.toml or a `Model`. `criteria` is a file of
    thresholds (`default_criteria()` shows all), `model_doubt` how far the model's parameters may be
    off, in parts of themselves: 0.025 after an identification, 0.2 for a model from drawings.

    Other threads of Python go on meanwhile. `progress` hears each step: a function of a sentence,
    True for tqdm where it is installed, False for silence. Ctrl-C is raised at once.

    Raises `rrr.Error`, in the words of the command line, where logs or model cannot be used.
    """
    with as_path(model) as path, as_dataset(logs, path) as dataset, heard(progress) as hears:
        found = _rrr.diagnose(dataset, path, criteria, model_doubt, hears)
    return Report(found)
