"""Effects that MuJoCo has no form for, as a callback for passive forces.

This file stands alone beside the XML; it needs `mujoco` and numpy.

    model = mujoco.MjModel.from_xml_path("arm.xml")
    install(model)                     # once, for this model
    q = read(model, data)              # what the encoders read

Joints are numbered from 1, 0 is the whole robot. Forces depend on the state, the command and the time;
friction that changes does so through `dof_frictionloss` and `dof_damping`, or through the LuGre friction
of a `dcmotor`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

EFFECTS: list[dict[str, Any]] = []

Parameters = dict[str, Any]
WIDTH_RAD_PER_S = 1e-3
"""Below this speed friction that is added passes through zero evenly."""


class Joint:
    """A joint with an effect, and the drive that it has."""

    def __init__(self, m: Any, effect: dict[str, Any]) -> None:
        joint = m.joint(effect["name"])
        self.q, self.dof = int(joint.qposadr[0]), int(joint.dofadr[0])
        self.torque_constant = float(effect["torque_constant"])
        self.coulomb, self.viscous = float(effect["coulomb"]), float(effect["viscous"])
        name = effect["actuator"]
        self.actuator = None if name is None else int(m.actuator(name).id)
        self.bristles = _bristles(m, int(joint.id))
        self.scales = (1.0, 0.0, 1.0)

    def command(self, m: Any, d: Any) -> float:
        """What reaches the motor, after delay, limit and lag, in the command's unit."""
        a = self.actuator
        if a is None:
            return 0.0
        if m.actuator_actnum[a]:
            return float(d.act[m.actuator_actadr[a]])
        u = float(d.ctrl[m.actuator_ctrladr[a]])
        if m.actuator_delay[a]:
            u = float(np.ravel(mujoco.mj_readCtrl(m, d, a, d.time, 0))[0])
        low, high = m.actuator_ctrlrange[m.actuator_ctrladr[a]]
        return min(max(u, low), high) if m.actuator_ctrllimited[m.actuator_ctrladr[a]] else u

    def load(self, m: Any, d: Any) -> float:
        """Coriolis and gravity torque [Nm]; of the step before."""
        return float(d.qfrc_bias[self.dof])

    def scale_friction(self, level: float, added: float, viscous: float) -> None:
        """Friction's level times a factor and with a torque added [Nm], its viscous part times one: by
        this effect; those of others come to it."""
        self.scales = (level, added, viscous)

    def set_friction(self, m: Any, level: float, added: float, viscous: float) -> None:
        """The same, by all effects."""
        coulomb = max(level * self.coulomb + added, 0.0)
        m.dof_damping[self.dof] = viscous * self.viscous
        if self.bristles is None:
            m.dof_frictionloss[self.dof] = coulomb
            return
        a, (first, second) = self.bristles
        factor = coulomb / max(self.coulomb, 1e-12)
        m.actuator_biasprm[a, 3], m.actuator_biasprm[a, 4] = first * factor, second * factor


def _bristles(m: Any, joint: int) -> tuple[int, tuple[float, float]] | None:
    """The `dcmotor` with LuGre friction on a joint, and its levels."""
    for a in range(len(m.actuator_trntype)):
        if m.actuator_trnid[a, 0] == joint and m.actuator_dynprm[a, 5] > 0:
            if m.actuator_biastype[a] == int(mujoco.mjtBias.mjBIAS_DCMOTOR):
                return a, (float(m.actuator_biasprm[a, 3]), float(m.actuator_biasprm[a, 4]))
    return None


def _wave(p: Parameters, q: float) -> float:
    return math.sin(p["harmonic"] * q + p["phase_rad"])


def _sign(v: float) -> float:
    return math.tanh(v / WIDTH_RAD_PER_S)


