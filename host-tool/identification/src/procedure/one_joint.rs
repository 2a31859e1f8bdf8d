//! The procedure on a rig of one joint, eq. (11).

use model::Pendulum;

use crate::one_joint::pendulum::{self, OneJoint};
use crate::static_friction::{self, StaticFriction};
use files::{Experiment, FrictionTable, RobotFile, Role};
use recordings::{Campaign, StepError, Trace, plausibility};

/// The result on a rig of one joint.
#[derive(Clone, Debug)]
pub struct OneJointIdentified {
    /// Inertia, gravity and sliding friction from motion.
    pub motion: OneJoint,
    /// Friction from a run at constant velocities, where there is one.
    pub statics: Option<StaticFriction>,
    /// Remarks, and what could not be done.
    pub missing: Vec<String>,
}

/// Identifies the joint from all `train` logs, and from its run at constant velocities.
///
/// # Errors
/// No log in which the joint moves by its own command.
pub fn identify_one_joint(
    campaign: &Campaign,
    progress: &dyn Fn(&str),
) -> Result<OneJointIdentified, StepError> {
    let known = &campaign.known;
    let joint = known.joints[0];
    progress("examining the logs");
    let mut missing = Vec::new();
    for trace in &campaign.traces {
        missing.extend(plausibility::examine(trace, known)?);
    }
    let train: Vec<&Trace> =
        campaign.traces.iter().filter(|trace| trace.role == Role::Train).collect();
    progress("inertia, gravity and friction");
    let motion = pendulum::identify(&train, joint, known)?;
    missing.extend(motion.left_out.iter().map(|(file, why)| format!("{file}: {why}")));
    let run = train.iter().find(|trace| trace.experiment == Experiment::ConstantVelocity);
    let statics = run.and_then(|trace| {
        let found = static_friction::identify(trace, joint, known);
        found.map_err(|error| missing.push(error.to_string())).ok()
    });
    Ok(OneJointIdentified { motion, statics, missing })
}

impl OneJointIdentified {
    /// The robot file with what was identified; sigma0 and sigma1 stay out where only
    /// sliding was seen.
    pub fn model_file(&self, robot_file: &RobotFile) -> RobotFile {
        let pendulum = Pendulum {
            joint: self.motion.joint,
            inertia_kg_m2: self.motion.inertia_kg_m2.value,
            gravity_torque_nm: self.motion.gravity_torque_nm.value,
        };
        robot_file.clone().with_pendulum(&pendulum, self.friction_table())
    }

    fn friction_table(&self) -> FrictionTable {
        if let Some(statics) = &self.statics {
            return FrictionTable::of(self.motion.joint, &statics.friction.values());
        }
        FrictionTable {
            joint: self.motion.joint,
            alpha0_v: self.motion.alpha0_v.value,
            alpha1_v: 0.0,
            // Without alpha_1 it means nothing, but must be above zero.
            stribeck_velocity_rad_per_s: 0.003,
            alpha2_v_s_per_rad: self.motion.alpha2_v_s_per_rad.value.max(0.0),
            ..FrictionTable::default()
        }
    }
}
