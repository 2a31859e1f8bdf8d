//! `excitation.toml`: the designed motion that the board plays.

use std::io::Write;
use std::path::Path;

use firmware::reference::{FadeIn, FourierSeries, Motion, TERMS};
use model::ParameterError;
use model::parameter::named;
use serde::{Deserialize, Serialize};

use super::error::{FileError, Problem};
use super::known_keys::{self, TableKeys};
use super::replace::replace_file;
use super::toml_source::{FORMAT, TomlSource};

/// The keys of the file.
const KEYS: [TableKeys; 2] = [
    ("", &["format", "condition_number", "sample_period_s", "seed", "fade_in_s", "joint"]),
    ("joint", JOINT),
];
const JOINT: &[&str] = &[
    "joint",
    "centre_rad",
    "period_s",
    "sine_rad",
    "cosine_rad",
    "peak_velocity_rad_per_s",
    "peak_command_V",
];

/// A Fourier series for each joint, and what is known of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExcitationFile {
    /// The format's number, 1.
    pub format: i64,
    /// J_k of Phi, eq. (14), over one period.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub condition_number: Option<f64>,
    /// Time between the samples of Phi [s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample_period_s: Option<f64>,
    /// The seed that gave it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<i64>,
    /// Time in which the motion swells from rest [s].
    pub fade_in_s: f32,
    /// The joints 1 to 3, in order.
    #[serde(rename = "joint")]
    pub joints: [JointTable; 3],
}

/// One `[[joint]]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointTable {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Centre [rad].
    pub centre_rad: f32,
    /// Period of the first term [s].
    pub period_s: f32,
    /// Sine amplitudes [rad].
    pub sine_rad: [f32; TERMS],
    /// Cosine amplitudes [rad].
    pub cosine_rad: [f32; TERMS],
    /// Largest velocity [rad/s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak_velocity_rad_per_s: Option<f64>,
    /// Largest command that the motion needs [V].
    #[serde(rename = "peak_command_V", default, skip_serializing_if = "Option::is_none")]
    pub peak_command_v: Option<f64>,
}

impl ExcitationFile {
    /// A file with three joints' tables, of which nothing else is known.
    pub fn new(fade_in_s: f32, joints: [JointTable; 3]) -> Self {
        Self {
            format: FORMAT,
            condition_number: None,
            sample_period_s: None,
            seed: None,
            fade_in_s,
            joints,
        }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// Names the file and line, what is wrong, and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        Self::of(&TomlSource::read(path.as_ref())?)
    }

    /// The same from a file's bytes; the path is for messages.
    ///
    /// # Errors
    /// As of [`ExcitationFile::read`].
    pub fn parse(path: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, FileError> {
        Self::of(&TomlSource::of(path.as_ref(), bytes)?)
    }

    fn of(source: &TomlSource) -> Result<Self, FileError> {
        known_keys::check(source, &KEYS)?;
        let file: Self = source.parse()?;
        file.check(source)?;
        Ok(file)
    }

    /// Writes a file, whole or not at all.
    ///
    /// # Errors
    /// The path cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        let path = path.as_ref();
        let text = toml::to_string(self)
            .map_err(|error| Problem::Toml(error.to_string()).in_file(path))?;
        replace_file(path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))
    }

    /// What the board is told to play.
    pub fn motion(&self) -> [Motion; 3] {
        self.joints.each_ref().map(|table| {
            Motion::Fourier(FourierSeries {
                centre_rad: table.centre_rad,
                period_s: table.period_s,
                sine_rad: table.sine_rad,
                cosine_rad: table.cosine_rad,
                fade_in: FadeIn { duration_s: self.fade_in_s },
            })
        })
    }

    fn check(&self, source: &TomlSource) -> Result<(), FileError> {
        let numbers = self.joints.each_ref().map(|table| table.joint);
        if numbers != [1, 2, 3] {
            let what = format!("[[joint]] must be there for joints 1, 2, 3, not {numbers:?}");
            return Err(source.problem(Problem::Contradiction(what)));
        }
        let fade_in = named("fade_in_s", self.fade_in_s).not_negative().map(drop);
        fade_in.map_err(|error| source.problem_in(error.into(), "", None, "fade_in_s"))?;
        self.joints.iter().try_for_each(|table| {
            table.check().map_err(|error| {
                let key = error.name;
                source.problem_in(error.into(), "joint", Some(table.joint), key)
            })
        })
    }
}

impl JointTable {
    /// Checks what the board will check, here where the file and line are known.
    fn check(&self) -> Result<(), ParameterError> {
        const LARGEST_RAD: f32 = 100.0;
        let named = |name, value| named(name, value).of_joint(self.joint);
        named("period_s", self.period_s).positive()?;
        let centre_rad = [self.centre_rad];
        let groups = [
            ("centre_rad", &centre_rad[..]),
            ("sine_rad", &self.sine_rad),
            ("cosine_rad", &self.cosine_rad),
        ];
        for (name, angles_rad) in groups {
            for &angle_rad in angles_rad {
                let is_small = angle_rad.abs() <= LARGEST_RAD;
                named(name, angle_rad).require(is_small, "be within 100 rad")?;
            }
        }
        Ok(())
    }
}
