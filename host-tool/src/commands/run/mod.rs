//! `rrr run`: an experiment with the real arm, recorded.

use std::cell::RefCell;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use clap::Args;
use firmware::ParameterBlock;
use firmware::link::{Command, Source};

use self::experiment::{ExperimentOptions, Limits};
use self::live::Live;
use self::log_folder::LogFolder;
use self::summary::Phase;
use crate::failure::Failure;
use crate::live::Server;
use crate::options::block::refuse_leaving;
use crate::options::board::{BoardOptions, access};
use crate::options::foxglove::FoxgloveOptions;
use crate::terminal::interrupt::interrupt;
use crate::terminal::output::try_print_line;
use files::{GrowingCsv, Role};
use link::approach::approach;
use link::run::RunOutcome;
use link::{Client, Recorder, RetryPolicy, settling, transfer};
use rig::Plan;
use rig::joints;

mod experiment;
mod live;
mod log_folder;
mod summary;

/// Arguments of `rrr run`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The experiment.
    #[command(flatten)]
    pub experiment: ExperimentOptions,
    /// Limits for this run.
    #[command(flatten)]
    pub limits: Limits,
    /// Directory for the logs and dataset.toml; what is there already stays.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Role of the log, train or holdout, instead of the experiment's own.
    #[arg(long, value_parser = role_named)]
    pub role: Option<Role>,
    /// Largest joint speed on the approach, the motion to where the experiment begins.
    #[arg(long, value_name = "RAD_PER_S", default_value_t = 0.5, value_parser = speed)]
    pub approach_speed: f32,
    /// The board stops by itself after so long without a request; 10 s is its ceiling.
    #[arg(long, value_name = "MS", default_value_t = 1000)]
    #[arg(value_parser = clap::value_parser!(u16).range(300..=10_000))]
    pub host_timeout_ms: u16,
    /// Whether samples are served to Foxglove.
    #[command(flatten)]
    pub foxglove: FoxgloveOptions,
    /// Which board.
    #[command(flatten)]
    pub board: BoardOptions,
}

fn role_named(name: &str) -> Result<Role, String> {
    match name {
        "train" => Ok(Role::Train),
        "holdout" => Ok(Role::Holdout),
        _ => Err("take train or holdout".to_owned()),
    }
}

fn speed(text: &str) -> Result<f32, String> {
    let speed: f32 = text.parse().map_err(|_| "it is not a number".to_owned())?;
    match speed > 0.0 && speed <= 3.0 {
        true => Ok(speed),
        false => Err("it must be above 0 and at most 3 rad/s".to_owned()),
    }
}

/// Runs the command.
///
/// # Errors
/// An experiment that there is not, a board that does not answer or refuses, a fault, or
/// files that cannot be written; what was recorded before a fault is kept.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    arguments.experiment.check()?;
    let mut folder = LogFolder::open(&arguments.out)?;
    let mut client = arguments.board.connect()?;
    let report = client.report()?;
    if let Some(fault) = report.fault {
        return Err(Failure::new(format!("the board is faulted: {fault}"), summary::FAULT_HINT));
    }
    try_print_line(format_args!("link        {}", access(&report)));
    let result = arguments.record(&mut client, &mut folder, interrupt());
    // A board that streams to nobody would go on for ever.
    client.set_retry_policy(RetryPolicy::LAST_ATTEMPT);
    let _ = client.execute(Command::Stream { on: false });
    result
}

/// The motion that was played last, and how it ended.
struct Played {
    phase: Phase,
    recorder: Recorder,
    outcome: RunOutcome,
    /// The log as it came, not needed once it is saved.
    growing: Option<GrowingCsv>,
}

/// What both motions of an experiment are played with.
struct Session<'a> {
    name: &'a str,
    folder: &'a LogFolder,
    interrupted: &'a AtomicBool,
    foxglove: RefCell<Option<Server>>,
}

