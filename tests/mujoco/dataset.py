"""Writes a case: dataset.toml, model.toml, truth.json and the logs."""

import gzip
import json
import shutil

from motions import PERIOD
from robot import COUNTS_PER_REV, model_toml

HEADER = "t_s,q1_count,q2_count,q3_count,u1_V,u2_V,u3_V,qref1_rad,qref2_rad,qref3_rad\n"
ROW = "%.3f,%d,%d,%d,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n"


def write_case(directory, recordings, model, truth):
    """Writes all files of a case beside its place, then puts them there."""
    new = directory.with_name(f".{directory.name}")
    shutil.rmtree(new, ignore_errors=True)
    new.mkdir(parents=True)
    for recording in recordings:
        _write_log(new / f"{recording.plan.name}.csv.gz", recording)
    (new / "dataset.toml").write_text(_dataset_toml(recordings))
    (new / "model.toml").write_text(model_toml(*model))
    (new / "truth.json").write_text(json.dumps(truth, indent=1) + "\n")
    shutil.rmtree(directory, ignore_errors=True)
    new.rename(directory)


def _write_log(path, recording):
    columns = recording.counts.tolist(), recording.command.tolist()
    rows = zip(*columns, recording.plan.reference.tolist())
    text = "".join(
        ROW % (row * PERIOD, *counts, *command, *reference)
        for row, (counts, command, reference) in enumerate(rows)
    )
    with open(path, "wb") as file, gzip.GzipFile("", "wb", 6, file, mtime=0) as packed:
        packed.write((HEADER + text).encode())


def _dataset_toml(recordings):
    lines = ["format = 1", f"encoder_counts_per_rev = {COUNTS_PER_REV}"]
    for recording in recordings:
        plan = recording.plan
        lines += ["", "[[log]]", f'file = "{plan.name}.csv.gz"']
        lines += [f'experiment = "{plan.experiment}"', f'role = "{plan.role}"']
    return "\n".join(lines) + "\n"
