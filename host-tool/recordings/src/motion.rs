//! Motion and command of all joints, on one clock and at the same instants.

use model::vector::Vector3;

use crate::StepError;
use crate::campaign::Trace;
use crate::unbroken::unbroken;
use signal::{LowPass, derivative};

/// At which instants of a sample interval motion and command are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instant {
    /// At the sample, as the paper does; the command of the row only begins there.
    Sample,
    /// In the middle of the interval that the command acts over.
    Middle,
}

/// Smoothed motion of the three joints over an unbroken stretch of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Time of the first instant [s].
    pub start_s: f64,
    /// Time from instant to instant [s].
    pub period_s: f64,
    /// Angles [rad].
    pub q_rad: [Vec<f64>; 3],
    /// Velocities [rad/s].
    pub qd_rad_per_s: [Vec<f64>; 3],
    /// Accelerations [rad/s^2].
    pub qdd_rad_per_s2: [Vec<f64>; 3],
    /// Commanded voltages [V], not smoothed.
    pub command_v: [Vec<f64>; 3],
}

impl Motion {
    /// The unbroken stretches of a log, of one second at least.
    ///
    /// Samples at uneven times are interpolated onto an even clock; a stretch ends where
    /// samples are missing.
    ///
    /// # Errors
    /// The log lacks a joint, or is nowhere unbroken for a second.
    pub fn stretches(
        trace: &Trace,
        cutoff_hz: f64,
        instant: Instant,
    ) -> Result<Vec<Self>, StepError> {
        let unusable =
            |what: &str| StepError::Unusable { file: trace.file.clone(), what: what.into() };
        for number in 1..=3 {
            if trace.joint(number).is_none() {
                let what = format!("joint {number} is not in the log; record all three joints");
                return Err(unusable(&what));
            }
        }
        let shortest = (1.0 / trace.period_s).ceil() as usize;
        let stretches: Vec<Self> = unbroken(&trace.time_s, LONGEST_GAP_PERIODS * trace.period_s)
            .into_iter()
            .filter(|range| range.len() > shortest)
            .map(|range| Self::of_range(trace, range, cutoff_hz, instant))
            .collect();
        if stretches.is_empty() {
            return Err(unusable("no second without missing samples; record it again"));
        }
        Ok(stretches)
    }

    fn of_range(
        trace: &Trace,
        range: std::ops::Range<usize>,
        cutoff_hz: f64,
        instant: Instant,
    ) -> Self {
        let time_s = &trace.time_s[range.clone()];
        // The mean of this stretch: a typical period is rounded, which adds up.
        let period_s = (time_s[time_s.len() - 1] - time_s[0]) / (time_s.len() - 1) as f64;
        let filter = LowPass::new(cutoff_hz, period_s);
        let mut motion = Self {
            start_s: time_s[0],
            period_s,
            q_rad: Default::default(),
            qd_rad_per_s: Default::default(),
            qdd_rad_per_s2: Default::default(),
            command_v: Default::default(),
        };
        for joint in trace.joints.iter().filter(|joint| (1..=3).contains(&joint.number)) {
            let index = usize::from(joint.number) - 1;
            let even = on_even_clock(time_s, &joint.q_rad[range.clone()], period_s);
            let q = filter.zero_phase(&even);
            let at_instant = |signal: Vec<f64>| match instant {
                Instant::Sample => signal,
                Instant::Middle => derivative::midpoints(&signal),
            };
            motion.qd_rad_per_s[index] = at_instant(derivative::first(&q, period_s));
            motion.qdd_rad_per_s2[index] = at_instant(derivative::second(&q, period_s));
            motion.q_rad[index] = at_instant(q);
            motion.command_v[index] =
                held_on_even_clock(time_s, &joint.command_v[range.clone()], period_s);
        }
        if instant == Instant::Middle {
            motion.start_s += 0.5 * period_s;
        }
        motion
    }

