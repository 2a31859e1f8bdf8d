//! The rig under diagnosis: a plant, its logs' joints, and what is known of both.

use rig::Plant;
use rig::plant::{JointUnits, PlantError};
use std::collections::BTreeMap;

use crate::criteria::{Criteria, Doubt};
use crate::logs::arm_prior::LinkSpread;
use crate::logs::base_prior::of_closed_form;
use files::FileError;
use model::friction_parameters::{COUNT as FRICTION_COUNT, NAMES};
use recordings::campaign::Known;
use rig::effects::{Catalogue, Definition, EffectError, Table};

/// What is diagnosed.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The model as given.
    pub plant: Plant,
    /// The effects that are tried.
    pub catalogue: Catalogue,
    /// Effects that the model as given holds already, and then torque constants that are in doubt.
    pub known_effects: Vec<(&'static Definition, u8, Vec<f64>)>,
    /// How many of these the model as given holds.
    pub given_effects: usize,
    /// Effects that a search tries first.
    pub suspected: Vec<(&'static Definition, u8, Vec<f64>)>,
    /// The 95 % intervals of torque constants that were found, with all of them open, by joint (from 1).
    pub found_constants: BTreeMap<u8, [f64; 2]>,
    /// Tables that the model as given holds already.
    pub known_tables: Vec<Table>,
    /// Joints of the rig, from 0, as the plant counts them.
    pub joints: Vec<usize>,
    /// Number, from 1, of each of these in files.
    pub numbers: Vec<u8>,
    /// Whether the rig has but one joint that is the third of an arm here.
    pub one_joint: bool,
    /// Whether its gears take a part of their motors' torque that the model does not tell.
    pub gears_lose: bool,
    /// Whether friction differs from log to log, as joints warm.
    pub warms: bool,
    /// What the manufacturer tells of all joints alike.
    pub known: Known,
    /// Encoder step of every joint of the plant [rad; m].
    pub encoder_step_rad: Vec<f64>,
    /// Largest command of every joint of the plant.
    pub command_limits_v: Vec<f64>,
    /// Standard deviation of a table's values on every joint of the plant.
    pub table_deviations_v: Vec<f64>,
    /// Units of every joint of the plant.
    pub units: Vec<JointUnits>,
    /// Standard deviations of base parameters that the rig's motion can change, with their places.
    pub base_prior: Vec<(usize, f64)>,
    /// How the doubts of a chain's links make those of its base parameters.
    pub link_spread: LinkSpread,
    /// Names of the base parameters in the report.
    pub base_names: Vec<String>,
    /// Which of a joint's friction parameters the model tells.
    pub friction_told: Vec<[bool; FRICTION_COUNT]>,
    /// Standard deviations of friction's parameters where the model tells them, joint by joint.
    pub friction_deviations: Vec<[Option<f64>; FRICTION_COUNT]>,
    /// The names of these parameters in the model, joint by joint.
    pub friction_names: Vec<[String; FRICTION_COUNT]>,
    /// The thresholds by which it is diagnosed.
    pub criteria: Criteria,
}

/// Place of the bristles' stiffness among friction's parameters.
pub const STIFFNESS: usize = 4;

/// The joint of the arm that takes the place of the only joint of a rig.
pub const ONLY: usize = 2;

impl Subject {
    /// Inertia of a joint (from 0) with the arm stretched, motor included.
    pub fn inertia_kg_m2(&self, joint: usize) -> f64 {
        self.plant.body.inertia(joint, &vec![0.0; self.plant.joints()])
    }

    /// Whether the model tells the stiffness of a joint's (from 0) bristles.
    pub fn knows_bristles(&self, joint: usize) -> bool {
        self.friction_told[joint][STIFFNESS]
    }

    /// Whether its gears may take the same part of their motors' torque: those of one arm of three joints and more are of
    /// one kind, while a joint alone tells no loss from friction by its load. The three-joint robot has none.
    pub fn may_share_gear_loss(&self) -> bool {
        self.plant.as_chain().is_some() && self.joints.len() >= 3
    }

    /// The most that a motor accelerates the joint of this number in files [rad/s^2; m/s^2], the arm
    /// stretched: at its limit, or with twice the largest of its commands where it has none.
    pub fn fastest_rad_per_s2(&self, number: u8, largest_v: f64) -> f64 {
        let limit_v = self.command_limit_v(number);
        let most_v = if limit_v.is_finite() { limit_v } else { 2.0 * largest_v };
        let of_joint = |joint: usize| {
            self.plant.torque_constant_nm_per_v[joint] * most_v / self.inertia_kg_m2(joint)
        };
        self.place_of(number).map_or(0.0, of_joint)
    }

    /// The number in files of a joint as effects here count it (from 1, 0 for the whole robot).
    pub fn outer_joint(&self, inner: u8) -> u8 {
        if self.one_joint && inner > 0 { self.numbers[0] } else { inner }
    }

    /// A joint of files as effects here count it.
    pub fn inner_joint(&self, outer: u8) -> u8 {
        if self.one_joint && outer > 0 { ONLY as u8 + 1 } else { outer }
    }

    /// Where a joint stands that the rig does not have [rad].
    pub fn resting_rad(joint: usize) -> f64 {
        model::HANGING_RAD.get(joint).copied().unwrap_or(0.0)
    }

    /// Takes the parameters of the model for doubtful by so much.
    pub fn doubt(&mut self, doubt: Doubt) {
        self.criteria.prior.relative_friction = doubt.friction;
        let before = std::mem::replace(&mut self.criteria.prior.relative, doubt.masses);
        match self.plant.body.as_rrr() {
            Some(rrr) => {
                let deviations = of_closed_form(&rrr.base, &self.criteria.prior);
                for (place, deviation) in &mut self.base_prior {
                    *deviation = deviations[*place];
                }
            }
            None => {
                self.link_spread.widen(doubt.masses / before);
                self.base_prior = self.link_spread.deviations().into_iter().enumerate().collect();
            }
        }
    }

    /// Base parameters that the rig's motion can change, with their standard deviations.
    pub fn base_deviations(&self) -> Vec<(usize, f64)> {
        self.base_prior.clone()
    }

    /// Torque constants that are in doubt: effects of the model beside those of the file.
    pub fn in_doubt(&self) -> &[(&'static Definition, u8, Vec<f64>)] {
        self.known_effects.get(self.given_effects..).unwrap_or_default()
    }

    /// A base parameter's name in the report.
    pub fn base_name(&self, place: usize) -> String {
        self.base_names[place].clone()
    }

    /// The name of a joint's friction parameter in the model.
    pub fn friction_name(&self, joint: usize, parameter: usize) -> &str {
        &self.friction_names[joint][parameter]
    }

    /// Largest command of a joint by its number in files.
    pub fn command_limit_v(&self, number: u8) -> f64 {
        self.place_of(number).map_or(f64::INFINITY, |place| self.command_limits_v[place])
    }

    /// Encoder step of a joint by its number in files [rad; m].
    pub fn encoder_step_rad(&self, number: u8) -> f64 {
        self.place_of(number).map_or(0.0, |place| self.encoder_step_rad[place])
    }

    /// Whether a joint slides, by its number in files.
    pub fn slides(&self, number: u8) -> bool {
        self.place_of(number).is_some_and(|place| self.units[place].slides)
    }

    /// The units of the rig's joints by their numbers.
    pub fn units_by_number(&self) -> BTreeMap<u8, JointUnits> {
        self.numbers.iter().zip(&self.joints).map(|(n, joint)| (*n, self.units[*joint])).collect()
    }

    /// A joint of files as the plant counts it.
    fn place_of(&self, number: u8) -> Option<usize> {
        let place = self.numbers.iter().position(|of| *of == number)?;
        Some(self.joints[place])
    }

    /// The experiment that shows an effect best: without the command that plays it where the board does not drive the arm.
    pub fn experiment(&self, definition: &Definition) -> &'static str {
        let words = definition.experiment;
        match self.plant.as_chain() {
            Some(_) => words.split_once(" (`").map_or(words, |(motion, _)| motion),
            None => words,
        }
    }

    /// Takes the effects that a model as given holds.
    pub(super) fn take_effects(
        &mut self,
        tables: &[files::EffectTable],
    ) -> Result<(), SubjectError> {
        let joints = self.catalogue.joints();
        for table in tables {
            if Table::is_in(table) {
                let known = Table::on_one_of(joints, table)?;
                let joint = self.inner_joint(known.joint);
                self.known_tables.push(Table { joint, ..known });
                continue;
            }
            let effect = self.effect_of(table)?;
            self.known_effects.push(effect);
        }
        self.given_effects = self.known_effects.len();
        Ok(())
    }

    /// Takes effects that a search tries first.
    pub(crate) fn suspect(&mut self, tables: &[files::EffectTable]) -> Result<(), SubjectError> {
        let effects = tables.iter().map(|table| self.effect_of(table));
        self.suspected = effects.collect::<Result<_, _>>().map_err(SubjectError::Suspected)?;
        Ok(())
    }

    /// An effect of a file, its joint as effects here count it.
    fn effect_of(
        &self,
        table: &files::EffectTable,
    ) -> Result<(&'static Definition, u8, Vec<f64>), EffectError> {
        let (definition, values) = self.catalogue.definition_and_values(table)?;
        let joint = self.inner_joint(table.joint);
        definition.on_one_of(self.catalogue.joints(), joint, &values)?;
        Ok((definition, joint, values))
    }
}

/// The names of friction's parameters in files of the three-joint robot.
pub fn friction_names_in_volts() -> [String; FRICTION_COUNT] {
    NAMES.map(str::to_owned)
}

/// Why a rig cannot be diagnosed.
#[derive(Debug, thiserror::Error)]
pub enum SubjectError {
    /// The model file lacks something.
    #[error(transparent)]
    File(Box<FileError>),
    /// An `[[effect]]` of the model is none.
    #[error("the model's [[effect]]: {0}")]
    Effect(#[from] EffectError),
    /// An effect that is suspected is none that the robot can have.
    #[error("an effect that is suspected: {0}")]
    Suspected(EffectError),
    /// The model of an arm describes none.
    #[error(transparent)]
    Plant(#[from] PlantError),
}

impl From<FileError> for SubjectError {
    fn from(error: FileError) -> Self {
        Self::File(Box::new(error))
    }
}
