"""Rigid links, and the 16 base parameters that they make.

Frames, signs and formulas are those of docs/model.md: mass [kg], centre [m] and central inertia
[kg m^2] of each link in its own standard Denavit-Hartenberg frame.
"""

from dataclasses import dataclass

import numpy as np

GRAVITY = 9.81
D1, D2, A2, D3, A3 = 0.56, 0.169, 0.2, 0.09, 0.415
"""Lengths [m]."""

NAMES = (
    "zz1r xx2r xy2r xz2r yz2r zz2r mx2r my2r xx3r xy3r xz3r yz3r zz3r mx3r my3r ia3".split()
)
"""Base parameters, in the order in which every array of them stands."""


@dataclass
class Link:
    """One rigid link; `spread` is the 3 x 3 integral of (r - c)(r - c)^T dm [kg m^2]."""

    mass: float
    centre: np.ndarray
    spread: np.ndarray

    @property
    def inertia(self):
        """Inertia tensor about the centre of mass [kg m^2], 3 x 3."""
        return np.trace(self.spread) * np.eye(3) - self.spread

    def scaled(self, rng, part):
        """A link whose mass, centre and extents are up to `part` off, and still physical."""
        mass, *factors = rng.uniform(1 - part, 1 + part, 7)
        stretch = np.diag(np.sqrt(factors[:3])) * np.sqrt(mass)
        centre = self.centre * np.array(factors[3:])
        return Link(self.mass * mass, centre, stretch @ self.spread @ stretch)


def base_parameters(links, rotors):
    """The 16 of three links and three rotor inertias [kg m^2], in the order of NAMES."""
    (m1, (x1, _, z1), i1), (m2, (x2, y2, z2), i2), (m3, (x3, y3, z3), i3) = (
        (link.mass, link.centre, link.inertia) for link in links
    )
    r2, r3, h2, h3 = A2 + x2, A3 + x3, D2 + z2, D2 + D3 + z3
    p = {
        "mx2r": m2 * r2 + A2 * m3, "my2r": m2 * y2, "mx3r": m3 * r3, "my3r": m3 * y3,
        "xx2r": i2[0, 0] - i2[1, 1] - A2**2 * m3 - m2 * (r2**2 - y2**2),
        "xx3r": i3[0, 0] - i3[1, 1] - m3 * (r3**2 - y3**2),
        "xy2r": i2[0, 1] - m2 * r2 * y2, "xy3r": i3[0, 1] - m3 * r3 * y3,
        "zz2r": i2[2, 2] + rotors[1] + A2**2 * m3 + m2 * (r2**2 + y2**2),
        "zz3r": i3[2, 2] + m3 * (r3**2 + y3**2), "ia3": rotors[2],
        "xz2r": i2[0, 2] - m2 * r2 * h2 - m3 * A2 * h3, "yz2r": i2[1, 2] - m2 * y2 * h2,
        "xz3r": i3[0, 2] - m3 * r3 * h3, "yz3r": i3[1, 2] - m3 * y3 * h3,
    }
    about_axis_1 = i1[1, 1] + rotors[0] + m1 * (x1**2 + z1**2)
    about_axis_1 += i2[0, 0] + m2 * (y2**2 + h2**2) + i3[0, 0] + m3 * (y3**2 + h3**2)
    p["zz1r"] = about_axis_1 - p["xx2r"] - p["xx3r"]
    return np.array([p[name] for name in NAMES])
