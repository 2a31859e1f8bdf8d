//! The rig under diagnosis, as a robot of three joints.
//!
//! A rig of one joint becomes the third joint of an arm whose other joints are too heavy to
//! move, hanging down: eq. (5) of that arm is eq. (11). So one path serves both.

use model::base::COUNT;
use model::{HANGING_RAD, Robot};

use crate::criteria::Criteria;
use files::{FileError, RobotFile};
use recordings::Campaign;
use recordings::campaign::Known;
use rig::effects::{Catalogue, Definition, EffectError, Table};

/// The joint of the arm that takes the place of the only joint of a rig.
const ONLY: usize = 2;
/// Inertia of joints that do not move [kg m^2].
const IMMOVABLE_KG_M2: f64 = 1e6;

/// What is diagnosed.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The model as given.
    pub robot: Robot<f64>,
    /// The effects that are tried.
    pub catalogue: Catalogue,
    /// Effects that the model as given holds already.
    pub known_effects: Vec<(&'static Definition, u8, Vec<f64>)>,
    /// Tables that the model as given holds already.
    pub known_tables: Vec<Table>,
    /// Joints of the rig, 0 to 2, as the arm counts them.
    pub joints: Vec<usize>,
    /// Number, 1 to 3, of each of these in files.
    pub numbers: Vec<u8>,
    /// Whether the rig has but one joint.
    pub one_joint: bool,
    /// What the manufacturer tells.
    pub known: Known,
    /// Whether the model tells the stiffness of its bristles.
    pub bristles_known: bool,
    /// The thresholds by which it is diagnosed.
    pub criteria: Criteria,
}

impl Subject {
    /// Inertia of a joint (0 to 2) with the arm stretched, motor included.
    pub fn inertia_kg_m2(&self, joint: usize) -> f64 {
        let stretched = model::Posture::new(0.0, 0.0);
        stretched.mass_matrix(&self.robot.base, &self.robot.geometry)[joint][joint]
    }

    /// The most that a motor accelerates the joint of this number in files [rad/s^2], the arm stretched.
    pub fn fastest_rad_per_s2(&self, number: u8) -> f64 {
        let place = self.numbers.iter().position(|&own| own == number);
        let of_joint = |place: usize| {
            let joint = self.joints[place];
            let k_t = self.robot.torque_constant_nm_per_v[joint];
            k_t * self.known.command_limit_v / self.inertia_kg_m2(joint)
        };
        place.map_or(0.0, of_joint)
    }

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
        let joints = if one_joint { vec![ONLY] } else { vec![0, 1, 2] };
        let mut subject = Self {
            robot,
            catalogue: catalogue.clone(),
            known_effects: Vec::new(),
            known_tables: Vec::new(),
            joints,
            one_joint,
            known: campaign.known.clone(),
            bristles_known: !one_joint
                || file.friction_table(numbers[0])?.sigma0_v_per_rad.is_some(),
            numbers,
            criteria: criteria.clone(),
        };
        for table in &file.effects {
            if Table::is_in(table) {
                let known = Table::of(table)?;
                let joint = subject.inner_joint(known.joint);
                subject.known_tables.push(Table { joint, ..known });
                continue;
            }
            let (definition, values) = catalogue.definition_and_values(table)?;
            let joint = subject.inner_joint(table.joint);
            definition.with(joint, &values)?;
            subject.known_effects.push((definition, joint, values));
        }
        Ok(subject)
    }

    /// The number in files of a joint as effects here count it (1 to 3, 0 for the whole robot).
    pub fn outer_joint(&self, inner: u8) -> u8 {
        if self.one_joint && inner > 0 { self.numbers[0] } else { inner }
    }

    /// A joint of files as effects here count it.
    pub fn inner_joint(&self, outer: u8) -> u8 {
        if self.one_joint && outer > 0 { ONLY as u8 + 1 } else { outer }
    }

    /// The model file with a refitted robot in it.
    pub fn refitted_file(&self, file: &RobotFile, robot: &Robot<f64>) -> RobotFile {
        if !self.one_joint {
            return file.clone().with_model(robot.base, &robot.friction);
        }
        let mut file = file.clone();
        let friction = &robot.friction[ONLY];
        if let Some(table) = &mut file.pendulum {
            table.inertia_kg_m2 = Some(robot.base.zz3r);
            table.gravity_torque_nm = Some(robot.base.mx3r * robot.geometry.gravity_m_s2);
        }
        for table in file.friction.iter_mut().filter(|table| table.joint == self.numbers[0]) {
            table.alpha0_v = friction.alpha0_v;
            table.alpha1_v = friction.alpha1_v;
            table.stribeck_velocity_rad_per_s = friction.stribeck_velocity_rad_per_s;
            table.alpha2_v_s_per_rad = friction.alpha2_v_s_per_rad;
            let bristles = table.sigma0_v_per_rad.is_some();
            table.sigma0_v_per_rad = bristles.then_some(friction.sigma0_v_per_rad);
            table.sigma1_v_s_per_rad =
                table.sigma1_v_s_per_rad.map(|_| friction.sigma1_v_s_per_rad);
        }
        file
    }

    /// Where a joint stands that the rig does not have [rad].
    pub fn resting_rad(joint: usize) -> f64 {
        HANGING_RAD[joint]
    }

    /// Base parameters that the rig's motion can change.
    pub fn free_base(&self) -> Vec<usize> {
        if self.one_joint { vec![ZZ3R, MX3R] } else { (0..COUNT).collect() }
    }
}

/// Places of J and of l/g among the base parameters.
const ZZ3R: usize = 12;
const MX3R: usize = 13;

/// Why a rig cannot be diagnosed.
#[derive(Debug, thiserror::Error)]
pub enum SubjectError {
    /// The model file lacks something.
    #[error(transparent)]
    File(Box<FileError>),
    /// An `[[effect]]` of the model is none.
    #[error("the model's [[effect]]: {0}")]
    Effect(#[from] EffectError),
}

impl From<FileError> for SubjectError {
    fn from(error: FileError) -> Self {
        Self::File(Box::new(error))
    }
}
