//! The samples of a log as a stretch, on an even clock no faster than a motion needs.

use std::ops::Range;

use super::bristle_path::path_rad;
use super::even_clock::EvenClock;
use super::kinematics::postures_for;
use super::sampling_jitter::Roughness;
use super::stretch::{Stretch, rms_above};
use super::subject::Subject;
use crate::criteria::LogCriteria;
use recordings::Trace;
use signal::{LowPass, derivative};

/// The samples of a log in a range as a stretch.
pub fn recorded(trace: &Trace, log: usize, subject: &Subject, range: Range<usize>) -> Stretch {
    let criteria = &subject.criteria.logs;
    let time_s = &trace.time_s[range.clone()];
    let fine = EvenClock::over(time_s, trace.period_s, criteria);
    let broadband = drives_broadband(trace, &fine, &range, criteria);
    let clock = fine.coarser(samples_taken_together(fine.period_s(), broadband, criteria));
    let mut stretch = Stretch {
        start_s: time_s[0] - trace.time_s[0],
        sampled_s: fine.period_s(),
        broadband,
        ..Stretch::empty(log, trace.role, clock.period_s(), subject.plant.joints())
    };
    let mut angles = vec![Vec::new(); subject.plant.joints()];
    for (&joint, &number) in subject.joints.iter().zip(&subject.numbers) {
        let Some(columns) = trace.joint(number) else { continue };
        let even = fine.smooth(&columns.q_rad[range.clone()]);
        let step_rad = subject.encoder_step_rad[joint];
        stretch.roughness[joint] = Roughness::of(&even, fine.period_s(), step_rad, criteria);
        angles[joint] = thinned(even, &fine, &clock, criteria);
        stretch.command_v[joint] = clock.held_mean(&columns.command_v[range.clone()]);
        stretch.settled[joint] = settled(&angles[joint], subject, joint);
    }
    for &joint in subject.joints.iter().filter(|&&joint| !angles[joint].is_empty()) {
        let cutoff_hz = motion_cutoff_hz(&angles[joint], joint, &stretch, subject);
        stretch.motion.set(joint, &angles[joint], clock.period_s(), cutoff_hz);
        // A joint that noise drives does not stand, and without a gear it swings about where it stands.
        if !broadband && subject.plant.as_chain().is_some() {
            let noise_rad =
                smoothed_steps_rad(subject.encoder_step_rad[joint], cutoff_hz, stretch.sampled_s);
            stretch.at_rest_rad[joint] = criteria.at_rest_part * noise_rad;
        }
    }
    fill_absent(&mut stretch);
    stretch.postures = postures_for(&subject.plant, &stretch.motion);
    stretch
}

/// What is left of an encoder's steps, white noise at the rate of its samples, below a cut-off, rms [rad].
fn smoothed_steps_rad(step_rad: f64, cutoff_hz: f64, sampled_s: f64) -> f64 {
    let part_below = (2.0 * cutoff_hz * sampled_s).min(1.0);
    step_rad * (part_below / 12.0).sqrt()
}

/// Whether any command of a log drives the joints at high frequencies in a range.
fn drives_broadband(
    trace: &Trace,
    clock: &EvenClock,
    range: &Range<usize>,
    criteria: &LogCriteria,
) -> bool {
    trace.joints.iter().any(|columns| {
        let command = clock.held_mean(&columns.command_v[range.clone()]);
        is_broadband(&command, clock.period_s(), criteria)
    })
}

/// Joints that the rig does not have hang still.
fn fill_absent(stretch: &mut Stretch) {
    let count = stretch.command_v.iter().map(Vec::len).max().unwrap_or(0);
    for joint in 0..stretch.command_v.len() {
        if stretch.command_v[joint].is_empty() {
            stretch.command_v[joint] = vec![0.0; count];
            stretch.motion.raw_rad[joint] = vec![Subject::resting_rad(joint); count];
            stretch.motion.q_rad[joint] = vec![Subject::resting_rad(joint); count];
            stretch.motion.qd_rad_per_s[joint] = vec![0.0; count];
            stretch.motion.qdd_rad_per_s2[joint] = vec![0.0; count];
        }
    }
}

/// Cut-off that keeps what the encoder's steps add to the velocity to a small part of it.
fn motion_cutoff_hz(q_rad: &[f64], joint: usize, stretch: &Stretch, subject: &Subject) -> f64 {
    let Stretch { period_s, broadband, .. } = *stretch;
    let criteria = &subject.criteria.logs;
    let highest_hz = if broadband { criteria.broadband_cutoff_hz } else { criteria.calm_cutoff_hz };
    let highest_hz = highest_hz.min(criteria.fast_part / period_s);
    let speed = signal::rms(&derivative::first(q_rad, period_s));
    let noise_rad = subject.encoder_step_rad[joint] / 12f64.sqrt();
    // Noise of the velocity up to f: 2 pi noise sqrt(2 period / 3) f^(3/2).
    let unit = std::f64::consts::TAU * noise_rad * (2.0 * period_s / 3.0).sqrt();
    let wanted_hz = (criteria.velocity_noise_part * speed / unit).powf(2.0 / 3.0);
    wanted_hz.clamp(criteria.lowest_cutoff_hz.min(highest_hz), highest_hz)
}

/// How many samples of a fast log are taken together: more than a motion shows costs time alone.
fn samples_taken_together(period_s: f64, broadband: bool, criteria: &LogCriteria) -> usize {
    let shortest_s =
        if broadband { criteria.shortest_period_s } else { criteria.shortest_calm_period_s };
    ((shortest_s / period_s + 0.05) as usize).max(1)
}

/// Angles of a fast log on a coarser clock, without what that would fold back.
fn thinned(
    even: Vec<f64>,
    fine: &EvenClock,
    coarse: &EvenClock,
    criteria: &LogCriteria,
) -> Vec<f64> {
    if coarse.period_s() < 1.5 * fine.period_s() {
        return even;
    }
    let cutoff_hz = criteria.thinned_cutoff_part / coarse.period_s();
    let smooth = LowPass::new(cutoff_hz, fine.period_s()).zero_phase(&even);
    let time_s: Vec<f64> = (0..smooth.len()).map(|k| fine.instant(k)).collect();
    coarse.of_signal_at(&time_s, &smooth)
}

/// Whether a good part of a command lies at high frequencies.
fn is_broadband(command_v: &[f64], period_s: f64, criteria: &LogCriteria) -> bool {
    let above_hz = criteria.broadband_above_hz;
    period_s * above_hz <= criteria.fast_part
        && rms_above(command_v, period_s, above_hz)
            > criteria.broadband_part * signal::rms(command_v)
}

/// The first sample when a joint has come so far that its friction no longer depends on how its
/// bristles were bent before. A joint that never comes so far counts from its first sample.
fn settled(q_rad: &[f64], subject: &Subject, joint: usize) -> usize {
    let path_rad = path_rad(&subject.plant.friction[joint], subject.criteria.logs.settled_bends);
    let gone = |q: &f64| (q - q_rad[0]).abs() > path_rad;
    q_rad.iter().position(gone).unwrap_or(0)
}
