//! The model file that a diagnosis judges and amends: that of the three-joint robot or of any arm.

use std::path::Path;

use files::{ArmFile, ArmJoint, EffectTable, FileError, Problem, RobotFile};
use model::chain::BODY_PARAMETERS;
use model::friction_parameters::COUNT as FRICTION_COUNT;
use rig::Plant;

use crate::logs::subject::{ONLY, Subject};
use crate::trial::hypothesis::Hypothesis;

/// A model file of format 1 or 2.
#[derive(Clone, Debug, PartialEq)]
pub enum ModelFile {
    /// The three-joint robot, or a rig of one joint.
    Robot(Box<RobotFile>),
    /// An arm of any kind.
    Arm(Box<ArmFile>),
}

impl ModelFile {
    /// Writes it, whole or not at all.
    ///
    /// # Errors
    /// The path cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        match self {
            Self::Robot(file) => file.write(path),
            Self::Arm(file) => file.write(path),
        }
    }

    /// Reads a file of either format.
    ///
    /// # Errors
    /// Names the file and line, what is wrong, and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        match ArmFile::is_at(&path) {
            true => Ok(Self::Arm(Box::new(ArmFile::read(path)?))),
            false => Ok(Self::Robot(Box::new(RobotFile::read(path)?))),
        }
    }

    /// The same of a text; the path is for messages.
    ///
    /// # Errors
    /// As of [`ModelFile::read`].
    pub fn parse(path: impl AsRef<Path>, text: String) -> Result<Self, FileError> {
        match ArmFile::is_in(&text) {
            true => Ok(Self::Arm(Box::new(ArmFile::parse(path, text.into_bytes())?))),
            false => Ok(Self::Robot(Box::new(RobotFile::parse(path, text.into_bytes())?))),
        }
    }

    /// Its text.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_toml(&self) -> Result<String, Problem> {
        match self {
            Self::Robot(file) => file.to_toml(),
            Self::Arm(file) => file.to_toml(),
        }
    }

    /// The effects that it holds.
    pub fn effects(&self) -> &[EffectTable] {
        match self {
            Self::Robot(file) => &file.effects,
            Self::Arm(file) => &file.effects,
        }
    }

    /// The three-joint robot's, if it is that.
    pub fn as_robot(&self) -> Option<&RobotFile> {
        match self {
            Self::Robot(file) => Some(file),
            Self::Arm(_) => None,
        }
    }

    /// The arm's, if it is that of an arm of any kind.
    pub fn as_arm(&self) -> Option<&ArmFile> {
        match self {
            Self::Robot(_) => None,
            Self::Arm(file) => Some(file),
        }
    }

    /// Puts effects in place of those that it holds.
    pub fn set_effects(&mut self, effects: Vec<EffectTable>) {
        match self {
            Self::Robot(file) => file.effects = effects,
            Self::Arm(file) => file.effects = effects,
        }
    }

    /// The same with a refitted plant in it.
    pub fn refitted(&self, subject: &Subject, found: &Hypothesis) -> Self {
        match self {
            Self::Robot(file) => Self::Robot(Box::new(refitted_robot(subject, file, &found.plant))),
            Self::Arm(file) => Self::Arm(Box::new(refitted_arm(subject, file, &found.plant))),
        }
    }
}

fn refitted_robot(subject: &Subject, file: &RobotFile, plant: &Plant) -> RobotFile {
    let Some(robot) = plant.as_robot() else { return file.clone() };
    if !subject.one_joint {
        return file.clone().with_model(robot.base, &robot.friction);
    }
    let mut file = file.clone();
    let friction = &robot.friction[ONLY];
    if let Some(table) = &mut file.pendulum {
        table.inertia_kg_m2 = Some(robot.base.zz3r);
        table.gravity_torque_nm = Some(robot.base.mx3r * robot.geometry.gravity_m_s2);
    }
    for table in file.friction.iter_mut().filter(|table| table.joint == subject.numbers[0]) {
        table.alpha0_v = friction.alpha0_v;
        table.alpha1_v = friction.alpha1_v;
        table.stribeck_velocity_rad_per_s = friction.stribeck_velocity_rad_per_s;
        table.alpha2_v_s_per_rad = friction.alpha2_v_s_per_rad;
        let bristles = table.sigma0_v_per_rad.is_some();
        table.sigma0_v_per_rad = bristles.then_some(friction.sigma0_v_per_rad);
        table.sigma1_v_s_per_rad = table.sigma1_v_s_per_rad.map(|_| friction.sigma1_v_s_per_rad);
    }
    file
}

/// Links take the likeliest change that makes the base parameters what they were found to be.
fn refitted_arm(subject: &Subject, file: &ArmFile, plant: &Plant) -> ArmFile {
    let mut arm = file.clone();
    let found = |k: usize| plant.base(k) - subject.plant.base(k);
    let change: Vec<f64> = (0..plant.base_count()).map(found).collect();
    for (link, value, change) in subject.link_spread.likeliest(&change) {
        add_to_link(&mut arm.joints[link], value, change);
    }
    for (joint, friction) in arm.joints.iter_mut().zip(&plant.friction) {
        put_friction(joint, &friction.to_array());
    }
    arm
}

fn add_to_link(joint: &mut ArmJoint, value: usize, change: f64) {
    let link = &mut joint.link;
    match value {
        0 => link.mass_kg.iter_mut().for_each(|mass| *mass += change),
        1..=3 => link.com_m.iter_mut().for_each(|centre| centre[value - 1] += change),
        BODY_PARAMETERS => add_to_rotor(joint, change),
        _ => link.inertia_kg_m2.iter_mut().for_each(|inertia| inertia[value - 4] += change),
    }
}

fn add_to_rotor(joint: &mut ArmJoint, change: f64) {
    let is_there = joint.armature.is_some() || change != 0.0;
    joint.armature = is_there.then(|| (joint.armature.unwrap_or(0.0) + change).max(0.0));
}

/// Friction as it was found; bristles and the Stribeck velocity only where the file had them or needs
/// them.
fn put_friction(joint: &mut ArmJoint, values: &[f64; FRICTION_COUNT]) {
    let mut friction = joint.friction.unwrap_or_default();
    let [alpha0, alpha1, stribeck_velocity, alpha2, sigma0, sigma1] = *values;
    friction.alpha0 = Some(alpha0);
    friction.alpha1 = Some(alpha1);
    friction.stribeck_velocity = Some(stribeck_velocity);
    friction.alpha2 = Some(alpha2);
    friction.sigma0 = friction.sigma0.map(|_| sigma0);
    friction.sigma1 = friction.sigma1.map(|_| sigma1);
    joint.friction = Some(friction);
}