impl Arguments {
    /// Plays the experiment and saves its log, whatever the outcome.
    fn record(
        &self,
        client: &mut Client,
        folder: &mut LogFolder,
        interrupted: &AtomicBool,
    ) -> Result<(), Failure> {
        let (plan, block) = self.prepare(client, interrupted)?;
        let counts_per_rev = f64::from(block.encoder_counts_per_turn);
        let plan = Plan { role: self.role.unwrap_or(plan.role), ..plan };
        folder.prepare(&plan, counts_per_rev)?;
        let foxglove = RefCell::new(self.foxglove.start(counts_per_rev)?);
        let session = Session { name: &plan.name, folder, interrupted, foxglove };
        let Played { phase, recorder, outcome, growing } =
            self.play_all(client, &block, &session)?;
        let is_fault = summary::is_fault(&outcome);
        let result = summary::print(phase, outcome, &recorder, client.counters());
        let saved = match phase {
            Phase::Experiment if is_fault && plan.role == Role::Train => {
                folder.save_unlisted(&plan.name, "it ended in a fault", counts_per_rev, &recorder)
            }
            Phase::Experiment => folder.save(&plan, counts_per_rev, &recorder),
            Phase::Approach => {
                let name = phase.log_name(&plan.name);
                folder.save_unlisted(&name, "the approach", counts_per_rev, &recorder)
            }
        };
        if saved.is_ok() {
            growing.map(GrowingCsv::remove).transpose()?;
        }
        summary::both(result, saved)
    }

    /// The experiment, and the board's own parameters with it.
    fn prepare(
        &self,
        client: &mut Client,
        interrupted: &AtomicBool,
    ) -> Result<(Plan, ParameterBlock), Failure> {
        let stored = transfer::download_block(client, Source::Stored)?;
        client.execute(Command::Stream { on: true })?;
        let now = settling::wait_for_rest(client, stored.encoder_counts_per_turn, interrupted)?;
        let plan = self.experiment.plan(&stored, &now)?;
        let joints = joints::present(&stored);
        if let Some(joint) = plan.joint.filter(|joint| !joints.contains(joint)) {
            let message = format!("{} moves joint {joint}, which the rig does not have", plan.name);
            return Err(Failure::new(message, "`rrr upload` was given --joints without it"));
        }
        let block = ParameterBlock {
            mode: plan.mode,
            reference: plan.reference.clone(),
            ..self.limits.applied_to(stored)?
        };
        let block = joints::with_joints(block, &joints);
        refuse_leaving(&block)?;
        block.check().map_err(|error| {
            Failure::new(format!("the board would refuse it: {error}"), "change the option")
        })?;
        Ok((plan, block))
    }

    /// The approach, and if it finishes, the experiment.
    fn play_all(
        &self,
        client: &mut Client,
        block: &ParameterBlock,
        session: &Session<'_>,
    ) -> Result<Played, Failure> {
        if let Some(unfinished) = self.approach(client, block, session)? {
            return Ok(unfinished);
        }
        transfer::put_into_use(client, &transfer::encoded(block)?)?;
        self.play(client, Phase::Experiment, block, session)
    }

    /// Moves the joints to where the reference begins; the approach, if it did not finish.
    fn approach(
        &self,
        client: &mut Client,
        block: &ParameterBlock,
        session: &Session<'_>,
    ) -> Result<Option<Played>, Failure> {
        let now = settling::next_record(client)?;
        let Some(approach) = approach(block, &now, self.approach_speed) else { return Ok(None) };
        refuse_leaving(&approach)?;
        transfer::put_into_use(client, &transfer::encoded(&approach)?)?;
        let played = self.play(client, Phase::Approach, &approach, session)?;
        if !matches!(played.outcome, RunOutcome::Finished) {
            return Ok(Some(played));
        }
        played.growing.map(GrowingCsv::remove).transpose()?;
        Ok(None)
    }

    fn play(
        &self,
        client: &mut Client,
        phase: Phase,
        block: &ParameterBlock,
        session: &Session<'_>,
    ) -> Result<Played, Failure> {
        let ticks = (block.reference.duration_s / block.sample_period_s).round() as u32;
        let mut recorder = Recorder::new(block, ticks);
        let growing = session.folder.grow(&phase.log_name(session.name), &recorder)?;
        let mut foxglove = session.foxglove.borrow_mut();
        let mut live = Live::new(phase.name(), ticks, block.encoder_counts_per_turn, growing)
            .served_by(foxglove.as_mut());
        let (timeout_ms, interrupted) = (self.host_timeout_ms, session.interrupted);
        let outcome = link::run::run(client, timeout_ms, &mut recorder, interrupted, &mut live);
        let growing = live.finish();
        match outcome {
            Ok(outcome) => Ok(Played { phase, recorder, outcome, growing }),
            Err(error) => {
                // It did not begin.
                growing.map(GrowingCsv::remove).transpose()?;
                Err(error.into())
            }
        }
    }
}
