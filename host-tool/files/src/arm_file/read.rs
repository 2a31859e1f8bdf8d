//! Arms of any kind from TOML.

use std::path::Path;

use model::chain::MAX_JOINTS;
use serde::Deserialize;

use super::arm::{ArmFile, BASE, BaseError};
use super::joint::ArmJoint;
use super::read_joint::read_joint;
use super::urdf;
use crate::bytes;
use crate::error::{FileError, Problem};
use crate::robot_file::{EFFECT, EffectTable, SAMPLE_PERIOD_S, STRONGEST_GRAVITY_M_S2};
use crate::section::Section;
use crate::toml_source::{ARM_FORMAT, TomlSource};

/// Gravity of a robot that stands upright, where the file does not say otherwise [m/s^2].
const UPRIGHT_M_S2: [f64; 3] = [0.0, 0.0, -9.81];

/// Effects are read as in format 1.
#[derive(Deserialize)]
struct Effects {
    #[serde(default)]
    effect: Vec<EffectTable>,
}

impl ArmFile {
    /// Whether a file holds an arm of any kind; a file that cannot be read does not.
    pub fn is_at(path: impl AsRef<Path>) -> bool {
        let text = bytes::read(path.as_ref()).ok().and_then(|bytes| String::from_utf8(bytes).ok());
        text.is_some_and(|text| Self::is_in(&text))
    }

    /// Whether a text is that of an arm of any kind.
    pub fn is_in(text: &str) -> bool {
        TomlSource::format_of(text) == Some(ARM_FORMAT)
    }

    /// Reads a file, and the URDF that it names.
    ///
    /// # Errors
    /// Names the file and line, what is wrong, and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Self::parse(path, bytes::read(path)?)
    }

    /// The same from a file's bytes; the path is for messages, and the URDF is looked for beside it.
    ///
    /// # Errors
    /// As of [`ArmFile::read`].
    pub fn parse(path: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let source = TomlSource::of_format(path, bytes, ARM_FORMAT)?;
        let arm = arm_of(path, &source)?;
        Ok(Self { source, ..arm })
    }
}

fn arm_of(path: &Path, source: &TomlSource) -> Result<ArmFile, FileError> {
    let document = source.document()?;
    let file = Section::of(source, &document);
    file.has("format");
    let Some(robot) = file.section("robot", "[robot]")? else {
        return Err(source.problem(Problem::MissingParameter("[robot]".to_owned())));
    };
    let tables = file.sections("joint")?;
    let arm = ArmFile {
        name: robot.text("name")?,
        gravity_m_s2: gravity(&robot)?,
        sample_period_s: sample_period(&robot)?,
        joints: joints(path, &robot, &tables)?,
        effects: effects(&file, source)?,
        base_errors: base_errors(&file)?,
        source: TomlSource::default(),
    };
    tables.into_iter().try_for_each(Section::finish)?;
    robot.finish()?;
    file.finish()?;
    arm.check_effects(source)?;
    Ok(arm)
}

fn sample_period(robot: &Section) -> Result<Option<f64>, FileError> {
    const NAME: &str = "sample_period_s";
    let period = robot.number(NAME)?;
    match period {
        Some(period) if !(SAMPLE_PERIOD_S[0]..=SAMPLE_PERIOD_S[1]).contains(&period) => {
            let what = format!("{NAME} is {period}, but must be above 0, from 0.000001 to 10 s");
            Err(robot.problem(NAME, Problem::OutOfRange(what)))
        }
        _ => Ok(period),
    }
}

fn gravity(robot: &Section) -> Result<[f64; 3], FileError> {
    const NAME: &str = "gravity_m_s2";
    let gravity = robot.numbers(NAME)?.unwrap_or(UPRIGHT_M_S2);
    if gravity.iter().any(|part: &f64| part.abs() > STRONGEST_GRAVITY_M_S2) {
        let what = format!("{NAME} is {gravity:?}, but must be at most 98.1 m/s^2");
        return Err(robot.problem(NAME, Problem::OutOfRange(what)));
    }
    Ok(gravity)
}

/// The joints: as the tables say, or of a URDF with what the tables add.
fn joints(path: &Path, robot: &Section, tables: &[Section]) -> Result<Vec<ArmJoint>, FileError> {
    let given = match robot.text("urdf")? {
        Some(name) => {
            let names = tables.iter().map(|table| table.text("name"));
            let names: Vec<Option<String>> = names.collect::<Result<_, _>>()?;
            Some(urdf::joints(&path.with_file_name(name), &names)?)
        }
        None => None,
    };
    let count = given.as_ref().map_or(tables.len(), Vec::len);
    if !(1..=MAX_JOINTS).contains(&count) {
        let what = format!("there are {count} joints, but must be 1 to {MAX_JOINTS} [[joint]]");
        return Err(robot.problem("urdf", Problem::Contradiction(what)));
    }
    match given {
        Some(given) if tables.is_empty() => Ok(given),
        Some(given) => given.iter().zip(tables).map(|(g, t)| read_joint(t, Some(g))).collect(),
        None => tables.iter().map(|table| read_joint(table, None)).collect(),
    }
}

fn effects(file: &Section, source: &TomlSource) -> Result<Vec<EffectTable>, FileError> {
    for table in file.sections("effect")? {
        EFFECT.iter().for_each(|key| {
            table.has(key);
        });
        table.finish()?;
    }
    Ok(source.parse::<Effects>()?.effect)
}

/// How well base parameters are known.
fn base_errors(file: &Section) -> Result<Vec<BaseError>, FileError> {
    let of_table = |table: Section| {
        let missing = |name: &str| Problem::MissingParameter(format!("{name} of a [[{BASE}]]"));
        let Some(name) = table.text("name")? else {
            return Err(table.problem("name", missing("name")));
        };
        let Some(standard_error) = table.number("standard_error")?.filter(|error| *error >= 0.0)
        else {
            return Err(table.problem("standard_error", missing("standard_error, at least 0,")));
        };
        table.finish()?;
        Ok(BaseError { name, standard_error })
    };
    file.sections(BASE)?.into_iter().map(of_table).collect()
}

impl ArmFile {
    fn check_effects(&self, source: &TomlSource) -> Result<(), FileError> {
        let most = self.joints.len();
        let is_out = |effect: &EffectTable| usize::from(effect.joint) > most;
        let Some(index) = self.effects.iter().position(is_out) else { return Ok(()) };
        let joint = self.effects[index].joint;
        let what = format!("joint of the effect is {joint}, but must be 0 to {most}");
        Err(source.problem_in_nth(Problem::Contradiction(what), "effect", index))
    }
}
