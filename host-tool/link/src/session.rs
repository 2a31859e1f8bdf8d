//! A run: arm, play, follow, stop, disarm.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use firmware::link::{Command, Refusal, Report, Telemetry};
use firmware::supervisor::fault::Implausible;
use firmware::supervisor::{FaultRecord, State};

use super::client::{Client, Patience};
use super::error::LinkError;
use super::recorder::Recorder;

/// After its end a reference brakes to rest within half a second; the voltage stays so long.
const BRAKING_TICKS: u32 = 600;
/// A joint that goes less far in that many ticks is at rest.
const REST_TICKS: u32 = 200;
const REST_RAD: f64 = 0.002;
/// So long is waited for rest.
const SWINGING: Duration = Duration::from_secs(30);
/// Time between two signs of life.
const ALIVE: Duration = Duration::from_millis(100);
/// So long is waited until the estimates have settled.
const SETTLING: Duration = Duration::from_secs(5);
/// So long is waited for the first record of telemetry.
const FIRST_RECORD: Duration = Duration::from_secs(2);

/// How a run ended.
#[derive(Debug)]
pub enum Ending {
    /// The reference was played to its end.
    Finished,
    /// The user stopped it.
    Interrupted,
    /// The board ended it: a fault, or somebody else who told it to.
    Board(State, Option<FaultRecord>),
    /// The board was reset; how it is now, if it tells.
    Reset(Option<Box<Report>>),
    /// The link broke; the board stops by itself once the host is silent for too long.
    Broke(LinkError),
}

impl From<LinkError> for Ending {
    fn from(error: LinkError) -> Self {
        match &error {
            LinkError::Refused { why, .. } if **why == Refusal::HelloFirst => Self::Reset(None),
            _ => Self::Broke(error),
        }
    }
}

/// Plays the block in use and records it until its end, a fault, or `interrupted`.
///
/// Whatever happens after arming, the arm is stopped and the board disarmed, as far as the
/// link lets one; what was recorded stays in `recorder`. A board that says nothing for 1.2 s
/// is told to stop a last time, and then the link is given up.
///
/// # Errors
/// The run did not begin.
pub fn run(
    client: &mut Client,
    host_timeout_ms: u16,
    recorder: &mut Recorder,
    interrupted: &AtomicBool,
    progress: &mut dyn FnMut(u32),
) -> Result<Ending, LinkError> {
    if interrupted.load(Ordering::Relaxed) {
        return Ok(Ending::Interrupted);
    }
    client.set_patience(Patience::MOVING);
    let ending = match patiently(client, Command::Arm, interrupted) {
        // What is refused has changed nothing; else the board may be armed.
        Err(error @ LinkError::Refused { .. }) => Err(error),
        armed => {
            let ending = armed.and_then(|is_wanted| match is_wanted {
                true => play(client, host_timeout_ms, recorder, interrupted, progress),
                false => Ok(Ending::Interrupted),
            });
            end(client, recorder, ending)
        }
    };
    client.take_records().iter().for_each(|record| recorder.push(record));
    client.set_patience(Patience::USUAL);
    ending
}

/// Has an armed board run, unless the user has stopped it by now.
fn play(
    client: &mut Client,
    host_timeout_ms: u16,
    recorder: &mut Recorder,
    interrupted: &AtomicBool,
    progress: &mut dyn FnMut(u32),
) -> Result<Ending, LinkError> {
    let _ = client.take_records();
    recorder.begins_after(&client.report()?);
    if interrupted.load(Ordering::Relaxed) {
        return Ok(Ending::Interrupted);
    }
    recorder.expect_run();
    match patiently(client, Command::Run { host_timeout_ms: Some(host_timeout_ms) }, interrupted) {
        Ok(true) => {
            Ok(follow(client, recorder, interrupted, progress).unwrap_or_else(Ending::from))
        }
        Ok(false) => Ok(Ending::Interrupted),
        Err(error @ LinkError::Refused { .. }) => Err(error),
        // The answer is lost: it may run.
        Err(error) => Ok(Ending::from(error)),
    }
}

/// Orders again while estimates settle and joints come to rest, for 5 s at most. False once
/// `interrupted`; it may have been carried out then.
///
/// # Errors
/// The line is broken, the board is silent, or it says no.
pub fn patiently(
    client: &mut Client,
    command: Command<'_>,
    interrupted: &AtomicBool,
) -> Result<bool, LinkError> {
    let begin = Instant::now();
    loop {
        let result = client.order(command);
        if interrupted.load(Ordering::Relaxed) {
            return Ok(false);
        }
        match result {
            Err(LinkError::Refused { why, .. }) if passes(&why) && begin.elapsed() < SETTLING => {
                std::thread::sleep(Duration::from_millis(20));
            }
            result => return result.map(|()| true),
        }
    }
}

