//! A part of the logs.

use crate::judged::Judged;

/// Logs of about so many seconds in all, spread over the list.
pub fn spread<'a>(logs: &[&'a Judged], seconds: f64) -> Vec<&'a Judged> {
    let length = |log: &&Judged| log.record.time_s.last().unwrap_or(&0.0) - log.record.time_s[0];
    let all: f64 = logs.iter().map(length).sum();
    let every = (all / seconds).ceil().max(1.0) as usize;
    let least = every.min(logs.len().div_ceil(6)).max(1);
    logs.iter().copied().step_by(least).collect()
}
