//! What the identification of an arm found.

use files::ArmFile;
use serde::Serialize;

use super::base::BaseParameter;
use super::judge::LogLeft;
use super::motion::CommandTime;

/// The model, and how good it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IdentifiedArm {
    /// The robot file with what was found; not part of the summary.
    #[serde(skip)]
    pub model: ArmFile,
    /// When commands act, as the logs with role `train` say.
    pub command_time: CommandTime,
    /// What is left on the logs held out; on those fitted to where there are none.
    pub left: Vec<LogLeft>,
    /// Whether `left` is of logs held out.
    pub is_held_out: bool,
    /// Condition number of the base parameters and friction, columns scaled to one; none where
    /// the logs alone leave some open.
    pub condition_number: Option<f64>,
    /// The combinations of link parameters that count.
    pub base: Vec<BaseParameter>,
    /// What commands have beyond Coulomb's level and viscous friction, per joint.
    pub friction_terms: Vec<FoundTerms>,
    /// The band of each log fitted to.
    pub bands: Vec<LogBand>,
    /// What the user should know.
    pub remarks: Vec<String>,
}

/// A number of a joint with its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Its value.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// What a joint's command has beyond Coulomb's level and viscous friction, where the logs show it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct FoundTerms {
    /// alpha1 of eq. (10) [unit of the command].
    pub stribeck_peak: Option<Estimate>,
    /// Its width, the best of those tried [rad/s; m/s].
    pub stribeck_velocity: Option<f64>,
    /// Growth with the joint's load [unit of the command by Nm; by N], effect `load_friction`.
    pub load_friction: Option<Estimate>,
    /// Growth with the square of the velocity, effect `quadratic_drag`; negative where friction grows less than with
    /// the velocity.
    pub quadratic_drag: Option<Estimate>,
    /// A constant, which the model does not hold [unit of the command].
    pub constant: Option<Estimate>,
}

/// The band in which a log was judged.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogBand {
    /// File name.
    pub file: String,
    /// Cut-off of what was compared [Hz].
    pub cutoff_hz: f64,
}
