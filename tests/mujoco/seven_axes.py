"""A case of seven geared axes, like a well known arm for research, with the engine's friction."""

import numpy as np
from geared_arm import QUARTER, GearedArm, write_as_asked

TURNS_ABOUT_X = [0, -QUARTER, QUARTER, QUARTER, -QUARTER, QUARTER, QUARTER]

ARM = GearedArm(
    name="seven axes",
    origins_m=[
        (0, 0, 0.333), (0, 0, 0), (0, -0.316, 0), (0.0825, 0, 0), (-0.0825, 0.384, 0), (0, 0, 0),
        (0.088, 0, 0),
    ],  # fmt: skip
    turns_rad=[(turn, 0, 0) for turn in TURNS_ABOUT_X],
    axes=[(0, 0, 1)] * 7,
    masses_kg=[4.97, 2.4, 3.23, 3.59, 1.8, 1.67, 0.74],
    centres_m=[
        (0.004, 0.002, -0.05), (-0.003, -0.028, 0.0035), (0.0275, 0.039, -0.066),
        (-0.053, 0.104, 0.027), (-0.012, 0.041, -0.038), (0.06, -0.014, -0.01),
        (0.01, -0.004, 0.061),
    ],  # fmt: skip
    inertias_kg_m2=[
        (0.05, 0.05, 0.01), (0.012, 0.012, 0.012), (0.02, 0.02, 0.01), (0.025, 0.02, 0.028),
        (0.02, 0.018, 0.006), (0.005, 0.006, 0.007), (0.004, 0.004, 0.003),
    ],  # fmt: skip
    rotors_kg_m2=[0.35, 0.35, 0.3, 0.3, 0.15, 0.12, 0.08],
    coulomb_nm=np.array([0.6, 0.8, 0.5, 0.7, 0.4, 0.3, 0.3]),
    viscous_nm_s=np.array([1.2, 1.3, 0.9, 1.0, 0.5, 0.5, 0.35]),
    nm_per_a=np.full(7, 10.0),
    counts_per_rev=2**19,
    home_rad=np.array([0, -0.4, 0, -1.9, 0, 1.7, 0.4]),
    reach_rad=np.array([0.9, 0.5, 0.8, 0.5, 0.9, 0.7, 0.9]),
    stiffness=np.array([600, 600, 500, 500, 250, 150, 60.0]),
    damping=np.array([40, 40, 35, 35, 15, 10, 4.0]),
    period_s=1e-3,
    payload_at_m=(0, 0, 0.2),
)

if __name__ == "__main__":
    write_as_asked(ARM, __doc__)
