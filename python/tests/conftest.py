"""What several tests use: the recorder of the trials, and one diagnosis of a robot with cogging."""

import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent.parent
sys.path.insert(0, str(FOLDER / "trials"))

from causes import CAUSES  # noqa: E402
from recorder import Recording  # noqa: E402
from round_trip import Outcome, recorded, tried  # noqa: E402

SCALE = 0.35
"""Of the logs' length: 19 s in all."""


@pytest.fixture(scope="session")
def recordings() -> list[Recording]:
    """A robot with nothing hidden."""
    return recorded(None, seed=5, scale=SCALE)


@pytest.fixture(scope="session")
def cogging() -> Outcome:
    """A robot with cogging, there and back."""
    return tried(next(c for c in CAUSES if c.effect == "cogging"), seed=1, scale=SCALE)
