"""What a report says of a case, judged by the truth."""

import json
from dataclasses import dataclass

KINDS = ("none", "single", "pair", "triple", "foreign")
EQUIVALENT = ({"delay", "actuator_lag"},)
"""Names between which the logs cannot tell, on the same joint."""


@dataclass
class Judged:
    """A case, its truth, the report's verdict and causes, and the seconds that it took."""

    name: str
    truth: dict
    verdict: str
    causes: list
    seconds: float

    @property
    def effects(self):
        """The true causes: effect, joint, parameters, gap_share."""
        return self.truth["effects"]

    @property
    def kind(self):
        """none, single, pair, triple or foreign."""
        effects = self.truth["effects"]
        if any(effect["effect"].startswith("x_") for effect in effects):
            return "foreign"
        return KINDS[min(len(effects), 3)]

    @property
    def first_is_right(self):
        """Whether the first cause named is the (first) true one, with its joint."""
        return bool(self.causes) and any(_same(self.causes[0], e) for e in self.effects)

    @property
    def all_are_named(self):
        """Whether every true cause is among the named ones."""
        return all(any(_same(c, e) for c in self.causes) for e in self.effects)

    @property
    def wrong(self):
        """Named causes that are not in the truth."""
        return [c for c in self.causes if not any(_same(c, e) for e in self.effects)]

    @property
    def gap_share(self):
        """Of the only cause; 0 where there are none or several."""
        return self.effects[0].get("gap_share", 0.0) if len(self.effects) == 1 else 0.0


def _same(cause, effect):
    names = {cause["effect"], effect["effect"]}
    same = len(names) == 1 or any(names <= group for group in EQUIVALENT)
    return same and cause["joint"] == effect["joint"]


def judge(case, report, seconds):
    """The verdict on a case (its directory) from a report (its file, of format 1 or 2)."""
    truth = json.loads((case / "truth.json").read_text())
    if not report.exists():
        return Judged(case.name, truth, "failed", [], seconds)
    content = json.loads(report.read_text())
    causes = [c for c in content["causes"] if c["effect"] != "table"]
    return Judged(case.name, truth, content["verdict"], causes, seconds)
