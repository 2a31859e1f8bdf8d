//! `rrr blind-trial`: how well the diagnosis does on robots with hidden effects.

mod arms;
mod diverse;
mod whole_way;
mod workers;

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

use clap::Args;

use self::workers::on_all_cores;
use crate::failure::Failure;
use crate::options::number::{duration_scale, noise_mv};
use crate::output_files::create_directory;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Progress;
use blind_trial::arms::{ArmKind, ArmTrialSettings};
use blind_trial::diverse::{DiverseSettings, Ranges};
use blind_trial::whole_way::WholeWaySettings;
use blind_trial::{
    Case, DrawSettings, Kind, Outcome, Results, RunSettings, SealedTruth, TrialError,
    diagnose_case, draw, logs, markdown, output, sealed_truth,
};
use diagnosis::{Criteria, diagnose};
use rig::effects::Catalogue;

/// Arguments of `rrr blind-trial`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Draw robots that do not share friction, effects and noise with the diagnosis: other laws
    /// of friction, causes of other shapes and any size, small effects everywhere, damaged logs.
    #[arg(long, conflicts_with_all = ["noise_mv", "only", "ceiling"])]
    pub diverse: bool,
    /// The whole way of a user: draw robots with five laws of friction in turn, record their
    /// campaigns, identify them, change one thing, record again, diagnose.
    #[arg(long, conflicts_with_all = ["diverse", "noise_mv", "kind", "ceiling", "draw_only"])]
    pub whole_way: bool,
    /// Another arm than the robot of three joints, with one effect hidden in each case, or none.
    #[arg(long, value_enum, value_name = "KIND", conflicts_with_all = ["diverse", "whole_way", "noise_mv", "only", "ceiling", "duration_scale"])]
    pub arm: Option<ArmKind>,
    /// How many cases to draw.
    #[arg(long, visible_alias = "robots", value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub cases: u32,
    /// Number of the first case; a case depends on its number and the seed alone.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub first: u32,
    /// Same seed, same cases.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    /// Directory for the logs, the seal and the results.
    #[arg(long, value_name = "DIR", default_value = "blind-trial")]
    pub out: PathBuf,
    /// All durations of the logs times this.
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = duration_scale)]
    pub duration_scale: f64,
    /// Amplifier noise [mV rms], instead of 3 to 6 mV as drawn.
    #[arg(long = "noise-mV", value_name = "X", value_parser = noise_mv)]
    pub noise_mv: Option<f64>,
    /// Only cases of this kind.
    #[arg(long, value_enum)]
    pub kind: Option<Kind>,
    /// Only these effects, of the catalogue or foreign to it.
    #[arg(long, value_name = "EFFECT,...", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Leave the logs of each case where they are.
    #[arg(long)]
    pub keep_logs: bool,
    /// Diagnose each robot without its hidden effects as well, to know how much of the gap
    /// could be closed; takes twice as long.
    #[arg(long)]
    pub ceiling: bool,
    /// Draw and record the cases and write the truth, without a diagnosis.
    #[arg(long)]
    pub draw_only: bool,
    /// Go on with a diverse trial that was stopped: answers that are in --out already are taken from there.
    #[arg(long, requires = "diverse", conflicts_with = "draw_only")]
    pub resume: bool,
    /// Have the searches of a diverse trial try the true causes first, those that the catalogue has: what is missed all the
    /// same is not missed by the search alone.
    #[arg(long, requires = "diverse", conflicts_with_all = ["draw_only", "resume"])]
    pub suspect_truth: bool,
}

/// Runs the command.
///
/// # Errors
/// Arguments out of range, files that cannot be written, or a case that cannot be drawn.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let settings = arguments.draw_settings();
    let of_arm = arguments.arm.map(|arm| arguments.arm_settings(arm)).transpose()?;
    create_directory(&arguments.out)?;
    if let Some(settings) = of_arm {
        return match arguments.draw_only {
            true => arms::draw_only(&settings, &arguments.out),
            false => arms::run(&settings, &arguments.run_settings()),
        };
    }
    if arguments.diverse {
        return arguments.run_diverse();
    }
    if arguments.whole_way {
        return whole_way::run(&arguments.whole_way_settings(), &arguments.run_settings());
    }
    let catalogue = Catalogue::standard();
    let cases = drawn(&settings, &catalogue)?;
    let truth = SealedTruth::new(&cases);
    say!("SHA-256 of the truth: {}", truth.hash());
    truth.write_hash(&arguments.out)?;
    if arguments.draw_only {
        return arguments.write_all(&cases, &truth);
    }
    let outcomes = arguments.diagnose_all(&cases)?;
    truth.reveal(&arguments.out)?;
    say!("SHA-256 of the truth, opened: {}\n", truth.hash());
    let results = Results::new(&catalogue, &settings, truth.hash(), outcomes);
    output::write(&results, &arguments.out)?;
    say!("{}", markdown::short(&results));
    say!("Cases: {}", arguments.out.join("blind-trial.md").display());
    answer(&results)
}

