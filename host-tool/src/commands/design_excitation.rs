//! `rrr design-excitation`: the motion that identifies the base parameters best.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use crate::failure::Failure;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Progress;
use files::RobotFile;
use files::excitation_file::{ExcitationFile, JointTable};
use identification::excitation_design::{Design, Effort, Range, Settings, design};
use rig::Rig;
use serde_json::json;

/// Arguments of `rrr design-excitation`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The robot that will move: lengths and torque constants make J_k, base parameters
    /// and friction the voltage that the motion needs.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// Where the coefficients go.
    #[arg(long, value_name = "EXCITATION.toml")]
    pub out: PathBuf,
    /// Same seed, same motion.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32))]
    pub seed: u32,
    /// End the search after this time; where it cuts the search short, the motion
    /// depends on the computer's speed too.
    #[arg(long, value_name = "S")]
    pub seconds: Option<f64>,
    /// Random motions to start from; the best result counts.
    #[arg(long, default_value_t = Effort::default().starts,
        value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub starts: u32,
}

/// Runs the command.
///
/// # Errors
/// A model that cannot be used, a robot that its amplifiers cannot move, or a file that
/// cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let file = RobotFile::read(&arguments.model)?;
    let robot = file.robot()?;
    let settings = arguments.settings(&file)?;
    let progress = Progress::new("excitation design", PROGRESS_STEPS);
    let design = design(&robot, &settings, &|share| {
        progress.at((share * PROGRESS_STEPS as f64) as u64);
    });
    progress.finish();
    refuse_overload(&design, &settings)?;
    excitation_file(&design, &settings).write(&arguments.out)?;
    say!("{}", table(&design, &settings).trim_end());
    say!("coefficients in {}", arguments.out.display());
    answer(&json!({
        "out": arguments.out,
        "condition_number": design.condition_number,
        "peak_velocity_rad_per_s": design.demand.velocity_rad_per_s,
        "peak_command_V": design.demand.command_v,
        "cut_short": design.cut_short,
    }))
}

const PROGRESS_STEPS: u64 = 1000;

impl Arguments {
    fn settings(&self, file: &RobotFile) -> Result<Settings, Failure> {
        const CONVERTER_LIMIT_V: f64 = 10.0;
        let limit_v = file.robot.command_limit_v.unwrap_or(CONVERTER_LIMIT_V);
        let paper = Settings::of_paper(limit_v);
        let effort = Effort { starts: self.starts, time_limit: self.time_limit()?, ..paper.effort };
        let range = range(&Rig::of_file(file)?);
        if let Some(joint) = range.outside(&paper.centre_rad) {
            return Err(Failure::new(
                format!("joint {joint} hangs outside its range, and the motion begins there"),
                "correct limits_rad in the model file",
            ));
        }
        Ok(Settings { effort, range, seed: u64::from(self.seed), ..paper })
    }

    fn time_limit(&self) -> Result<Option<Duration>, Failure> {
        let Some(seconds) = self.seconds else { return Ok(None) };
        match Duration::try_from_secs_f64(seconds) {
            Ok(limit) if !limit.is_zero() => Ok(Some(limit)),
            _ => {
                let message = format!("--seconds {seconds}: no time to search in");
                Err(Failure::new(message, "give a number of seconds above 0"))
            }
        }
    }
}

/// The ranges of the model file, and what the arm can brake with.
fn range(rig: &Rig) -> Range {
    Range { limits_rad: rig.limits_rad, braking_rad_per_s2: rig.braking_rad_per_s2() }
}

/// Refuses a design that needs more voltage than there is even when it is slowest.
fn refuse_overload(design: &Design, settings: &Settings) -> Result<(), Failure> {
    if design.keeps_limits {
        return Ok(());
    }
    let [first, second, third] = design.demand.command_v;
    let usable_v = settings.limits.usable_command_v();
    let message = format!(
        "no motion found within {usable_v:.2} V: gravity and friction alone need \
         {first:.2}, {second:.2}, {third:.2} V of joints 1 to 3"
    );
    Err(Failure::new(message, "check command_limit_V, torque constants, friction and moments"))
}

/// The file that the board's motion is read from.
fn excitation_file(design: &Design, settings: &Settings) -> ExcitationFile {
    let series = &design.series;
    let joints = [0, 1, 2].map(|i| JointTable {
        joint: i as u8 + 1,
        centre_rad: series.centre_rad[i] as f32,
        period_s: series.period_s as f32,
        sine_rad: series.sine_rad[i].map(|a| a as f32),
        cosine_rad: series.cosine_rad[i].map(|b| b as f32),
        peak_velocity_rad_per_s: Some(rounded(design.demand.velocity_rad_per_s[i])),
        peak_command_v: Some(rounded(design.demand.command_v[i])),
    });
    ExcitationFile {
        condition_number: Some(rounded(design.condition_number)),
        sample_period_s: Some(settings.sample_period_s),
        seed: Some(settings.seed as i64),
        ..ExcitationFile::new(series.fade_in_s as f32, joints)
    }
}

/// To the digits that a reader wants.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// The design in words.
fn table(design: &Design, settings: &Settings) -> String {
    let demand = &design.demand;
    let mut text = String::from("joint  peak velocity         peak command\n");
    for i in 0..3 {
        text += &format!(
            "{:5}  {:5.2} of {:5.2} rad/s  {:5.2} of {:5.2} V\n",
            i + 1,
            demand.velocity_rad_per_s[i],
            settings.limits.velocity_rad_per_s[i],
            demand.command_v[i],
            settings.limits.command_v,
        );
    }
    text += &format!(
        "J_k = {:.3} over one period of {} s in samples of {} s (the paper reached 8.06)\n",
        design.condition_number, settings.period_s, settings.sample_period_s
    );
    const HARDLY_EXCITES: f64 = 100.0;
    if design.condition_number > HARDLY_EXCITES {
        text +=
            "warning: this motion hardly distinguishes the parameters; the voltage limit is low\n";
    }
    if design.cut_short {
        text += "the search was cut short by --seconds; more time may find a smaller J_k\n";
    }
    text
}
