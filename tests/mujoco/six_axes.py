"""A case of six axes like a light industrial arm's, whose gears' friction is of nobody's formula.

Friction has a peak of a quarter of its level below 0.06 rad/s, grows by 6 % of the motor's torque,
is viscous by the power 0.85 of the velocity, falls by 1 % within a log as it warms, and ripples
with the motor's second harmonic; the model that the diagnosis is given knows Coulomb and viscous
friction.
"""

import numpy as np
from geared_arm import QUARTER, GearedArm, write_as_asked

GEAR_RATIO = 101
COULOMB_NM = np.array([9.0, 10.0, 7.0, 2.4, 2.2, 1.8])
VISCOUS_NM_S = np.array([11.0, 12.0, 9.0, 2.6, 2.2, 1.8])


def friction_nm(angle_rad, velocity_rad_s, motor_nm, second):
    """Friction of the joints."""
    speed, sign = np.abs(velocity_rad_s), np.tanh(velocity_rad_s / 0.008)
    warm = 1 - 0.1 * min(1.0, second / 200)
    dry = COULOMB_NM * (1 + 0.25 * np.exp(-speed / 0.06)) * warm + 0.06 * np.abs(motor_nm)
    viscous = warm * VISCOUS_NM_S * np.sign(velocity_rad_s) * speed**0.85
    return sign * dry + viscous + 0.02 * COULOMB_NM * np.sin(2 * GEAR_RATIO * angle_rad)


ARM = GearedArm(
    name="six axes",
    origins_m=[
        (0, 0, 0.0892), (0, 0.1358, 0), (0, -0.1197, 0.425), (0, 0, 0.3922), (0, 0.093, 0),
        (0, 0, 0.0946),
    ],  # fmt: skip
    turns_rad=[(0, 0, 0), (0, QUARTER, 0), (0, 0, 0), (0, QUARTER, 0), (0, 0, 0), (0, 0, 0)],
    axes=[(0, 0, 1), (0, 1, 0), (0, 1, 0), (0, 1, 0), (0, 0, 1), (0, 1, 0)],
    masses_kg=[3.7, 8.393, 2.275, 1.219, 1.219, 0.1879],
    centres_m=[
        (0, 0, 0.0), (0, 0, 0.28), (0, 0, 0.196), (0, 0.093, 0), (0, 0, 0.0946), (0, 0.0645, 0),
    ],  # fmt: skip
    inertias_kg_m2=[
        (0.0149, 0.0149, 0.0104), (0.1339, 0.1339, 0.0151), (0.0312, 0.0312, 0.0041),
        (0.0026, 0.0026, 0.0022), (0.0026, 0.0026, 0.0022), (0.0001, 0.0001, 0.00017),
    ],  # fmt: skip
    rotors_kg_m2=[1.2, 1.2, 0.9, 0.25, 0.25, 0.2],
    coulomb_nm=COULOMB_NM,
    viscous_nm_s=VISCOUS_NM_S,
    nm_per_a=np.array([12.5, 12.5, 12.0, 9.0, 9.0, 9.0]),
    counts_per_rev=2**17,
    home_rad=np.array([0, -1.2, 1.3, -1.2, -1.4, 0.0]),
    reach_rad=np.array([1.2, 0.6, 0.8, 0.9, 0.9, 1.2]),
    stiffness=np.array([4000, 4000, 3000, 800, 800, 600.0]),
    damping=np.array([300, 300, 200, 40, 40, 30.0]),
    period_s=2e-3,
    payload_at_m=(0, 0.12, 0.03),
    noise_a=0.01,
    friction=friction_nm,
    engine_step_s=2.5e-4,
)

if __name__ == "__main__":
    write_as_asked(ARM, __doc__)
