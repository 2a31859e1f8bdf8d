//! How a run ended, on the terminal and as the exit status.

use firmware::supervisor::FaultRecord;

use crate::failure::Failure;
use crate::terminal::output::try_print_line;
use link::session::Ending;
use link::{LinkError, Recorder, Tally};

/// What to do about a fault.
pub const FAULT_HINT: &str = "docs/safety.md says what it means; then `rrr clear-fault`";

/// What is played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The way to where the experiment begins.
    Approach,
    /// The experiment.
    Experiment,
}

impl Phase {
    /// The name that messages use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Approach => "way to the beginning",
            Self::Experiment => "run",
        }
    }
}

/// Tells how a part ended, at once: writing its log takes a while.
///
/// # Errors
/// Whatever is not the part's own end; Ctrl-C too.
pub fn ending(
    part: Phase,
    ending: Ending,
    recorder: &Recorder,
    tally: Tally,
) -> Result<(), Failure> {
    figures(recorder, tally);
    let failure = failure(part.name(), ending, recorder);
    match &failure {
        None => try_print_line("played to its end; 0 V, disarmed"),
        Some(failure) => try_print_line(format_args!("ended       {}", failure.message)),
    }
    failure.map_or(Ok(()), Err)
}

fn failure(part: &str, ending: Ending, recorder: &Recorder) -> Option<Failure> {
    let done = format!("in tick {} of {}", recorder.ticks_done(), recorder.ticks());
    Some(match ending {
        Ending::Finished => return None,
        Ending::Interrupted => {
            Failure::interrupted(format!("the {part} was stopped {done}; 0 V, disarmed"))
        }
        Ending::Board(_, Some(fault)) => {
            Failure::new(format!("the board ended the {part}: {fault}"), FAULT_HINT)
        }
        Ending::Board(state, None) => Failure::new(
            format!("the {part} was ended by somebody else {done}: the board was {state}"),
            "the board is disarmed now",
        ),
        Ending::Reset(report) => reset(part, &done, report.and_then(|report| report.fault)),
        Ending::Broke(error) => broke(part, &done, error),
    })
}

/// How much of it was recorded.
fn figures(recorder: &Recorder, tally: Tally) {
    let [first, second, third] = recorder.saturated;
    try_print_line(format_args!(
        "samples     {} of {}, {} missing, {} of them dropped by the board",
        recorder.log.len(),
        recorder.ticks_done(),
        recorder.missed(),
        recorder.dropped()
    ));
    try_print_line(format_args!(
        "line        {} frames came broken, {} requests were asked again",
        tally.broken, tally.asked_again
    ));
    try_print_line(format_args!(
        "limits      commands cut {first} / {second} / {third}, longest tick {:.1} us",
        f64::from(recorder.longest_tick_tenth_us) / 10.0
    ));
}

fn reset(part: &str, done: &str, fault: Option<FaultRecord>) -> Failure {
    let message = format!("the board was reset {done} of the {part}, which ended it");
    match fault {
        Some(fault) => Failure::new(format!("{message}; it is faulted: {fault}"), FAULT_HINT),
        None => Failure::new(
            message,
            "0 V since then; look at its supply and who pressed its button, and mind that \
             encoders count from zero again",
        ),
    }
}

fn broke(part: &str, done: &str, error: LinkError) -> Failure {
    let is_line = matches!(error, LinkError::Broke { .. } | LinkError::Silent { .. });
    let failure = Failure::from(error);
    let message = failure.message;
    match is_line {
        true => Failure::new(
            format!("the link broke {done} of the {part}: {message}"),
            "the board stops by itself when it hears nothing; look at the cable, then let \
             `rrr connect` tell how the board is",
        ),
        false => Failure::new(format!("the {part} was given up {done}: {message}"), failure.hint),
    }
}

/// The ending, unless only the log is lost; both where both went wrong.
///
/// # Errors
/// The worse of the two, the ending first.
pub fn worse(told: Result<(), Failure>, saved: Result<(), Failure>) -> Result<(), Failure> {
    match (told, saved) {
        (Ok(()), saved) => saved,
        (told, Ok(())) => told,
        (Err(told), Err(saved)) => Err(Failure::new(
            format!("{}; and then: {}", told.message, saved.message),
            format!("{}; {}", told.hint, saved.hint).trim_start_matches("; "),
        )),
    }
}
