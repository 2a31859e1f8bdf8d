"""True and false names told apart by their evidence: two groups, as in Efron's local false discovery rate.

Evidence x is the logarithm of a name's deviations. False names follow a Laplace distribution about
the middle that the prior tells, true ones a normal one. Rates of both, and where false names lie, are
fitted to the names of the night by expectation and maximisation, beside what the prior tells; false
names are never taken for weaker than the prior has them. Where robots of a kind have gaps without a
name, their model does not fit, and misfit gives names, too. Source: Efron, "Large-scale inference",
ch. 5.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrr.fleet.settings import Prior

Array = NDArray[np.float64]
STEPS = 100


@dataclass(frozen=True)
class Mixture:
    """Names of a fleet: `true_rate` and `false_rate` are those of a robot in a night."""

    true_rate: float
    false_rate: float
    false_middle: float
    false_spread: float

    def odds(self, x: Array, misfit_rate: Array, prior: Prior) -> Array:
        """Odds of true names against false ones: those by chance, and those by misfit at this rate a
        robot, whose evidence is like that of true ones."""
        false = self.false_rate / self.likelihood_ratio(x, prior) + misfit_rate
        odds: Array = self.true_rate / false
        return odds

    def likelihood_ratio(self, x: Array, prior: Prior) -> Array:
        """Densities of true over those of false names; it never falls with the evidence."""
        middle = np.log(prior.true_deviations)
        true = np.minimum(x, middle) - middle
        false = np.maximum(x, self.false_middle) - self.false_middle
        height = 2 * self.false_spread / (prior.true_spread * np.sqrt(2 * np.pi))
        logarithm = false / self.false_spread - 0.5 * (true / prior.true_spread) ** 2
        ratio: Array = height * np.exp(logarithm)
        return ratio


def evidence(deviations: Array) -> Array:
    """x of a name; what lies below one deviation counts as one."""
    x: Array = np.log(np.maximum(deviations, 1.0))
    return x


def fitted(x: Array, misfit_rate: Array, robots: int, prior: Prior) -> Mixture:
    """The mixture of a night: evidence of all names on so many robots, each of a kind of which misfit
    names so many robots."""
    found = Mixture(
        max(prior.true_names, 0.5 * len(x) / max(robots, 1)),
        prior.false_names,
        float(np.log(prior.false_deviations)),
        prior.false_spread,
    )
    for _ in range(STEPS):
        found = _step(found, x, misfit_rate, robots, prior)
    return found


def _step(found: Mixture, x: Array, misfit_rate: Array, robots: int, prior: Prior) -> Mixture:
    odds = found.odds(x, misfit_rate, prior)
    false = 1 / (1 + odds)
    chance = false * found.false_rate / (
        found.false_rate + misfit_rate * found.likelihood_ratio(x, prior)
    )
    least = float(np.log(prior.false_deviations))
    count = chance.sum() + prior.weight
    middle = max(least, float((chance @ x + prior.weight * least) / count))
    spread = float((chance @ np.abs(x - middle) + prior.weight * prior.false_spread) / count)
    true_rate = ((1 - false).sum() + prior.true_robots * prior.true_names) / (robots + prior.true_robots)
    false_rate = float(chance.sum() + prior.robots * prior.false_names) / (robots + prior.robots)
    return Mixture(float(true_rate), false_rate, middle, max(spread, prior.false_spread))
