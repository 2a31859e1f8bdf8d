"""Torques of the rigid robot, linear in its 16 base parameters."""

import numpy as np

from links import A2, GRAVITY, NAMES


def mass_matrix(base, q2, q3):
    """D of docs/model.md for n postures, 3 x 3 x n [kg m^2]; angles [rad] may be complex."""
    p = dict(zip(NAMES, base))
    s2, c2, s23, c23 = np.sin(q2), np.cos(q2), np.sin(q2 + q3), np.cos(q2 + q3)
    elbow = A2 * (p["mx3r"] * np.cos(q3) - p["my3r"] * np.sin(q3))
    d11 = p["zz1r"] + p["xx2r"] * s2**2 + 2 * p["xy2r"] * s2 * c2
    d11 = d11 + p["xx3r"] * s23**2 + 2 * p["xy3r"] * s23 * c23
    d11 = d11 + 2 * A2 * c2 * (p["mx3r"] * c23 - p["my3r"] * s23)
    d13 = p["xz3r"] * s23 + p["yz3r"] * c23
    d12 = p["xz2r"] * s2 + p["yz2r"] * c2 + d13
    d22 = p["zz2r"] + p["zz3r"] + 2 * elbow
    d23 = p["zz3r"] + elbow
    d33 = p["zz3r"] + p["ia3"] + 0 * q2
    return np.array([[d11, d12, d13], [d12, d22, d23], [d13, d23, d33]])


def gravity_torque(base, q2, q3):
    """dV/dq for n postures, 3 x n [Nm]."""
    p = dict(zip(NAMES, base))
    fore = p["mx3r"] * np.cos(q2 + q3) - p["my3r"] * np.sin(q2 + q3)
    arm = p["mx2r"] * np.cos(q2) - p["my2r"] * np.sin(q2)
    return GRAVITY * np.array([0 * q2, arm + fore, fore])


def inverse_dynamics(base, q, qd, qdd):
    """Torques D qdd + c + h along n rows of motion; all arrays n x 3."""
    step = 1e-30
    q2, q3 = q[:, 1], q[:, 2]
    d = mass_matrix(base, q2, q3)
    by_q2 = mass_matrix(base, q2 + 1j * step, q3 + 0j).imag / step
    by_q3 = mass_matrix(base, q2 + 0j, q3 + 1j * step).imag / step
    rate = by_q2 * qd[:, 1] + by_q3 * qd[:, 2]
    torque = np.einsum("ijn,nj->ni", d, qdd) + np.einsum("ijn,nj->ni", rate, qd)
    for joint, slope in ((1, by_q2), (2, by_q3)):
        torque[:, joint] -= 0.5 * np.einsum("ni,ijn,nj->n", qd, slope, qd)
    return torque + gravity_torque(base, q2, q3).T


def regressor(q, qd, qdd):
    """n x 3 x 16: what each base parameter of one adds to the torques [Nm]."""
    columns = [inverse_dynamics(unit, q, qd, qdd) for unit in np.eye(16)]
    return np.stack(columns, axis=2)
