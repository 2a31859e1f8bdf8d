//! The parameters of a board that has none stored: no voltage.

use model::reference_robot::reference_robot;

use crate::Mode;
use crate::block::{Gains, ParameterBlock};
use crate::reference::{Injection, Motion, Reference};

/// Open loop without a voltage and gains of zero: every command is 0 V, started or not.
///
/// The numbers of the model stand there because a block must have some; in this mode
/// nothing is computed from them.
pub fn safe_defaults() -> ParameterBlock {
    ParameterBlock {
        robot: reference_robot(),
        encoder_counts_per_turn: 655_360,
        sample_period_s: 1e-3,
        gains: [Gains { proportional_v_per_rad: 0.0, derivative_v_s_per_rad: 0.0 }; 3],
        velocity_bandwidth_rad_per_s: [300.0; 3],
        command_limit_v: 0.1,
        in_use: [true; 3],
        mode: [Mode::OpenLoop; 3],
        reference: Reference {
            motion: [const { Motion::Hold { angle_rad: 0.0 } }; 3],
            injection: [Injection::None; 3],
            duration_s: 1.0,
        },
        compensations: Default::default(),
        external_load: None,
        safety: Default::default(),
    }
}
