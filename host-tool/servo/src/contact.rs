//! Seconds in which the arm pushes against something.
//!
//! Free joints err by friction and timing, one at a time and while they move. Where the arm leans
//! on a table several joints stand still away from where their goals would take them, together.

use diagnosis::Contact;

use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::settings::Settings;

/// A robust standard deviation: 1.48 times the median of the sizes.
pub fn robust_deviation(sizes: &mut [f64]) -> f64 {
    sizes.sort_by(f64::total_cmp);
    1.48 * sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
}

/// The contacts of a log, from what a model leaves of it, `errors[joint][row]`, and the deviations
/// of joints.
pub fn contacts(
    judged: &Judged,
    errors: &[Vec<f64>],
    deviations: &[f64],
    settings: &Settings,
) -> Vec<Contact> {
    let time = &judged.record.time_s;
    let mut found: Vec<(Contact, f64)> = Vec::new();
    let mut from = 0;
    while from < time.len() {
        let to = time[from..].partition_point(|t| *t - time[from] < settings.contact_s) + from;
        if let Some((joint, size)) = held(judged, errors, deviations, from..to, settings) {
            let margin = settings.contact_margin_s;
            let seconds = [time[from] - margin, time[to - 1] + margin];
            let size = size * (time[to - 1] - time[from]);
            match found.last_mut() {
                Some((last, sum)) if seconds[0] <= last.seconds[1] => {
                    last.seconds[1] = seconds[1];
                    *sum += size;
                }
                _ => {
                    let file = judged.record.file.clone();
                    found.push((Contact { file, seconds, joint: joint as u8 + 1 }, size));
                }
            }
        }
        from = to;
    }
    let long = |found: &(Contact, f64)| found.1 >= settings.contact_deviation_seconds;
    found.into_iter().filter(long).map(|found| found.0).collect()
}

/// The joint furthest off in rows in which at least two slow joints are, and by how much all are.
fn held(
    judged: &Judged,
    errors: &[Vec<f64>],
    deviations: &[f64],
    rows: std::ops::Range<usize>,
    settings: &Settings,
) -> Option<(usize, f64)> {
    let mut off: Vec<(f64, usize)> = Vec::new();
    for (joint, track) in judged.record.joints.iter().enumerate() {
        let n = rows.len() as f64;
        let speed = track.velocity[rows.clone()].iter().map(|v| v.abs()).sum::<f64>() / n;
        let error = errors[joint][rows.clone()].iter().sum::<f64>().abs() / n;
        let size = error / deviations[joint].max(1e-9);
        if speed < settings.contact_speed && size > settings.contact_deviations {
            off.push((size, joint));
        }
    }
    let furthest = off.iter().max_by(|a, b| a.0.total_cmp(&b.0))?.1;
    let together: f64 = off.iter().map(|joint| joint.0).sum();
    (off.len() >= 2).then_some((furthest, together))
}

/// Takes the rows of contacts out of what counts, for all joints.
pub fn cut(judged: &mut Judged, contacts: &[Contact]) {
    for contact in contacts.iter().filter(|contact| contact.file == judged.record.file) {
        let inside = |t: f64| t >= contact.seconds[0] && t <= contact.seconds[1];
        for (row, t) in judged.record.time_s.iter().enumerate() {
            if inside(*t) {
                judged.counts.iter_mut().for_each(|joint| joint[row] = false);
            }
        }
    }
}

/// Deviations of all joints over logs, from what models leave; none so small that a joint that
/// rests elsewhere within its friction is an outlier, though it stood still in most logs.
pub fn deviations(logs: &[&Judged], servos: &[ServoJoint], step_s: f64) -> Vec<f64> {
    let of = |(joint, servo): (usize, &ServoJoint)| {
        let left = logs.iter().flat_map(|log| crate::fit::errors(servo, log, joint, step_s));
        let found = robust_deviation(&mut left.map(f64::abs).collect::<Vec<_>>());
        let rest = PART_OF_REST * servo.coulomb / servo.stiffness.max(1e-9);
        found.max(rest).max(LEAST_DEVIATION)
    };
    servos.iter().enumerate().map(of).collect()
}

/// A deviation is at least this part of how far from its goal friction holds a joint: four of them
/// are half of that.
const PART_OF_REST: f64 = 0.125;

/// The least deviation [rad]: less than two steps of a hobby servo's encoder.
const LEAST_DEVIATION: f64 = 2.5e-3;
