//! `rrr run`: an experiment with the real arm, recorded.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use firmware::ParameterBlock;
use firmware::link::{Command, Source};

use self::choice::{Choice, Limits};
use self::save::Folder;
use super::Failure;
use super::interrupt::interrupt;
use super::link_choice::{LinkChoice, openness};
use super::upload::encoded;
use crate::files::Role;
use crate::link::approach::approach;
use crate::link::session::{self, Ending};
use crate::link::{Client, Recorder, transfer};
use crate::progress::Progress;
use crate::simulation::Plan;

mod choice;
mod save;

/// Arguments of `rrr run`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// What is played.
    #[command(flatten)]
    pub choice: Choice,
    /// Limits for this run.
    #[command(flatten)]
    pub limits: Limits,
    /// Directory for the logs and dataset.toml; what is there already stays.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// What the log is for, train or holdout, instead of what the experiment is for.
    #[arg(long, value_parser = role_named)]
    pub role: Option<Role>,
    /// Fastest that a joint moves on its way to where the experiment begins.
    #[arg(long, value_name = "RAD_PER_S", default_value_t = 0.5, value_parser = speed)]
    pub approach_speed: f32,
    /// The board stops by itself when it has heard nothing for so long.
    #[arg(long, value_name = "MS", default_value_t = 1000)]
    #[arg(value_parser = clap::value_parser!(u16).range(300..))]
    pub host_timeout_ms: u16,
    /// Which board.
    #[command(flatten)]
    pub link: LinkChoice,
}

fn role_named(name: &str) -> Result<Role, String> {
    match name {
        "train" => Ok(Role::Train),
        "holdout" => Ok(Role::Holdout),
        _ => Err("take train or holdout".to_owned()),
    }
}

fn speed(text: &str) -> Result<f32, String> {
    let speed: f32 = text.parse().map_err(|_| "it is no number".to_owned())?;
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
    arguments.choice.check()?;
    let mut folder = Folder::open(&arguments.out)?;
    let mut client = arguments.link.connect()?;
    let report = client.report()?;
    if let Some(fault) = report.fault {
        let hint = "docs/safety.md says what it means; then `rrr clear-fault`";
        return Err(Failure::new(format!("the board is faulted: {fault}"), hint));
    }
    println!("link        {}", openness(&report));
    let interrupted = interrupt();
    let (plan, block) = arguments.prepare(&mut client, interrupted)?;
    let ticks = plan_ticks(&plan, &block);
    let prepared = arguments.go_there(&mut client, &block, interrupted).and_then(|arrived| {
        transfer::put_into_use(&mut client, &encoded(&block)?)?;
        Ok(arrived)
    });
    let mut recorder = Recorder::new(&block, ticks);
    let ending = match prepared {
        Ok(true) => arguments.play(&mut client, &plan.name, &mut recorder, interrupted),
        Ok(false) => Ok(Ending::Interrupted),
        Err(failure) => Err(failure),
    };
    // A board that streams to nobody would go on for ever.
    let _ = client.order(Command::Stream { on: false });
    folder.save(&plan, arguments.role, &block, &recorder)?;
    told(ending?, ticks, &recorder)
}

impl Arguments {
    /// The experiment, and the board's own parameters with it.
    fn prepare(
        &self,
        client: &mut Client,
        interrupted: &AtomicBool,
    ) -> Result<(Plan, ParameterBlock), Failure> {
        let bytes = transfer::download(client, Source::Stored)?;
        let stored = ParameterBlock::decode(&bytes).map_err(|error| {
            let hint = "build tool and firmware from the same sources";
            Failure::new(format!("the board's block: {error}"), hint)
        })?;
        client.order(Command::Stream { on: true })?;
        let now = session::rest(client, stored.encoder_counts_per_turn, interrupted)?;
        let plan = self.choice.plan(&stored, &now)?;
        let block = ParameterBlock {
            mode: plan.mode,
            reference: plan.reference.clone(),
            ..self.limits.applied_to(stored)?
        };
        block.check().map_err(|error| {
            Failure::new(format!("the board would refuse it: {error}"), "change the option")
        })?;
        Ok((plan, block))
    }

    /// Moves the joints to where the reference begins; false if the user stopped it.
    fn go_there(
        &self,
        client: &mut Client,
        block: &ParameterBlock,
        interrupted: &AtomicBool,
    ) -> Result<bool, Failure> {
        let now = session::next_record(client)?;
        let Some(way) = approach(block, &now, self.approach_speed) else { return Ok(true) };
        transfer::put_into_use(client, &encoded(&way)?)?;
        let ticks = (way.reference.duration_s / way.sample_period_s).round() as u32;
        let mut recorder = Recorder::new(&way, ticks);
        match self.play(client, "to the beginning", &mut recorder, interrupted)? {
            Ending::Finished => Ok(true),
            Ending::Interrupted => Ok(false),
            ending => told(ending, ticks, &recorder).map(|()| false),
        }
    }

    fn play(
        &self,
        client: &mut Client,
        name: &str,
        recorder: &mut Recorder,
        interrupted: &AtomicBool,
    ) -> Result<Ending, Failure> {
        if interrupted.load(Ordering::Relaxed) {
            return Ok(Ending::Interrupted);
        }
        let progress = Progress::new(name, u64::from(recorder.ticks()));
        let ending =
            session::run(client, self.host_timeout_ms, recorder, interrupted, &mut |tick| {
                progress.at(u64::from(tick));
            });
        progress.finish();
        Ok(ending?)
    }
}

fn plan_ticks(plan: &Plan, block: &ParameterBlock) -> u32 {
    (plan.reference.duration_s / block.sample_period_s).round() as u32
}

/// What came of it, on the terminal and as the exit status.
fn told(ending: Ending, ticks: u32, recorder: &Recorder) -> Result<(), Failure> {
    let [first, second, third] = recorder.saturated;
    println!(
        "samples     {} of {ticks}, {} missing, {} of them dropped by the board",
        recorder.log.len(),
        recorder.missed,
        recorder.dropped
    );
    println!(
        "limits      commands cut {first} / {second} / {third}, longest tick {:.1} us",
        f64::from(recorder.longest_tick_tenth_us) / 10.0
    );
    match ending {
        Ending::Finished => println!("played to its end; 0 V, disarmed"),
        Ending::Interrupted => println!("stopped; 0 V, disarmed; the log is kept"),
        Ending::Board(_, Some(fault)) => {
            let hint = "docs/safety.md says what it means; then `rrr clear-fault`";
            return Err(Failure::new(format!("the board ended the run: {fault}"), hint));
        }
        Ending::Board(state, None) => {
            let message = format!("the run was ended by somebody else: the board was {state}");
            return Err(Failure::new(message, "the board is disarmed now"));
        }
        Ending::Broke(error) => {
            let failure = Failure::from(error);
            let message = format!("the link broke during the run: {}", failure.message);
            let hint = "the board stops by itself when it hears nothing; look at the cable";
            return Err(Failure::new(message, hint));
        }
    }
    Ok(())
}
