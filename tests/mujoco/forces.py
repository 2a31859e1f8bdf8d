"""Causes that depend on angle or speed and that no element of the engine plays, in volts."""

import math


def _wave(p, q):
    return math.sin(p["harmonic"] * q + p["phase_rad"])


VOLTAGES = {
    "cogging": lambda p, q, v, w: p["amplitude_V"] * _wave(p, q),
    "torque_ripple": lambda p, q, v, w: w * p["relative_amplitude"] * _wave(p, q),
    "quadratic_drag": lambda p, q, v, w: -p["coefficient_V_s2_per_rad2"] * v * abs(v),
}
"""Added voltage [V] of parameters, angle [rad], speed [rad/s] and motor voltage [V]."""


def _asymmetry(p, q, v, load, time):
    factor = 1 + p["relative_asymmetry"] * math.copysign(1.0, v)
    return factor, 0.0, factor


def _drift(p, q, v, load, time):
    factor = 1 + p["relative_change"] * (1 - math.exp(-time / p["time_constant_s"]))
    return factor, 0.0, factor


def _over_the_turn(p, q, v, load, time):
    return 1 + p["relative_amplitude"] * _wave(p, q), 0.0, 1.0


def _with_load(p, q, v, load, time):
    return 1.0, p["coefficient_V_per_Nm"] * abs(load), 1.0


SCALES = {
    "asymmetric_friction": _asymmetry,
    "friction_drift": _drift,
    "position_friction": _over_the_turn,
    "load_friction": _with_load,
}
"""Factor on friction's level, added level [V] and factor on its viscous part, of parameters,
angle [rad], speed [rad/s], load c + h [Nm] and time [s]."""


class JointFriction:
    """MuJoCo's `frictionloss` and `damping`.

    The constraint holds within +-frictionloss, sliding or not. A band that is stronger one way is
    the symmetric band with an offset, so asymmetry is a voltage here.
    """

    def __init__(self, index, alpha, k_t, plant):
        self.index, self.alpha, self.k_t = plant.motor_dof[index], alpha, k_t
        self.model = plant.model

    def voltage(self, scale, effect, p, v):
        """What remains to be added [V] once the engine's own friction is set."""
        if effect == "asymmetric_friction":
            e = p["relative_asymmetry"]
            return -e * (self.alpha[0] + self.alpha[3] * abs(v))
        level, added, viscous = scale
        self.model.dof_frictionloss[self.index] = self.k_t * max(
            self.alpha[0] * level + added, 0.0
        )
        self.model.dof_damping[self.index] = self.k_t * self.alpha[3] * viscous
        return 0.0


class BristleFriction:
    """MuJoCo's LuGre friction of a `dcmotor`."""

    def __init__(self, index, alpha, k_t, plant):
        self.index, self.alpha, self.k_t = 3 + index, alpha, k_t
        self.model = plant.model

    def voltage(self, scale, effect, p, v):
        """Sets the engine's own friction; nothing remains to be added [V]."""
        level, added, viscous = scale
        a0, a1 = self.alpha[:2]
        self.model.actuator_biasprm[self.index, 3] = self.k_t * (a0 * level + added)
        self.model.actuator_biasprm[self.index, 4] = self.k_t * ((a0 + a1) * level + added)
        self.model.actuator_damping[self.index] = self.k_t * self.alpha[3] * viscous
        return 0.0


class SmoothFriction:
    """A tanh of speed in place of Coulomb's jump: it creeps under any load."""

    def __init__(self, index, alpha, width):
        self.index, self.alpha, self.width = index, alpha, width

    def voltage(self, scale, effect, p, v):
        """All of friction [V]."""
        level, added, viscous = scale
        coulomb = (self.alpha[0] * level + added) * math.tanh(v / self.width)
        return -coulomb - self.alpha[3] * viscous * v
