"""A diagnosis in a few lines, with types that a checker knows: `python typed.py LOGS MODEL.toml OUT`."""

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import rrr


def worst(report: rrr.Report) -> rrr.Cause | None:
    """The cause with the largest share of the gap."""
    return report.causes[0] if report.causes else None


def torque_limits(model: rrr.Model, q: NDArray[np.float64], qd: NDArray[np.float64]) -> list[float]:
    """The largest torque [Nm] of each joint along a motion without acceleration."""
    torques = model.inverse_dynamics(q, qd, np.zeros_like(q))
    return [float(torque) for torque in np.abs(torques).max(axis=0)]


def main(logs: str, model: str, out: Path) -> None:
    try:
        report = rrr.diagnose(logs, model)
    except rrr.Error as error:
        sys.exit(f"error: {error}")
    cause = worst(report)
    if cause is not None:
        low, high = cause.share_interval
        print(f"{cause.effect}, joint {cause.joint}: {low:.0%} to {high:.0%} of the gap")
    report.write(out)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]))
