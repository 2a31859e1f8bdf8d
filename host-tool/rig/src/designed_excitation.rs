//! The excitation that campaigns play unless they are given another.

use std::f32::consts::FRAC_PI_2;

use firmware::reference::{FadeIn, FourierSeries, TERMS};

/// Designed by `rrr design-excitation` for the reference robot: J_k = 3.571, where the
/// paper got 8.06; a recording of it on the simulated robot has 3.61.
///
/// J_k depends on lengths, gravity and torque constants alone. No joint needs more than
/// 5.4 V of the reference robot, so that robots of its kind with other inertias play it
/// too. Peak velocities are at most 95 % of section 4.2's limits, for joints overshoot.
pub const DESIGNED_EXCITATION: [FourierSeries; 3] = [
    series(
        0.0,
        [-0.128585, -0.17738, -0.017732, -0.088679, -1.721738],
        [0.155537, 0.462478, -0.023443, -0.086657, -0.010037],
    ),
    series(
        -FRAC_PI_2,
        [-3.699219, 0.404988, 1.624886, -0.847983, 0.999141],
        [-1.854791, 0.478051, 0.261913, -0.825213, -0.131586],
    ),
    series(
        0.0,
        [4.239965, 0.150517, -2.025495, 0.296456, -0.784069],
        [-0.037016, 0.165523, -0.858515, 0.31774, 0.107218],
    ),
];

const fn series(
    centre_rad: f32,
    sine_rad: [f32; TERMS],
    cosine_rad: [f32; TERMS],
) -> FourierSeries {
    let fade_in = FadeIn { duration_s: 2.0 };
    FourierSeries { centre_rad, period_s: 10.0, sine_rad, cosine_rad, fade_in }
}
