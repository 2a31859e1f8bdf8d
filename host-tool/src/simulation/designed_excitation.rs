//! The excitation that campaigns play unless they are given another.

use std::f32::consts::FRAC_PI_2;

use firmware::reference::{FadeIn, FourierSeries, TERMS};

/// Designed by `rrr design-excitation` for the reference robot: J_k = 3.608, where the
/// paper got 8.06; a recording of it on the simulated robot has 3.66.
///
/// J_k depends on lengths, gravity and torque constants alone. No joint needs more than
/// 4.7 V of the reference robot, so that robots of its kind with other inertias play it
/// too. Peak velocities are at most 95 % of section 4.2's limits, for joints overshoot.
pub const DESIGNED_EXCITATION: [FourierSeries; 3] = [
    series(
        0.0,
        [0.317113, -0.109369, -0.253831, -0.008779, 1.673400],
        [-0.810901, -0.133397, -0.224041, -0.084590, 0.025974],
    ),
    series(
        -FRAC_PI_2,
        [1.929130, 3.048870, 0.747358, -1.238954, -0.416322],
        [-1.501580, -0.130865, -0.727166, 0.271805, 0.444396],
    ),
    series(
        0.0,
        [-3.388651, -3.172779, -1.074456, 0.810223, 0.194676],
        [-0.777439, 0.770581, -0.097918, 0.345443, 0.035876],
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
