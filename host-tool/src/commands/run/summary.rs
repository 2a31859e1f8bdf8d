//! How a run ended, on the terminal and as the exit status.

use firmware::supervisor::FaultRecord;

use crate::failure::Failure;
use crate::terminal::answer::answer;
use crate::terminal::output::try_print_line;
use link::run::RunOutcome;
use link::{LineCounters, LinkError, Recorder};
use serde_json::json;

/// What to do about a fault.
pub const FAULT_HINT: &str = "docs/safety.md says what it means; then `rrr clear-fault`";

/// One of the two motions of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The motion to where the experiment begins.
    Approach,
    /// The experiment.
    Experiment,
}

impl Phase {
    /// The name that messages use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Approach => "approach",
            Self::Experiment => "run",
        }
    }
}

impl Phase {
    /// Name of its log, where the experiment's is `name`.
    pub fn log_name(self, name: &str) -> String {
        match self {
            Self::Approach => format!("{name}-approach"),
            Self::Experiment => name.to_owned(),
        }
    }
}

/// Whether a fault of the board ended the phase, or the loss of link or board, which is one there.
pub fn is_fault(outcome: &RunOutcome) -> bool {
    match outcome {
        RunOutcome::EndedByBoard(_, fault) => fault.is_some(),
        RunOutcome::BoardReset(_) | RunOutcome::LinkLost(_) => true,
        RunOutcome::Finished | RunOutcome::Interrupted => false,
    }
}

/// Prints how a phase ended, at once: writing its log takes a while.
///
/// # Errors
/// Every outcome but [`RunOutcome::Finished`].
pub fn print(
    phase: Phase,
    outcome: RunOutcome,
    recorder: &Recorder,
    counters: LineCounters,
) -> Result<(), Failure> {
    print_figures(recorder, counters);
    let failure = failure(phase.name(), outcome, recorder);
    let _ = answer(&json!({
        "phase": phase.name(),
        "finished": failure.is_none(),
        "ended": failure.as_ref().map(|failure| &failure.message),
        "samples": recorder.log.len(),
        "ticks": recorder.ticks_done(),
        "missing": recorder.missed(),
        "dropped": recorder.dropped(),
        "saturated": recorder.saturated,
        "longest_tick_us": f64::from(recorder.longest_tick_tenth_us) / 10.0,
    }));
    match &failure {
        None => try_print_line("played to its end; 0 V, disarmed"),
        Some(failure) => try_print_line(format_args!("ended       {}", failure.message)),
    }
    failure.map_or(Ok(()), Err)
}

fn failure(phase: &str, outcome: RunOutcome, recorder: &Recorder) -> Option<Failure> {
    let done = format!("in tick {} of {}", recorder.ticks_done(), recorder.ticks());
    Some(match outcome {
        RunOutcome::Finished => return None,
        RunOutcome::Interrupted => {
            Failure::interrupted(format!("the {phase} was stopped {done}; 0 V, disarmed"))
        }
        RunOutcome::EndedByBoard(_, Some(fault)) => {
            Failure::new(format!("the board ended the {phase}: {fault}"), FAULT_HINT)
        }
        RunOutcome::EndedByBoard(state, None) => Failure::new(
            format!("another host ended the {phase} {done}: the board was {state}"),
            "the board is disarmed now",
        ),
        RunOutcome::BoardReset(report) => {
            reset(phase, &done, report.and_then(|report| report.fault))
        }
        RunOutcome::LinkLost(error) => link_lost(phase, &done, error),
    })
}

/// Prints how much of it was recorded.
fn print_figures(recorder: &Recorder, counters: LineCounters) {
    let [first, second, third] = recorder.saturated;
    try_print_line(format_args!(
        "samples     {} of {}, {} missing, {} of them dropped by the board",
        recorder.log.len(),
        recorder.ticks_done(),
        recorder.missed(),
        recorder.dropped()
    ));
    try_print_line(format_args!(
        "line        {} damaged frames, {} requests repeated",
        counters.broken_frames, counters.retries
    ));
    try_print_line(format_args!(
        "limits      commands cut {first} / {second} / {third}, longest tick {:.1} us",
        f64::from(recorder.longest_tick_tenth_us) / 10.0
    ));
}

fn reset(phase: &str, done: &str, fault: Option<FaultRecord>) -> Failure {
    let message = format!("the board was reset {done} of the {phase}, which ended it");
    match fault {
        Some(fault) => Failure::new(format!("{message}; it is faulted: {fault}"), FAULT_HINT),
        None => Failure::new(
            message,
            "its output is 0 V since then; look at its supply and its reset button; incremental \
             encoders count from zero again",
        ),
    }
}

fn link_lost(phase: &str, done: &str, error: LinkError) -> Failure {
    let is_line = matches!(error, LinkError::Line { .. } | LinkError::NoAnswer { .. });
    let failure = Failure::from(error);
    let message = failure.message;
    match is_line {
        true => Failure::new(
            format!("the link was lost {done} of the {phase}: {message}"),
            "the board stops by itself when it hears nothing; look at the cable, then let \
             `rrr connect` show the board's state",
        ),
        false => Failure::new(format!("the {phase} was aborted {done}: {message}"), failure.hint),
    }
}

/// The failure of the run or of saving its log, or one of both.
///
/// # Errors
/// At least one of them failed.
pub fn both(run: Result<(), Failure>, saved: Result<(), Failure>) -> Result<(), Failure> {
    match (run, saved) {
        (Ok(()), saved) => saved,
        (run, Ok(())) => run,
        (Err(run), Err(saved)) => Err(Failure::new(
            format!("{}; and then: {}", run.message, saved.message),
            format!("{}; {}", run.hint, saved.hint).trim_start_matches("; "),
        )),
    }
}
