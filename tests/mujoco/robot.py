"""The true robot of a case, and the model that a diagnosis is given of it."""

from dataclasses import dataclass, replace

import numpy as np

from links import A2, A3, D1, D2, D3, GRAVITY, NAMES, Link, base_parameters
from regressor import mass_matrix

TORQUE_CONSTANT = np.array([12.0, 6.3, 3.0])
"""k_t [Nm/V]."""
COUNTS_PER_REV = 655360
FRICTION_NAMES = (
    "alpha0_V",
    "alpha1_V",
    "stribeck_velocity_rad_per_s",
    "alpha2_V_s_per_rad",
    "sigma0_V_per_rad",
    "sigma1_V_s_per_rad",
)
FRICTION = np.array(
    [
        [0.2285, 0.0493, 0.0031819, 0.093557, 1170.6, 3.6743],
        [0.35, 0.07, 0.003, 0.07, 196.0, 6.32],
        [0.3561, -0.1736, 0.003, 0.1252, 221.2, 1.4832],
    ]
)
"""The reference robot's, one row a joint, in the order of FRICTION_NAMES."""

SPREAD = 0.1
"""How far masses, centres, extents and friction are off the reference robot's."""
NO_STRIBECK_V = 1e-4
"""alpha1 in the model of a robot whose friction has no Stribeck peak [V]."""


def _link(mass, centre, xx, yy, zz, xy, xz, yz):
    spread = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return Link(mass, np.array(centre), spread)


REFERENCE_LINKS = (
    _link(6.0, [0.0, -0.1, 0.02], 0.03, 0.05, 0.02, 0.0, 0.0, 0.0),
    _link(
        6.2579, [0.03676, 0.00821, 0.05694],
        0.01298, 0.03358, 0.03106, -0.00042, 0.00104, -0.02641,
    ),
    _link(
        0.89095, [-0.18973, 0.0, -0.05976],
        0.02119, 0.005, 0.02698, -0.00385, 0.00151, -0.0105,
    ),
)
"""Rigid links that have the reference robot's base parameters."""
REFERENCE_ROTORS = np.array([0.2719, 0.0404, 0.0])
"""Rotor inertias seen at the joints [kg m^2]."""


@dataclass(frozen=True)
class Robot:
    """Three links, three rotors [kg m^2], friction (3 x 6, rows as FRICTION)."""

    links: tuple
    rotors: np.ndarray
    friction: np.ndarray

    @property
    def base(self):
        """Base parameters, in the order of NAMES."""
        return base_parameters(self.links, self.rotors)

    def with_rotor(self, joint, part):
        """Another rotor in a joint (1 to 3), of this part of the joint's own inertia."""
        own = self.own_inertia(joint)
        rotors = self.rotors.copy()
        rotors[joint - 1] = part * (own - rotors[joint - 1]) / (1 - part)
        return replace(self, rotors=rotors)

    def own_inertia(self, joint):
        """What the motor of a joint turns while the arm hangs, the outer joints held [kg m^2]."""
        base = dict(zip(NAMES, self.base))
        hanging = mass_matrix(self.base, np.array([-np.pi / 2]), np.array([0.0]))[0, 0, 0]
        return [hanging, base["zz2r"], base["zz3r"] + base["ia3"]][joint - 1]


def draw_robot(rng):
    """A robot up to SPREAD off the reference robot, in all that is physical."""
    links = tuple(link.scaled(rng, SPREAD) for link in REFERENCE_LINKS)
    rotors = REFERENCE_ROTORS * rng.uniform(1 - SPREAD, 1 + SPREAD, 3)
    friction = FRICTION * rng.uniform(1 - SPREAD, 1 + SPREAD, FRICTION.shape)
    return Robot(links, rotors, friction)


def draw_model(robot, rng, error, stribeck):
    """Base parameters and friction as an identification finds them: each `error` off (rms).

    `stribeck` says whether the robot's friction has a Stribeck peak.
    """
    for _ in range(100):
        factor = lambda shape: 1 + error * np.clip(rng.standard_normal(shape), -2.5, 2.5)
        base, friction = robot.base * factor(16), robot.friction * factor((3, 6))
        if is_positive_definite(base):
            break
    if not stribeck:
        friction[:, 1] = NO_STRIBECK_V
    return base, friction


def is_positive_definite(base):
    """Whether the mass matrix is positive definite over a grid of postures."""
    q2, q3 = (grid.ravel() for grid in np.meshgrid(*[np.linspace(-np.pi, np.pi, 25)] * 2))
    matrices = np.moveaxis(mass_matrix(base, q2, q3), 2, 0)
    return np.linalg.eigvalsh(matrices).min() > 1e-4


def model_toml(base, friction, digits=8):
    """The text of model.toml."""
    constants = ", ".join(f"{k:.1f}" for k in TORQUE_CONSTANT)
    lines = ["format = 1", "", "[robot]", f"gravity_m_s2 = {GRAVITY}"]
    lengths = {"d1_m": D1, "d2_m": D2, "a2_m": A2, "d3_m": D3, "a3_m": A3}
    lines += [f"{name} = {length}" for name, length in lengths.items()]
    lines += [
        f"torque_constant_Nm_per_V = [{constants}]",
        f"encoder_counts_per_rev = {COUNTS_PER_REV}",
        "sample_period_s = 0.001",
        "command_limit_V = 10.0",
        "command_bits = 16",
        "",
        "[base]",
    ]
    lines += [f"{name} = {value:.{digits}g}" for name, value in zip(NAMES, base)]
    for joint, row in enumerate(friction, 1):
        lines += ["", "[[friction]]", f"joint = {joint}"]
        lines += [f"{name} = {value:.{digits}g}" for name, value in zip(FRICTION_NAMES, row)]
    return "\n".join(lines) + "\n"
