//! `robot.toml` and `model.toml`: what is known of a rig.

use model::{BaseParameters, Friction, Pendulum, Robot};

use super::toml_source::TomlSource;

mod check;
mod convert;
mod keys;
mod one_joint;
mod ranges;
mod read;
mod tables;
mod write;

pub(super) use keys::EFFECT;
pub(super) use ranges::{LONGEST_LINK_M, SAMPLE_PERIOD_S, STRONGEST_GRAVITY_M_S2};
pub(super) use tables::whole_if_possible;
pub use tables::{EffectTable, FrictionTable, PendulumTable, RobotTable};

/// A robot or model file: a rig of three joints, or of the one joint of eq. (11).
///
/// A `robot.toml` has neither `base` nor friction; a `model.toml` has both. Notes and
/// standard errors are kept in `extra` and written back; other keys are refused.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotFile {
    /// The manufacturer's data.
    pub robot: RobotTable,
    /// Base parameters of a rig of three joints.
    pub base: Option<BaseParameters<f64>>,
    /// Keys of `[base]` beside the 16 parameters.
    pub base_extra: toml::Table,
    /// The rigid body of a rig of one joint.
    pub pendulum: Option<PendulumTable>,
    /// Friction, one per joint at most.
    pub friction: Vec<FrictionTable>,
    /// Effects that the model carries beyond rigid body and friction, in order.
    pub effects: Vec<EffectTable>,
    /// `[notes]` and the like.
    pub extra: toml::Table,
    /// Where the values came from, for messages.
    source: TomlSource,
}

impl RobotFile {
    /// A model file of three joints; sample period, limits and encoder are left open.
    pub fn from_robot(robot: &Robot<f64>) -> Self {
        let friction = (1..).zip(&robot.friction);
        Self {
            robot: RobotTable::of_robot(robot),
            base: Some(robot.base),
            friction: friction.map(|(joint, f)| FrictionTable::of(joint, f)).collect(),
            ..Self::default()
        }
    }

    /// The same file with an identified pendulum and its friction.
    pub fn with_pendulum(self, pendulum: &Pendulum<f64>, friction: FrictionTable) -> Self {
        let pendulum = PendulumTable {
            joint: pendulum.joint,
            inertia_kg_m2: Some(pendulum.inertia_kg_m2),
            gravity_torque_nm: Some(pendulum.gravity_torque_nm),
            extra: self.pendulum.map(|table| table.extra).unwrap_or_default(),
        };
        Self { pendulum: Some(pendulum), base: None, friction: vec![friction], ..self }
    }

    /// The same file with identified base parameters and the friction of all joints.
    pub fn with_model(self, base: BaseParameters<f64>, friction: &[Friction<f64>; 3]) -> Self {
        let friction = (1..).zip(friction).map(|(joint, f)| FrictionTable::of(joint, f)).collect();
        Self { base: Some(base), pendulum: None, friction, ..self }
    }

    /// Whether this is a rig of one joint.
    pub fn is_pendulum(&self) -> bool {
        self.pendulum.is_some() && self.base.is_none()
    }
}
