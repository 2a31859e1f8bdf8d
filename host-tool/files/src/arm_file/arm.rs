//! What a robot or model file of format 2 says.

use super::joint::ArmJoint;
use crate::robot_file::EffectTable;
use crate::toml_source::TomlSource;

/// The table of [`BaseError`].
pub(super) const BASE: &str = "base_parameter";

/// A serial chain of revolute and prismatic joints with its drives: what is known of it.
///
/// ```
/// use files::ArmFile;
///
/// let text = "format = 2
/// [robot]
/// gravity_m_s2 = [0.0, 0.0, -9.81]
/// [[joint]]
/// kind = \"prismatic\"
/// axis = [0.0, 0.0, 1.0]
/// mass_kg = 2.0
/// com_m = [0.0, 0.0, 0.0]
/// inertia_kg_m2 = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
/// ";
/// let arm = ArmFile::parse("lift.toml", text.into())?;
/// assert_eq!(arm.chain()?.joints().count(), 1);
/// # Ok::<(), files::FileError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmFile {
    /// The robot's name.
    pub name: Option<String>,
    /// Gravity in the base frame [m/s^2].
    pub gravity_m_s2: [f64; 3],
    /// Nominal distance of samples [s].
    pub sample_period_s: Option<f64>,
    /// The joints, base to tip.
    pub joints: Vec<ArmJoint>,
    /// Effects that the model carries beyond rigid body and friction, in order.
    pub effects: Vec<EffectTable>,
    /// How well the sums of link parameters that torques depend on are known, where that is told.
    pub base_errors: Vec<BaseError>,
    /// Where the values came from, for messages.
    pub(super) source: TomlSource,
}

/// How well a base parameter is known: links' values that the logs do not tell apart may each be uncertain, and their
/// sum is not.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct BaseError {
    /// The sum, as `joint[2].mx_kg_m + 0.2 joint[3].mass_kg`.
    pub name: String,
    /// Its standard error, in its unit.
    pub standard_error: f64,
}