def _asymmetric(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    """(1 + e) forwards and (1 - e) backwards: symmetric friction with an offset."""
    speed = abs(float(d.qvel[joint.dof]))
    return float(-p["relative_asymmetry"] * (joint.coulomb + joint.viscous * speed))


def _viscous_asymmetry(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    return float(-p["relative_asymmetry"] * joint.viscous * abs(d.qvel[joint.dof]))


def _position_friction(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    level = 1 + p["relative_amplitude"] * _wave(p, float(d.qpos[joint.q]))
    joint.scale_friction(level, 0.0, 1.0)
    return 0.0


def _load_friction(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    slope = abs(joint.torque_constant) * p["coefficient_V_per_Nm"]
    by_motor = p.get("by_motor_torque", 0.0) >= 0.5
    load = joint.torque_constant * joint.command(m, d) if by_motor else joint.load(m, d)
    joint.scale_friction(1.0, slope * abs(load), 1.0)
    return 0.0


def _drift(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    factor = 1 + p["relative_change"] * (1 - math.exp(-float(d.time) / p["time_constant_s"]))
    joint.scale_friction(factor, 0.0, factor)
    return 0.0


def _stribeck(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    v = float(d.qvel[joint.dof])
    peak = math.exp(-((v / p["stribeck_velocity_rad_per_s"]) ** 2))
    return -joint.torque_constant * p["alpha1_V"] * peak * _sign(v)


def _ripple(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    wave = p["relative_amplitude"] * _wave(p, float(d.qpos[joint.q]))
    return joint.torque_constant * wave * joint.command(m, d)


def _dead_zone(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    u, half = joint.command(m, d), p["half_width_V"]
    return -joint.torque_constant * min(max(u, -half), half)


def _drag(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    v = float(d.qvel[joint.dof])
    return -joint.torque_constant * p["coefficient_V_s2_per_rad2"] * v * abs(v)


def _spring(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    away = float(d.qpos[joint.q]) - p["rest_rad"]
    return -joint.torque_constant * p["stiffness_V_per_rad"] * away


def _cogging(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    return joint.torque_constant * p["amplitude_V"] * _wave(p, float(d.qpos[joint.q]))


def _offset(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    return joint.torque_constant * float(p["offset_V"])


def _table(joint: Joint, p: Parameters, m: Any, d: Any) -> float:
    """A curve over an axis; constant beyond its ends."""
    axes: dict[str, Callable[[], Any]] = {
        "position": lambda: d.qpos[joint.q],
        "velocity": lambda: d.qvel[joint.dof],
        "load": lambda: joint.load(m, d),
        "command": lambda: joint.command(m, d),
        "time": lambda: d.time,
    }
    x = float(axes[p["axis"]]())
    return joint.torque_constant * float(np.interp(x, p["knots"], p["values_V"]))


ON_JOINT: dict[str, Callable[[Joint, Parameters, Any, Any], float]] = {
    "asymmetric_friction": _asymmetric,
    "viscous_asymmetry": _viscous_asymmetry,
    "position_friction": _position_friction,
    "load_friction": _load_friction,
    "friction_drift": _drift,
    "stribeck": _stribeck,
    "torque_ripple": _ripple,
    "dead_zone": _dead_zone,
    "quadratic_drag": _drag,
    "cable_spring": _spring,
    "cogging": _cogging,
    "dac_offset": _offset,
    "table": _table,
}
"""Added torque [Nm; N] of a joint, the parameters, and MuJoCo's model and data."""
CHANGE_FRICTION = (_position_friction, _load_friction, _drift)
"""Of these, those that change the joint's own friction instead."""


def _tip_force(p: Parameters, height: float) -> list[float]:
    return [float(x) for x in p["force_N"]]


def _contact(p: Parameters, height: float) -> list[float]:
    return [0.0, 0.0, p["stiffness_N_per_m"] * max(p["height_m"] - height, 0.0)]


ON_TIP: dict[str, Callable[[Parameters, float], list[float]]] = {
    "tip_force": _tip_force,
    "contact": _contact,
}
"""Force on the tip [N], world frame, of the parameters and the tip's height [m]."""
ON_READING = ("encoder_eccentricity", "encoder_offset")


class Forces:
    """Adds the forces of a list of effects to `qfrc_passive`."""

    def __init__(self, m: Any, effects: list[dict[str, Any]]) -> None:
        self.on_joint, self.on_tip = [], []
        for effect in effects:
            name, p = effect["effect"], effect["parameters"]
            if name in ON_JOINT:
                self.on_joint.append((ON_JOINT[name], Joint(m, effect), p))
            elif name in ON_TIP:
                body = int(m.body(effect["body"]).id)
                self.on_tip.append((ON_TIP[name], body, np.array(effect["tip_m"]), p))
            elif name not in ON_READING:
                raise ValueError(f"the effect {name} has no form here")
        rubbing: dict[int, list[Joint]] = {}
        for torque, joint, _ in self.on_joint:
            if torque in CHANGE_FRICTION:
                rubbing.setdefault(joint.dof, []).append(joint)
        self.rubbing = list(rubbing.values())

    def __call__(self, m: Any, d: Any) -> None:
        for torque, joint, p in self.on_joint:
            d.qfrc_passive[joint.dof] += torque(joint, p, m, d)
        for joints in self.rubbing:
            levels, added, viscous = zip(*(joint.scales for joint in joints), strict=True)
            joints[0].set_friction(m, math.prod(levels), sum(added), math.prod(viscous))
        for force, body, tip, p in self.on_tip:
            place = d.xpos[body] + d.xmat[body].reshape(3, 3) @ tip
            pushed = np.array(force(p, float(place[2])))
            mujoco.mj_applyFT(m, d, pushed, np.zeros(3), place, body, d.qfrc_passive)


def install(m: Any) -> None:
    """From now on MuJoCo adds the forces of this file, to whatever it steps: this model alone must be
    stepped until `mujoco.set_mjcb_passive(None)`."""
    mujoco.set_mjcb_passive(Forces(m, EFFECTS))


def read(m: Any, d: Any, effects: list[dict[str, Any]] | None = None) -> dict[str, float]:
    """What the encoders of joints with a wrong reading tell [rad], by the joints' names."""
    readings: dict[str, float] = {}
    for effect in EFFECTS if effects is None else effects:
        if effect["effect"] in ON_READING:
            name, p = effect["name"], effect["parameters"]
            q = readings.get(name, float(d.joint(name).qpos[0]))
            if effect["effect"] == "encoder_offset":
                readings[name] = q - p["offset_rad"]
            else:
                readings[name] = q + p["amplitude_rad"] * math.sin(q + p["phase_rad"])
    return readings

