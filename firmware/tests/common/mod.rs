//! A block that the tests begin from.
#[allow(dead_code)]
pub mod played;
#[allow(dead_code)]
pub mod supervised;

use firmware::compensation::{Compensations, Feedforward, InputInverse};
use firmware::reference::{FadeIn, Injection, Motion, Reference, Sine};
use firmware::{Gains, Mode, ParameterBlock};
use model::reference_robot::reference_robot;

/// The reference robot on the motion (20)-(21).
pub fn block(mode: Mode) -> ParameterBlock {
    let sine = |centre_rad| {
        Motion::Sine(Sine {
            centre_rad,
            amplitude_rad: 1.57,
            period_s: 5.0,
            fade_in: FadeIn { duration_s: 1.0 },
        })
    };
    ParameterBlock {
        robot: reference_robot(),
        encoder_counts_per_turn: 655_360,
        sample_period_s: 1e-3,
        gains: [Gains { proportional_v_per_rad: 80.0, derivative_v_s_per_rad: 4.0 }; 3],
        velocity_bandwidth_rad_per_s: [300.0; 3],
        command_limit_v: 9.0,
        in_use: [true; 3],
        mode: [mode; 3],
        reference: Reference {
            motion: [sine(1.57), sine(-1.57), sine(0.0)],
            injection: [Injection::None; 3],
            duration_s: 10.0,
        },
        compensations: Default::default(),
        external_load: Default::default(),
        safety: Default::default(),
    }
}

/// The compensations of a joint.
#[allow(dead_code)]
pub fn joint(feedforward: &[Feedforward], input_inverses: &[InputInverse]) -> Compensations {
    Compensations {
        feedforward: feedforward.iter().copied().collect(),
        input_inverses: input_inverses.iter().copied().collect(),
        tables: Default::default(),
    }
}
