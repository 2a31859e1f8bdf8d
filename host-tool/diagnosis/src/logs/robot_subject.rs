//! The three-joint robot, or a rig of one joint, as the subject of a diagnosis.
//!
//! A rig of one joint becomes the third joint of an arm whose other joints are too heavy to
//! move, hanging down: eq. (5) of that arm is eq. (11). So one path serves both.

use std::collections::BTreeMap;

use files::FileError;
use model::Robot;
use model::base::{COUNT, NAMES};
use model::friction_parameters::COUNT as FRICTION_COUNT;
use recordings::Campaign;
use rig::Plant;
use rig::effects::Catalogue;
use rig::plant::JointUnits;

use super::arm_prior::LinkSpread;
use super::base_prior;
use super::encoder_step;
use super::subject::{ONLY, Subject, SubjectError, friction_names_in_volts};
use crate::criteria::Criteria;

/// Inertia of joints that do not move [kg m^2].
const IMMOVABLE_KG_M2: f64 = 1e6;

/// Places of J and of l/g among the base parameters.
const ZZ3R: usize = 12;
const MX3R: usize = 13;

impl Subject {
    /// The rig of a campaign, and the effects that are tried on it.
    ///
    /// # Errors
    /// The model lacks a parameter, or holds an effect that is none.
    pub fn of(
        campaign: &Campaign,
        catalogue: &Catalogue,
        criteria: &Criteria,
    ) -> Result<Self, SubjectError> {
        let file = &campaign.robot_file;
        let one_joint = file.is_pendulum();
        let robot = if one_joint { file.as_third_joint(IMMOVABLE_KG_M2)? } else { file.robot()? };
        let numbers = campaign.known.joints.clone();
        let mut known = campaign.known.clone();
        let bristles_known = bristles_known(campaign, &numbers)?;
        if known.encoder_step_rad <= 0.0 {
            let smallest = encoder_step::smallest(&campaign.traces, &numbers, &criteria.logs);
            known.encoder_step_rad = smallest.unwrap_or(known.encoder_step_rad);
        }
        let mut subject = Self {
            catalogue: catalogue.clone(),
            known_effects: Vec::new(),
            given_effects: 0,
            suspected: Vec::new(),
            found_constants: BTreeMap::new(),
            known_tables: Vec::new(),
            joints: if one_joint { vec![ONLY] } else { vec![0, 1, 2] },
            one_joint,
            gears_lose: false,
            warms: false,
            encoder_step_rad: vec![known.encoder_step_rad; 3],
            command_limits_v: vec![known.command_limit_v; 3],
            known,
            table_deviations_v: vec![criteria.prior.table_v; 3],
            units: vec![JointUnits::VOLTS; 3],
            base_prior: base_deviations(&robot, one_joint, criteria),
            link_spread: LinkSpread::default(),
            base_names: base_names(one_joint),
            friction_told: vec![[true, true, true, true, bristles_known, bristles_known]; 3],
            friction_deviations: vec![[None; FRICTION_COUNT]; 3],
            friction_names: vec![friction_names_in_volts(); 3],
            plant: Plant::of_robot(&robot),
            numbers,
            criteria: criteria.clone(),
        };
        subject.take_effects(&file.effects)?;
        Ok(subject)
    }
}

fn bristles_known(campaign: &Campaign, numbers: &[u8]) -> Result<bool, FileError> {
    let file = &campaign.robot_file;
    Ok(!file.is_pendulum() || file.friction_table(numbers[0])?.sigma0_v_per_rad.is_some())
}

/// Base parameters that the rig's motion can change.
fn base_deviations(robot: &Robot<f64>, one_joint: bool, criteria: &Criteria) -> Vec<(usize, f64)> {
    let deviations = base_prior::of_closed_form(&robot.base, &criteria.prior);
    let free = if one_joint { vec![ZZ3R, MX3R] } else { (0..COUNT).collect() };
    free.into_iter().map(|place| (place, deviations[place])).collect()
}

fn base_names(one_joint: bool) -> Vec<String> {
    let name = |place: usize| match (one_joint, place) {
        (true, ZZ3R) => "pendulum.inertia_kg_m2".into(),
        (true, _) => "pendulum.gravity_torque_Nm".into(),
        (false, _) => format!("base.{}", NAMES[place]),
    };
    (0..COUNT).map(name).collect()
}
