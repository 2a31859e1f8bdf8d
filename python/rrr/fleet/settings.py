"""What a night of the fleet is run with."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Options:
    """How every robot is diagnosed; `criteria` is the text of a file of thresholds."""

    model_doubt: float | None = None
    criteria: str | None = None

    def text(self) -> str:
        """What of it enters a row's key."""
        return f"model_doubt={self.model_doubt!r}\ncriteria={self.criteria!r}\n"


@dataclass(frozen=True)
class Prior:
    """What is known of names before a night is seen; docs/fleet.md tells where the figures come from.

    A name's evidence is its deviations: how many standard deviations its shrinkage, on the logs that
    chose nothing, lies above zero.
    """

    false_names: float = 0.02
    """False names that a healthy robot gets in a night: 98 % silence,"""
    robots: float = 500.0
    """as if so many healthy robots had been seen. A large fleet shows its own rate."""
    false_deviations: float = 6.0
    """Deviations of a false name, in the middle,"""
    false_spread: float = 0.6
    """and how their logarithm spreads about it: the scale of a Laplace distribution, whose tail is long."""
    true_deviations: float = 80.0
    """Deviations of a true name, in the middle,"""
    true_spread: float = 1.2
    """and the standard deviation of their logarithm."""
    misfit_names: float = 0.35
    """False names for each robot with the verdict "unknown": where parameters are further off than the
    doubt about them, some gaps get no name and some a wrong one, which has as many
    deviations as a true one has."""
    weight: float = 20.0
    """So many names of a night weigh as much as what is said here of false ones."""
    true_names: float = 0.005
    """True names that a robot gets in a night,"""
    true_robots: float = 200.0
    """as if so many robots had been seen, too."""
    elevated: float = 0.01
    """Probability that a place (an effect on a joint) is named more often in a group than elsewhere."""
    neighbours: float = 20.0
    """So many robots of the whole fleet tell as much of a kind as its own robots."""
    again: float = 0.9
    """Part of the true names that stand again on the next night's logs,"""
    false_again: float = 0.5
    """and of the false ones: what misleads a diagnosis is in the robot as often as in the noise."""
