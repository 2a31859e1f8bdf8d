//! The rigid body of a model file.

use std::path::Path;

use files::{ArmFile, EffectTable, FileError, RobotFile};
use model::Pendulum;
use model::mechanism::{Mechanism, Rrr};

use super::friction::{self, SteadyFriction};
use super::joint::JointColumns;

/// A rigid body, and the columns of its joints.
pub struct Body {
    rigid: Rigid,
    /// The joints, in order.
    pub joints: Vec<JointColumns>,
}

enum Rigid {
    Mechanism(Box<dyn Mechanism<f64>>),
    Pendulum(Pendulum<f64>),
}

impl Body {
    /// The body of a model file of any format; says what is left out of it.
    ///
    /// # Errors
    /// A file that cannot be read, or lacks a value.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let (mut body, effects) = if ArmFile::is_at(path) {
            let file = ArmFile::read(path)?;
            (Self::of_arm(&file)?, file.effects)
        } else {
            let file = RobotFile::read(path)?;
            (Self::of_robot(&file)?, file.effects)
        };
        let mut is_left =
            |effect: &&EffectTable| !body.joints.iter_mut().any(|joint| joint.add(effect));
        let left: Vec<&str> =
            effects.iter().filter(|e| is_left(e)).map(|effect| effect.effect.as_str()).collect();
        if !left.is_empty() {
            eprintln!(
                "note: effects of the model are left out ({}): inverse dynamics is rigid body and friction only",
                left.join(", ")
            );
        }
        Ok(body)
    }

    /// The body of an arm of any kind.
    ///
    /// # Errors
    /// A link of which too little is known.
    pub fn of_arm(file: &ArmFile) -> Result<Self, FileError> {
        for remark in file.remarks() {
            eprintln!("warning: {remark}");
        }
        let joints = (1..).zip(&file.joints).map(|(number, j)| JointColumns::of(number, j));
        Ok(Self { joints: joints.collect(), rigid: Rigid::Mechanism(Box::new(file.chain()?)) })
    }

    /// The body of the three-joint robot, or of a rig of one joint.
    ///
    /// # Errors
    /// A value that is missing.
    pub fn of_robot(file: &RobotFile) -> Result<Self, FileError> {
        if file.is_pendulum() {
            let pendulum = file.pendulum()?;
            let constant = file.torque_constant(pendulum.joint)?;
            let friction = friction_of(file, pendulum.joint);
            let joints = vec![JointColumns::with_voltage(pendulum.joint, constant, friction)];
            return Ok(Self { rigid: Rigid::Pendulum(pendulum), joints });
        }
        let rrr = Rrr { base: file.base_parameters()?, geometry: file.geometry()? };
        if let Err(error) = rrr.base.check(&rrr.geometry) {
            // The torques are well defined all the same.
            eprintln!("warning: no rigid robot has these base parameters: {error}");
        }
        let constants = (1..).zip(file.torque_constants()?);
        let joints = constants
            .map(|(joint, k)| JointColumns::with_voltage(joint, k, friction_of(file, joint)))
            .collect();
        Ok(Self { rigid: Rigid::Mechanism(Box::new(rrr)), joints })
    }

    /// The number of the last joint.
    pub fn last_joint(&self) -> usize {
        match &self.rigid {
            Rigid::Mechanism(arm) => arm.joints(),
            // Columns of the other joints of an arm may stand beside those of the one.
            Rigid::Pendulum(_) => 3,
        }
    }

    /// The torques [Nm; N] of a motion, one entry per joint.
    pub fn torques(&self, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
        match &self.rigid {
            Rigid::Pendulum(pendulum) => vec![pendulum.inverse_dynamics(q[0], qdd[0])],
            Rigid::Mechanism(arm) => {
                let mut torques = vec![0.0; arm.joints()];
                arm.inverse_dynamics(q, qd, qdd, &mut torques);
                torques
            }
        }
    }
}

fn friction_of(file: &RobotFile, joint: u8) -> Option<SteadyFriction> {
    file.friction_table(joint).ok().map(|table| SteadyFriction::of(friction::of_table(table)))
}