/// Has the board at 0 V and disarmed, as far as it can be reached; what the ending is then.
fn end(
    client: &mut Client,
    recorder: &mut Recorder,
    ending: Result<Ending, LinkError>,
) -> Result<Ending, LinkError> {
    if let Ok(Ending::Broke(error)) | Err(error) = &ending
        && !matches!(error, LinkError::Refused { .. })
    {
        client.set_patience(Patience::SHORT);
    }
    if let Ok(Ending::Reset(_)) = ending {
        return Ok(Ending::Reset(greeted(client)));
    }
    match (ending, halted(client)) {
        (Ok(ending), Ok(report)) => {
            recorder.hear(&report);
            Ok(ending)
        }
        (Ok(Ending::Finished | Ending::Interrupted), Err(error)) => match Ending::from(error) {
            Ending::Reset(_) => Ok(Ending::Reset(greeted(client))),
            ending => Ok(ending),
        },
        (ending, _) => ending,
    }
}

/// How the board is after a reset, which has taken the voltage away.
fn greeted(client: &mut Client) -> Option<Box<Report>> {
    client.greet().ok()?;
    client.report().ok().map(Box::new)
}

fn passes(why: &Refusal) -> bool {
    use Implausible::{Jumped, Moving, NotSettled};
    matches!(why, Refusal::Implausible { why: NotSettled | Moving | Jumped, .. })
}

fn follow(
    client: &mut Client,
    recorder: &mut Recorder,
    interrupted: &AtomicBool,
    progress: &mut dyn FnMut(u32),
) -> Result<Ending, LinkError> {
    let mut alive = Instant::now();
    loop {
        if interrupted.load(Ordering::Relaxed) {
            return Ok(Ending::Interrupted);
        }
        if alive.elapsed() >= ALIVE {
            alive = Instant::now();
            let report = client.report()?;
            recorder.hear(&report);
            if report.state != State::Running {
                return Ok(Ending::Board(report.state, report.fault));
            }
        }
        client.listen()?;
        client.take_records().iter().for_each(|record| recorder.push(record));
        progress(recorder.ticks_seen());
        if recorder.ticks_seen() >= recorder.ticks() + BRAKING_TICKS {
            return Ok(Ending::Finished);
        }
    }
}

/// 0 V and disarmed, whatever the state was.
///
/// # Errors
/// The line is broken or the board is silent.
pub fn halt(client: &mut Client) -> Result<State, LinkError> {
    halted(client).map(|report| report.state)
}

fn halted(client: &mut Client) -> Result<Report, LinkError> {
    for command in [Command::Stop, Command::Disarm] {
        match client.order(command) {
            // Not running, not armed: that is what is wanted.
            Ok(()) => {}
            Err(LinkError::Refused { why, .. }) if matches!(*why, Refusal::NotNow { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    client.report()
}

/// Waits until no joint moves; the last record, or the newest one once `interrupted`.
///
/// # Errors
/// The line is broken, no telemetry comes, or a joint goes on moving.
pub fn rest(
    client: &mut Client,
    counts_per_turn: u32,
    interrupted: &AtomicBool,
) -> Result<Telemetry, LinkError> {
    let begin = Instant::now();
    let mut before = next_record(client)?;
    loop {
        let now = next_record(client)?;
        let moved_rad = [0, 1, 2].map(|i| {
            let counts = now.counts[i].wrapping_sub(before.counts[i]);
            f64::from(counts).abs() * TAU / f64::from(counts_per_turn)
        });
        let moving = (1..=3).zip(moved_rad).find(|(_, moved_rad)| *moved_rad > REST_RAD);
        match moving {
            _ if interrupted.load(Ordering::Relaxed) => return Ok(now),
            Some((joint, moved_rad)) if begin.elapsed() > SWINGING => {
                let waited_s = SWINGING.as_secs_f64();
                return Err(LinkError::NotAtRest { joint, moved_rad, waited_s });
            }
            Some(_) => before = now,
            None if now.sequence.wrapping_sub(before.sequence) >= REST_TICKS => return Ok(now),
            None => {}
        }
    }
}

/// The next record of telemetry, once `Stream` has asked for it.
///
/// # Errors
/// The line is broken, or none comes.
pub fn next_record(client: &mut Client) -> Result<Telemetry, LinkError> {
    let begin = Instant::now();
    let _ = client.take_records();
    while begin.elapsed() < FIRST_RECORD {
        client.listen()?;
        if let Some(record) = client.take_records().pop() {
            return Ok(record);
        }
    }
    Err(LinkError::NoTelemetry { waited_s: FIRST_RECORD.as_secs_f64() })
}
