//! A run: arm, play, follow, stop, disarm.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use firmware::link::{Command, Refusal, Telemetry};
use firmware::supervisor::fault::Implausible;
use firmware::supervisor::{FaultRecord, State};

use super::client::Client;
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
    /// The link broke; the board stops by itself once the host is silent for too long.
    Broke(LinkError),
}

/// Plays the block in use and records it until its end, a fault, or `interrupted`.
///
/// Whatever happens after arming, the arm is stopped and the board disarmed, as far as the
/// link lets one; what was recorded stays in `recorder`.
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
    arm(client, interrupted)?;
    let _ = client.take_records();
    if let Err(error) = client.order(Command::Run { host_timeout_ms: Some(host_timeout_ms) }) {
        let _ = halt(client);
        return Err(error);
    }
    let ending = follow(client, recorder, interrupted, progress).unwrap_or_else(Ending::Broke);
    let halted = halt(client);
    client.take_records().iter().for_each(|record| recorder.push(record));
    Ok(match (ending, halted) {
        (Ending::Finished | Ending::Interrupted, Err(error)) => Ending::Broke(error),
        (ending, _) => ending,
    })
}

/// Arms the board; waits while its estimates settle and the joints come to rest.
fn arm(client: &mut Client, interrupted: &AtomicBool) -> Result<(), LinkError> {
    let begin = Instant::now();
    loop {
        match client.order(Command::Arm) {
            Err(LinkError::Refused { why, .. })
                if passes(&why)
                    && begin.elapsed() < SETTLING
                    && !interrupted.load(Ordering::Relaxed) =>
            {
                std::thread::sleep(Duration::from_millis(20));
            }
            result => return result,
        }
    }
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
    for command in [Command::Stop, Command::Disarm] {
        match client.order(command) {
            // Not running, not armed: that is what is wanted.
            Ok(()) => {}
            Err(LinkError::Refused { why, .. }) if matches!(*why, Refusal::NotNow { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(client.report()?.state)
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