impl Arguments {
    fn draw_settings(&self) -> DrawSettings {
        DrawSettings {
            seed: self.seed,
            first: self.first,
            cases: self.cases,
            kind: self.kind,
            only: self.only.clone(),
            duration_scale: self.duration_scale,
            noise_v: self.noise_mv.map(|noise_mv| 1e-3 * noise_mv),
        }
    }

    /// The diverse trial's draw: all kinds, or the one that is asked for.
    fn diverse_settings(&self) -> DiverseSettings {
        let mut ranges = Ranges::default();
        for (kind, part) in &mut ranges.kinds {
            if self.kind.is_some_and(|wanted| wanted != *kind) {
                *part = 0.0;
            }
        }
        DiverseSettings {
            seed: self.seed,
            first: self.first,
            cases: self.cases,
            duration_scale: self.duration_scale,
            ranges,
        }
    }

    fn arm_settings(&self, arm: ArmKind) -> Result<ArmTrialSettings, Failure> {
        if matches!(self.kind, Some(Kind::Pair | Kind::Foreign)) {
            let message = "--kind: other arms hide one effect of the catalogue, or none";
            return Err(Failure::new(message, "take --kind single or none, or leave it out"));
        }
        let (seed, first, cases, kind) = (self.seed, self.first, self.cases, self.kind);
        Ok(ArmTrialSettings { arm, seed, first, cases, kind })
    }

    fn whole_way_settings(&self) -> WholeWaySettings {
        WholeWaySettings {
            duration_scale: self.duration_scale,
            only: self.only.clone(),
            ..WholeWaySettings::new(self.seed, self.first, self.cases)
        }
    }

    fn run_diverse(&self) -> Result<(), Failure> {
        let settings = self.diverse_settings();
        if self.draw_only {
            return diverse::draw_only(&settings, &self.out);
        }
        let (resumes, suspects_truth) = (self.resume, self.suspect_truth);
        diverse::run(&settings, &self.run_settings(), diverse::Way { resumes, suspects_truth })
    }

    fn run_settings(&self) -> RunSettings {
        RunSettings { out: self.out.clone(), keep_logs: self.keep_logs, ceiling: self.ceiling }
    }

    /// Diagnoses the cases, one on each core, and prints each answer as it comes.
    fn diagnose_all(&self, cases: &[Case]) -> Result<Vec<Outcome>, Failure> {
        let mut outcomes = on_all_cores(cases, &|case| {
            let outcome = self.diagnose_one(case)?;
            let answer = markdown::answer(&outcome.answer);
            say!("case {:03}: {answer}, {:.0} s", case.number, outcome.seconds);
            Ok(outcome)
        })?;
        outcomes.sort_by_key(|outcome| outcome.case);
        Ok(outcomes)
    }

    fn diagnose_one(&self, case: &Case) -> Result<Outcome, Failure> {
        let outcome = diagnose_case(case, &self.run_settings(), &|campaign| {
            let diagnosis =
                diagnose(campaign, &Catalogue::standard(), &Criteria::default(), &|_| ());
            diagnosis.map(|found| found.report).map_err(|error| error.to_string())
        })?;
        Ok(outcome)
    }

    /// Writes the logs of all cases with their truth.
    fn write_all(&self, cases: &[Case], truth: &SealedTruth) -> Result<(), Failure> {
        let progress = Progress::new("recording", cases.len() as u64);
        for (done, case) in (1..).zip(cases) {
            let directory = logs::directory(&self.out, case.number);
            logs::write(case, &directory)?;
            sealed_truth::write_truth(case, &directory)?;
            progress.at(done);
        }
        progress.finish();
        truth.reveal(&self.out)?;
        say!("{} cases in {}", cases.len(), self.out.display());
        Ok(())
    }
}

fn drawn(settings: &DrawSettings, catalogue: &Catalogue) -> Result<Vec<Case>, Failure> {
    let progress = Progress::new("drawing cases", u64::from(settings.cases));
    let done = AtomicU64::new(0);
    let cases =
        draw(settings, catalogue, &|| progress.at(done.fetch_add(1, Ordering::Relaxed) + 1))?;
    progress.finish();
    Ok(cases)
}

impl From<TrialError> for Failure {
    fn from(error: TrialError) -> Self {
        match error {
            TrialError::File(error) => error.into(),
            TrialError::Board(error) => error.into(),
            TrialError::UnknownEffect(_) => {
                Self::new(error.to_string(), "docs/effects.md lists the catalogue")
            }
            TrialError::NothingDetectable { .. } => {
                Self::new(error.to_string(), "take another --seed, or less noise")
            }
            _ => Self::new(error.to_string(), ""),
        }
    }
}
