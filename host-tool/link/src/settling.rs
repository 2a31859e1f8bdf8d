//! Waiting for the arm: until it rests, and until the board's estimates have settled.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use firmware::link::{Command, Refusal, Telemetry};
use firmware::supervisor::fault::Implausible;

use super::client::Client;
use super::error::LinkError;

/// A joint that moves less than [`REST_RAD`] in that many ticks is at rest.
const REST_TICKS: u32 = 200;
const REST_RAD: f64 = 0.002;
const REST_TIMEOUT: Duration = Duration::from_secs(30);
const SETTLING_TIMEOUT: Duration = Duration::from_secs(5);
const TELEMETRY_TIMEOUT: Duration = Duration::from_secs(2);

/// Repeats a command while estimates settle and joints come to rest, for 5 s at most. False
/// once `interrupted`; it may have been carried out then.
///
/// # Errors
/// The line is broken, the board does not answer, or it refuses.
pub fn execute_once_settled(
    client: &mut Client,
    command: Command<'_>,
    interrupted: &AtomicBool,
) -> Result<bool, LinkError> {
    let begin = Instant::now();
    loop {
        let result = client.execute(command);
        if interrupted.load(Ordering::Relaxed) {
            return Ok(false);
        }
        match result {
            Err(LinkError::Refused { why, .. })
                if is_transient(&why) && begin.elapsed() < SETTLING_TIMEOUT =>
            {
                std::thread::sleep(Duration::from_millis(20));
            }
            result => return result.map(|()| true),
        }
    }
}

fn is_transient(why: &Refusal) -> bool {
    use Implausible::{Jumped, Moving, NotSettled};
    matches!(why, Refusal::Implausible { why: NotSettled | Moving | Jumped, .. })
}

/// Waits until no joint moves; the last record, or the newest one once `interrupted`.
///
/// # Errors
/// The line is broken, no telemetry comes, or a joint goes on moving.
pub fn wait_for_rest(
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
            Some((joint, moved_rad)) if begin.elapsed() > REST_TIMEOUT => {
                let waited_s = REST_TIMEOUT.as_secs_f64();
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
    while begin.elapsed() < TELEMETRY_TIMEOUT {
        client.receive()?;
        if let Some(record) = client.take_records().pop() {
            return Ok(record);
        }
    }
    Err(LinkError::NoTelemetry { waited_s: TELEMETRY_TIMEOUT.as_secs_f64() })
}
