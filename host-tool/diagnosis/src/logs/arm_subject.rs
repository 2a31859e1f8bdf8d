//! An arm of any kind as the subject of a diagnosis.

use std::collections::BTreeMap;

use files::{ArmFile, ArmJoint};
use model::Friction;
use model::friction_parameters::COUNT;
use recordings::Trace;
use recordings::campaign::Known;
use rig::Plant;
use rig::effects::Catalogue;
use rig::plant::{Body, Gear, JointUnits, PlantError, torque_constants};
use signal::{derivative, rms};

use super::arm_friction::{Shown, friction, told};
use super::arm_prior::linked;
use super::encoder_step;
use super::subject::{Subject, SubjectError};
use crate::criteria::Criteria;

/// Root mean square of the commands that [`crate::criteria::PriorCriteria::table_v`] is meant for.
const USUAL_RMS_V: f64 = 2.0;

impl Subject {
    /// An arm and the effects that are tried on it; the logs tell what the model does not.
    ///
    /// # Errors
    /// A link or a torque constant is not known, a drive is a position servo, or the model holds an
    /// effect that is none.
    pub fn of_arm(
        arm: &ArmFile,
        traces: &[Trace],
        catalogue: &Catalogue,
        criteria: &Criteria,
    ) -> Result<Self, SubjectError> {
        let joints = OfJoints::of(arm, traces, criteria);
        let torque_constant_nm_per_v = torque_constants(arm)?;
        let chain = arm.chain().map_err(PlantError::from)?;
        let (body, link_spread) = linked(arm, chain, criteria.prior.relative);
        let base_names = body.directions().names.clone();
        let (body, friction) = (Body::Chain(Box::new(body)), joints.friction);
        let gears = arm.joints.iter().map(Gear::of).collect();
        let plant = Plant { body, torque_constant_nm_per_v, friction, gears };
        let numbers: Vec<u8> = (1..=arm.joints.len() as u8).collect();
        let mut subject = Self {
            catalogue: catalogue.clone(),
            known_effects: Vec::new(),
            given_effects: 0,
            suspected: Vec::new(),
            found_constants: BTreeMap::new(),
            known_tables: Vec::new(),
            joints: (0..arm.joints.len()).collect(),
            one_joint: false,
            gears_lose: false,
            warms: false,
            known: known(arm, &plant, &numbers),
            encoder_step_rad: encoder_steps(arm, traces, criteria),
            command_limits_v: joints.command_limits_v,
            table_deviations_v: joints.table_deviations_v,
            units: arm.joints.iter().map(JointUnits::of).collect(),
            base_prior: link_spread.deviations().into_iter().enumerate().collect(),
            base_names,
            link_spread,
            friction_told: arm.joints.iter().map(told).collect(),
            friction_deviations: joints.friction_deviations,
            friction_names: arm.joints.iter().map(ArmJoint::friction_names).collect(),
            plant,
            numbers,
            criteria: criteria.clone(),
        };
        subject.take_effects(&arm.effects)?;
        Ok(subject)
    }
}

/// What a subject holds joint by joint.
struct OfJoints {
    friction: Vec<Friction<f64>>,
    friction_deviations: Vec<[Option<f64>; COUNT]>,
    command_limits_v: Vec<f64>,
    table_deviations_v: Vec<f64>,
}

impl OfJoints {
    fn of(arm: &ArmFile, traces: &[Trace], criteria: &Criteria) -> Self {
        let shown: Vec<Shown> =
            (1..=arm.joints.len()).map(|number| shown(traces, number as u8)).collect();
        let frictions = arm.joints.iter().zip(&shown).map(|(joint, shown)| friction(joint, *shown));
        let (friction, friction_deviations) = frictions.unzip();
        let limit = |joint: &ArmJoint| joint.drive.as_ref().and_then(|drive| drive.limit);
        let table = |shown: &Shown| criteria.prior.table_v * shown.command / USUAL_RMS_V;
        Self {
            friction,
            friction_deviations,
            command_limits_v: arm
                .joints
                .iter()
                .map(|j| limit(j).unwrap_or(f64::INFINITY))
                .collect(),
            table_deviations_v: shown.iter().map(table).collect(),
        }
    }
}

/// What is known of all joints alike: limits and steps are each joint's own.
fn known(arm: &ArmFile, plant: &Plant, numbers: &[u8]) -> Known {
    let gravity_m_s2 = arm.gravity_m_s2.iter().map(|g| g * g).sum::<f64>().sqrt();
    Known {
        geometry: None,
        gravity_m_s2,
        torque_constant_nm_per_v: plant.torque_constant_nm_per_v.clone(),
        joints: numbers.to_vec(),
        encoder_step_rad: 0.0,
        command_limit_v: f64::INFINITY,
        command_step_v: 0.0,
    }
}

/// Encoder steps as the file tells them, or as the logs show them.
fn encoder_steps(arm: &ArmFile, traces: &[Trace], criteria: &Criteria) -> Vec<f64> {
    let of_joint = |(number, joint): (u8, &ArmJoint)| {
        let shown = || encoder_step::smallest(traces, &[number], &criteria.logs);
        joint.count_step().map(f64::abs).or_else(shown).unwrap_or(0.0)
    };
    (1..).zip(&arm.joints).map(of_joint).collect()
}

/// Command and speed of a joint in the logs.
fn shown(traces: &[Trace], number: u8) -> Shown {
    let mut all = Shown { command: 0.0, speed: 0.0 };
    for trace in traces {
        let Some(joint) = trace.joint(number) else { continue };
        all.command = all.command.max(rms(&joint.command_v));
        all.speed = all.speed.max(rms(&derivative::first(&joint.q_rad, trace.period_s)));
    }
    all
}
