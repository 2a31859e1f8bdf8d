//! A run: arm, start, record, stop, disarm.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use firmware::link::{Command, Refusal, Report};
use firmware::supervisor::{FaultRecord, State};

use super::client::Client;
use super::connection::RetryPolicy;
use super::error::LinkError;
use super::recorder::Recorder;
use super::settling::execute_once_settled;
use super::stop::stop_and_disarm;

/// After its end a reference brakes to rest within half a second; the voltage stays so long.
const BRAKING_TICKS: u32 = 600;
/// Time between two requests that keep the run alive.
const HEARTBEAT_PERIOD: Duration = Duration::from_millis(100);

/// Sees a run while it goes on.
pub trait RunWatcher {
    /// Records have come, which the recorder has taken.
    fn see(&mut self, recorder: &Recorder);
    /// The board has told how it is.
    fn see_report(&mut self, report: &Report);
}

/// Nobody looks.
impl RunWatcher for () {
    fn see(&mut self, _: &Recorder) {}

    fn see_report(&mut self, _: &Report) {}
}

/// How a run ended.
#[derive(Debug)]
pub enum RunOutcome {
    /// The reference was played to its end.
    Finished,
    /// The user stopped it.
    Interrupted,
    /// The board ended it: by a fault, or because another host stopped it.
    EndedByBoard(State, Option<FaultRecord>),
    /// The board was reset; its report afterwards, if it answers.
    BoardReset(Option<Box<Report>>),
    /// The link was lost; the board stops by itself once the host is silent for too long.
    LinkLost(LinkError),
}

impl From<LinkError> for RunOutcome {
    fn from(error: LinkError) -> Self {
        match &error {
            LinkError::Refused { why, .. } if **why == Refusal::HelloFirst => {
                Self::BoardReset(None)
            }
            _ => Self::LinkLost(error),
        }
    }
}

/// Plays the block in use and records it until its end, a fault, or `interrupted`.
///
/// Whatever happens after arming, the arm is stopped and the board disarmed, as far as the
/// link lets one; what was recorded stays in `recorder`. A board that is silent for 1.2 s
/// gets a last stop command, and then the link is given up.
///
/// # Errors
/// The run did not begin.
pub fn run(
    client: &mut Client,
    host_timeout_ms: u16,
    recorder: &mut Recorder,
    interrupted: &AtomicBool,
    watcher: &mut dyn RunWatcher,
) -> Result<RunOutcome, LinkError> {
    if interrupted.load(Ordering::Relaxed) {
        return Ok(RunOutcome::Interrupted);
    }
    client.set_retry_policy(RetryPolicy::WHILE_MOVING);
    let outcome = match execute_once_settled(client, Command::Arm, interrupted) {
        // What is refused has changed nothing; else the board may be armed.
        Err(error @ LinkError::Refused { .. }) => Err(error),
        armed => {
            let outcome = armed.and_then(|is_armed| match is_armed {
                true => start(client, host_timeout_ms, recorder, interrupted, watcher),
                false => Ok(RunOutcome::Interrupted),
            });
            finish(client, recorder, outcome)
        }
    };
    client.take_records().iter().for_each(|record| recorder.add_record(record));
    watcher.see(recorder);
    client.set_retry_policy(RetryPolicy::DEFAULT);
    outcome
}

/// Starts an armed board, unless the user has interrupted by now.
fn start(
    client: &mut Client,
    host_timeout_ms: u16,
    recorder: &mut Recorder,
    interrupted: &AtomicBool,
    watcher: &mut dyn RunWatcher,
) -> Result<RunOutcome, LinkError> {
    let _ = client.take_records();
    recorder.begins_after(&client.report()?);
    if interrupted.load(Ordering::Relaxed) {
        return Ok(RunOutcome::Interrupted);
    }
    recorder.expect_run();
    match execute_once_settled(
        client,
        Command::Run { host_timeout_ms: Some(host_timeout_ms) },
        interrupted,
    ) {
        Ok(true) => Ok(record_until_end(client, recorder, interrupted, watcher)
            .unwrap_or_else(RunOutcome::from)),
        Ok(false) => Ok(RunOutcome::Interrupted),
        Err(error @ LinkError::Refused { .. }) => Err(error),
        // The answer is lost: it may run.
        Err(error) => Ok(RunOutcome::from(error)),
    }
}

/// Stops and disarms the board, as far as it can be reached; the outcome is then known.
fn finish(
    client: &mut Client,
    recorder: &mut Recorder,
    outcome: Result<RunOutcome, LinkError>,
) -> Result<RunOutcome, LinkError> {
    if let Ok(RunOutcome::LinkLost(error)) | Err(error) = &outcome
        && !matches!(error, LinkError::Refused { .. })
    {
        client.set_retry_policy(RetryPolicy::LAST_ATTEMPT);
    }
    if let Ok(RunOutcome::BoardReset(_)) = outcome {
        return Ok(RunOutcome::BoardReset(report_after_reset(client)));
    }
    match (outcome, stop_and_disarm(client)) {
        (Ok(outcome), Ok(report)) => {
            recorder.add_report(&report);
            Ok(outcome)
        }
        (Ok(RunOutcome::Finished | RunOutcome::Interrupted), Err(error)) => {
            match RunOutcome::from(error) {
                RunOutcome::BoardReset(_) => Ok(RunOutcome::BoardReset(report_after_reset(client))),
                outcome => Ok(outcome),
            }
        }
        (outcome, _) => outcome,
    }
}

/// The report after a reset, which has taken the voltage away.
fn report_after_reset(client: &mut Client) -> Option<Box<Report>> {
    client.handshake().ok()?;
    client.report().ok().map(Box::new)
}

fn record_until_end(
    client: &mut Client,
    recorder: &mut Recorder,
    interrupted: &AtomicBool,
    watcher: &mut dyn RunWatcher,
) -> Result<RunOutcome, LinkError> {
    let mut last_report = Instant::now();
    loop {
        if interrupted.load(Ordering::Relaxed) {
            return Ok(RunOutcome::Interrupted);
        }
        if last_report.elapsed() >= HEARTBEAT_PERIOD {
            last_report = Instant::now();
            let report = client.report()?;
            recorder.add_report(&report);
            watcher.see_report(&report);
            if report.state != State::Running {
                return Ok(RunOutcome::EndedByBoard(report.state, report.fault));
            }
        }
        client.receive()?;
        client.take_records().iter().for_each(|record| recorder.add_record(record));
        watcher.see(recorder);
        if recorder.ticks_seen() >= recorder.ticks() + BRAKING_TICKS {
            return Ok(RunOutcome::Finished);
        }
    }
}
