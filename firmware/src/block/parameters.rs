//! The values of a parameter block.

use model::Robot;
use serde::{Deserialize, Serialize};

use super::safety_limits::SafetyLimits;
use crate::compensation::{Compensations, ExternalLoad};
use crate::mode::Mode;
use crate::reference::Reference;

/// Model, gains, limits and reference of a run.
///
/// ```
/// use firmware::block::{MAX_BYTES, ParameterBlock};
/// use firmware::reference::Reference;
/// use firmware::{Gains, Mode, store::safe_defaults};
///
/// let mut block = ParameterBlock {
///     mode: [Mode::PdModel; 3],
///     gains: [Gains { proportional_v_per_rad: 80.0, derivative_v_s_per_rad: 4.0 }; 3],
///     command_limit_v: 9.0,
///     reference: Reference::hold([0.0, -0.5, 0.5]), // [rad]
///     ..safe_defaults()
/// };
/// let mut buffer = [0; MAX_BYTES];
/// assert_eq!(ParameterBlock::decode(block.encode(&mut buffer).unwrap()), Ok(block.clone()));
///
/// block.command_limit_v = 11.0; // the converter ends at 10 V
/// assert_eq!(block.check().unwrap_err().name, "command_limit_V");
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterBlock {
    /// The model of the arm and its friction.
    pub robot: Robot<f32>,
    /// Encoder counts per turn of a joint.
    pub encoder_counts_per_turn: u32,
    /// Sample period [s].
    pub sample_period_s: f32,
    /// Feedback gains of each joint.
    pub gains: [Gains; 3],
    /// Bandwidth of each joint's velocity estimate [rad/s].
    pub velocity_bandwidth_rad_per_s: [f32; 3],
    /// Largest command [V], at most what the converter can put out.
    pub command_limit_v: f32,
    /// Which joints the rig has; the others are in open loop without a voltage, and nothing that
    /// their encoders say matters.
    pub in_use: [bool; 3],
    /// Control mode of each joint.
    pub mode: [Mode; 3],
    /// Reference motion and injected voltages.
    pub reference: Reference,
    /// Compensations of each joint.
    pub compensations: [Compensations; 3],
    /// Compensated load on the arm; `None` for none.
    pub external_load: Option<ExternalLoad>,
    /// Limits at which the supervisor ends a run.
    pub safety: SafetyLimits,
}

/// Gains of the PD feedback of one joint, eq. (17).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gains {
    /// Proportional gain k_p [V/rad].
    pub proportional_v_per_rad: f32,
    /// Derivative gain k_d [V s/rad].
    pub derivative_v_s_per_rad: f32,
}
