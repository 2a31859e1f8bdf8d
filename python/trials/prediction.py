"""How well a MuJoCo model predicts a recorded robot, from the same states by the same commands."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from arm import PERIOD_S, STEPS
from numpy.typing import NDArray
from recorder import Recording

from rrr.mujoco_amend import effects_without_form
from rrr.mujoco_callbacks import Forces

Array = NDArray[np.float64]
WINDOW_S = 0.25
"""How far is predicted."""
NAMES = ("turn", "shoulder", "elbow")


class Predictor:
    """A model of the robot, with the forces that its XML cannot hold."""

    def __init__(self, spec: Any, left: list[dict[str, Any]]) -> None:
        self.m = spec.compile()
        self.d, self.free = mujoco.MjData(self.m), mujoco.MjData(self.m)
        self.dofs = [int(self.m.joint(name).dofadr[0]) for name in NAMES]
        self.forces = Forces(self.m, left) if left else None

    def errors(self, recording: Recording) -> tuple[Array, Array]:
        """Rms by joint of speed after one period [rad/s], and of position over 0.25 s [rad].

        Angles and speeds of the motors are put to the recorded ones at every period; what nobody
        measures (lags, delays, bristles, links behind springs) goes on by itself, and is what a free
        prediction starts from.
        """
        mujoco.set_mjcb_passive(self.forces)
        try:
            return self._errors(recording)
        finally:
            mujoco.set_mjcb_passive(None)

    def _errors(self, recording: Recording) -> tuple[Array, Array]:
        mujoco.mj_resetData(self.m, self.d)
        window = round(WINDOW_S / PERIOD_S)
        rows = len(recording.q)
        speed, position = np.zeros((rows - 1, 3)), []
        for k in range(rows - 1):
            self.d.qpos[self.dofs], self.d.qvel[self.dofs] = recording.q[k], recording.qd[k]
            if k >= window and k % window == 0 and k + window < rows:
                position.append(self._drift(recording, k, window))
            self._advance(self.d, recording.acted[k])
            speed[k] = self.d.qvel[self.dofs] - recording.qd[k + 1]
        return _rms(speed[window:]), _rms(np.concatenate(position))

    def _drift(self, recording: Recording, start: int, window: int) -> Array:
        mujoco.mj_copyData(self.free, self.m, self.d)
        away = np.empty((window, 3))
        for k in range(window):
            self._advance(self.free, recording.acted[start + k])
            away[k] = self.free.qpos[self.dofs] - recording.q[start + k + 1]
        return away

    def _advance(self, data: Any, voltage: Array) -> None:
        data.ctrl[:] = voltage
        mujoco.mj_step(self.m, data, nstep=STEPS)


def _rms(values: Array) -> Array:
    return np.sqrt((values**2).mean(axis=0))


def of_given(spec: Any) -> Predictor:
    """The model as it is given."""
    return Predictor(spec.copy(), [])


def of_amended(spec: Any, report: Any) -> Predictor:
    """The model with what a diagnosis found."""
    import rrr

    return Predictor(rrr.amend_mujoco(spec, report), effects_without_form(spec, report))
