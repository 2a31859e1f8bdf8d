#!/usr/bin/env python3
"""Records robots with hidden causes in MuJoCo, as data sets for `rrr diagnose`."""

import argparse
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import numpy as np

from causes import DRAWS, WITH_ROTOR, Cause, draw_places
from controller import Controller, record
from dataset import write_case
from foreign import WORDS, draw_foreign
from gap import Gap, compare
from motions import plans
from plant import Plant
from robot import draw_model, draw_robot

KINDS = {"single": 0.55, "pair": 0.15, "none": 0.15, "foreign": 0.1, "triple": 0.05}
"""Kinds of cases, and how often `mixed` draws each."""
LAWS = {
    "joint": "MuJoCo's joint friction: frictionloss = k_t alpha0 and damping = k_t alpha2, "
    "default solref and solimp; no bristles, no Stribeck peak",
    "lugre": "MuJoCo's LuGre friction (dcmotor), all of the true robot's parameters",
    "tanh": "alpha0 tanh(qd / w) + alpha2 qd; w in friction_width_rad_per_s",
}
LAW_PARTS = {"joint": 0.6, "lugre": 0.2, "tanh": 0.2}
"""How often `mixed` draws each law."""
TRIES, ATTEMPTS = 4, 8
"""Draws of sizes before another robot with other joints is drawn, and draws of those."""
LEAST_GAP_V = 0.012
"""Causes that add less to the command of their joint (rms) are drawn anew."""


class Case:
    """A robot, its motions and its noise; all follow from seed, number and attempt."""

    def __init__(self, options, number, attempt=0):
        self.options, self.number = options, number
        self.rng = np.random.default_rng([options.seed, number] + [attempt + 1] * (attempt > 0))
        self.kind = self._choose(options.kind, "mixed", KINDS)
        self.law = self._choose(options.friction, "mixed", LAW_PARTS)
        self.places = self._draw_places()
        self.robot = draw_robot(self.rng)
        for name, joint in self.places:
            if name in WITH_ROTOR:
                self.robot = self.robot.with_rotor(joint, self.rng.uniform(0.08, 0.3))
        self.width = np.exp(self.rng.uniform(np.log(0.01), np.log(0.05), 3)).tolist()
        self.model = draw_model(self.robot, self.rng, options.model_error, self.law == "lugre")
        self.controller = Controller(self.model[0], self.rng.random() < 0.5)
        self.plans = plans(self.robot, self.rng, options.seconds)

    def _choose(self, given, mixed, parts):
        drawn = self.rng.choice(list(parts), p=list(parts.values()))
        return str(drawn) if given == mixed else given

    def _draw_places(self):
        """Effects and joints; singles go through the whole catalogue in turn."""
        count = {"single": 1, "pair": 2, "triple": 3}.get(self.kind, 0)
        order = np.random.default_rng(self.options.seed).permutation(list(DRAWS))
        first = str(order[(self.number - 1) % len(order)])
        return draw_places(self.rng, count, first if count == 1 else None) if count else []

    def record(self, causes, clean=None):
        """All logs with these causes; the same noise whatever the causes are.

        None as soon as the arm follows much worse than in the `clean` recordings.
        """
        plant = Plant(self.robot, self.law, self.width, causes)
        noises = np.random.default_rng([self.options.seed, self.number, 1]).spawn(len(self.plans))
        recordings = []
        for index, (plan, noise) in enumerate(zip(self.plans, noises)):
            recordings.append(record(plant, self.controller, plan, noise))
            if clean and not recordings[-1].is_tame(clean[index]):
                return None
        return recordings

    def draw_causes(self, clean):
        """The causes with their sizes; `clean` are the recordings without them."""
        if self.kind == "foreign":
            names = sorted(WORDS)
            name = names[self.number % len(names)]
            return [draw_foreign(self.rng, name, self.robot, clean, self.law)]
        commands = np.concatenate([log.command for log in clean])
        return [
            Cause(name, joint, DRAWS[name](self.rng, self.robot, joint, commands))
            for name, joint in self.places
        ]

    def make(self):
        """Recordings, causes and each cause's share of the gap; None where no size fits."""
        clean = self.record([])
        if self.kind == "none":
            return clean, []
        for _ in range(TRIES):
            causes = self.draw_causes(clean)
            recordings = self.record(causes, clean)
            described = recordings and self._described(causes, recordings, clean)
            if described:
                return recordings, described
        return None

    def _described(self, causes, recordings, clean):
        """The causes as truth.json has them; None where one makes no gap to speak of."""
        case, described = Gap(recordings, *self.model), []
        for cause in causes:
            others = [other for other in causes if other is not cause]
            twin = Gap(self.record(others) if others else clean, *self.model)
            added, figures = compare(case, twin, cause.joint)
            if added < LEAST_GAP_V:
                return None
            described.append({**_words(cause), **figures})
        return described

    def truth(self, effects):
        """The content of truth.json."""
        truth = {"kind": self.kind, "effects": effects, "friction": LAWS[self.law]}
        truth["friction_law"] = self.law
        if self.law == "tanh":
            truth["friction_width_rad_per_s"] = self.width
        truth["gravity_compensated"] = bool(self.controller.compensates)
        truth["model_error"] = self.options.model_error
        return truth


def _words(cause):
    name = cause.effect
    if name in WORDS:
        name = f"{name}: {WORDS[name]}; not in the catalogue"
    return {"effect": name, "joint": cause.joint, "parameters": cause.parameters}


def make_case(options, number):
    """Records a case and writes it; a line about it."""
    begin = time.process_time()
    name = f"mujoco-{options.seed}-{number}"
    for attempt in range(ATTEMPTS):
        case = Case(options, number, attempt)
        if made := case.make():
            break
    else:
        return f"{name}: not written, no draw of {case.places or case.kind} was fit"
    recordings, effects = made
    write_case(options.out / name, recordings, case.model, case.truth(effects))
    words = [f"{e['effect'].split(':')[0]} {e['joint']} ({e['gap_share']:.2f})" for e in effects]
    seconds = time.process_time() - begin
    return f"{name} {case.law}: {', '.join(words) or 'none'}; {seconds:.1f} s"


def arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="directory of the cases")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=1)
    parser.add_argument("--first", type=int, default=1, help="number of the first case")
    parser.add_argument("--kind", choices=[*KINDS, "mixed"], default="mixed")
    parser.add_argument("--friction", choices=[*LAWS, "mixed"], default="joint")
    parser.add_argument("--model-error", type=float, default=0.02, help="relative, rms")
    parser.add_argument("--seconds", type=float, default=72.0, help="of all logs together")
    parser.add_argument("--jobs", type=int, default=1)
    return parser.parse_args()


def main():
    options = arguments()
    numbers = range(options.first, options.first + options.count)
    with ProcessPoolExecutor(options.jobs) as pool:
        for case in as_completed([pool.submit(make_case, options, n) for n in numbers]):
            print(case.result(), flush=True)


if __name__ == "__main__":
    main()