    /// How many instants there are.
    pub fn len(&self) -> usize {
        self.q_rad[0].len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Angles, velocities and accelerations at an instant.
    pub fn state(&self, k: usize) -> (Vector3<f64>, Vector3<f64>, Vector3<f64>) {
        let at = |signal: &[Vec<f64>; 3]| [0, 1, 2].map(|joint| signal[joint][k]);
        (at(&self.q_rad), at(&self.qd_rad_per_s), at(&self.qdd_rad_per_s2))
    }
}

/// Time between two samples that have none between them, in periods at most.
const LONGEST_GAP_PERIODS: f64 = 1.6;
/// Part of a period by which samples may miss an even clock and still count as even.
const EVEN: f64 = 0.02;

/// Whether samples lie on an even clock.
fn is_even(time_s: &[f64], period_s: f64) -> bool {
    let deviation = |(k, t): (usize, &f64)| (t - time_s[0] - k as f64 * period_s).abs();
    time_s.iter().enumerate().map(deviation).fold(0.0, f64::max) < EVEN * period_s
}

/// A sampled signal at even times, straight lines between the samples.
fn on_even_clock(time_s: &[f64], signal: &[f64], period_s: f64) -> Vec<f64> {
    interpolated(time_s, signal, period_s, |a, b, fraction| a + (b - a) * fraction)
}

/// A signal that is held between its samples, at even times.
fn held_on_even_clock(time_s: &[f64], signal: &[f64], period_s: f64) -> Vec<f64> {
    interpolated(
        time_s,
        signal,
        period_s,
        |a, b, fraction| if fraction < 1.0 - EVEN { a } else { b },
    )
}

fn interpolated(
    time_s: &[f64],
    signal: &[f64],
    period_s: f64,
    between: impl Fn(f64, f64, f64) -> f64,
) -> Vec<f64> {
    if is_even(time_s, period_s) {
        return signal.to_vec();
    }
    let last = time_s.len() - 1;
    let count = ((time_s[last] - time_s[0]) / period_s + EVEN).floor() as usize + 1;
    let mut k = 0;
    let at = |index: usize| {
        let t = time_s[0] + index as f64 * period_s;
        while k + 2 < time_s.len() && time_s[k + 1] <= t {
            k += 1;
        }
        let fraction = ((t - time_s[k]) / (time_s[k + 1] - time_s[k])).clamp(0.0, 1.0);
        between(signal[k], signal[k + 1], fraction)
    };
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::JointTrace;
    use files::{Experiment, Role};

    /// Joints that swing at 1 Hz, sampled at given times.
    fn swinging(time_s: Vec<f64>) -> Trace {
        let swing = |t: &f64| (std::f64::consts::TAU * t).sin();
        let joint = |number| JointTrace {
            number,
            q_rad: time_s.iter().map(swing).collect(),
            command_v: time_s.clone(),
            reference_rad: None,
        };
        Trace {
            file: "swing.csv".into(),
            experiment: Experiment::Excitation,
            role: Role::Train,
            joint: None,
            period_s: 1e-3,
            joints: (1..=3).map(joint).collect(),
            time_s,
        }
    }

    /// Largest error of the acceleration of joint 2, away from the ends [rad/s^2].
    fn acceleration_error(motion: &Motion) -> f64 {
        let w = std::f64::consts::TAU;
        let error = |k: usize| {
            let t = motion.start_s + k as f64 * motion.period_s;
            (motion.qdd_rad_per_s2[1][k] + w * w * (w * t).sin()).abs()
        };
        (200..motion.len() - 200).map(error).fold(0.0, f64::max)
    }

    #[test]
    fn the_middle_of_an_interval_is_half_a_period_late() {
        let trace = swinging((0..3000).map(|k| f64::from(k) * 1e-3).collect());
        for instant in [Instant::Sample, Instant::Middle] {
            let motion = Motion::stretches(&trace, 50.0, instant).unwrap().remove(0);
            assert!(acceleration_error(&motion) < 1e-4 * 39.5, "{instant:?}");
        }
    }

    #[test]
    fn uneven_samples_are_brought_to_an_even_clock() {
        let jitter = |k: i32| f64::from(k) * 1e-3 + 2e-4 * f64::from(k * 7919 % 11) / 11.0;
        let motion =
            Motion::stretches(&swinging((0..3000).map(jitter).collect()), 20.0, Instant::Middle);
        assert!(acceleration_error(&motion.unwrap()[0]) < 0.01 * 39.5);
    }

    #[test]
    fn a_period_that_rounding_changed_is_even() {
        let rounded = f64::from(0.001f32) + 3e-12;
        let trace = swinging((0..30_000).map(|k| f64::from(k) * rounded).collect());
        let motion = Motion::stretches(&trace, 50.0, Instant::Middle).unwrap().remove(0);
        assert_eq!(motion.command_v[0], trace.time_s);
    }

    #[test]
    fn missing_samples_break_a_log_into_stretches() {
        let gap = |k: i32| f64::from(k) * 1e-3 + if k < 1500 { 0.0 } else { 0.02 };
        let trace = swinging((0..3000).map(gap).collect());
        let stretches = Motion::stretches(&trace, 50.0, Instant::Middle).unwrap();
        assert_eq!(stretches.iter().map(Motion::len).collect::<Vec<_>>(), [1500, 1500]);
        let broken = swinging((0..3000).map(|k| f64::from(k + k / 100) * 1e-3).collect());
        let error = Motion::stretches(&broken, 50.0, Instant::Middle).unwrap_err();
        assert!(error.to_string().contains("without missing samples"), "{error}");
    }
}
