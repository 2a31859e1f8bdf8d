//! Unbroken motion with its commands, prepared once for all models that are tried.
//!
//! A command acts over the interval from its sample to the next. So everything that
//! drives the motor belongs to intervals, and accelerations belong to samples: the second
//! difference of sampled positions is exactly the mean of the accelerations in the two
//! intervals about it, whatever the frequency.

use model::Posture;
use model::chain::MAX_JOINTS;

use std::ops::Range;
use std::sync::OnceLock;

use super::even_clock::EvenClock;
use super::sampling_jitter::Roughness;
use super::subject::Subject;
use crate::criteria::LogCriteria;
use files::Role;
use recordings::{Trace, unbroken};
use rig::Plant;
use signal::{LowPass, derivative};

/// A joint's value at an instant, joint by joint; those that the rig lacks are zero.
pub type Joints = [f64; MAX_JOINTS];

/// Angles of the joints and their derivatives, joint by joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kinematics {
    /// Angles as measured [rad].
    pub raw_rad: Vec<Vec<f64>>,
    /// Angles, smoothed [rad].
    pub q_rad: Vec<Vec<f64>>,
    /// Velocities [rad/s].
    pub qd_rad_per_s: Vec<Vec<f64>>,
    /// Accelerations [rad/s^2].
    pub qdd_rad_per_s2: Vec<Vec<f64>>,
}

impl Kinematics {
    /// Of so many joints, with no sample yet.
    pub fn of_joints(joints: usize) -> Self {
        let none = vec![Vec::new(); joints];
        Self {
            raw_rad: none.clone(),
            q_rad: none.clone(),
            qd_rad_per_s: none.clone(),
            qdd_rad_per_s2: none,
        }
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        self.q_rad.len()
    }

    /// Angles, velocities, accelerations of three joints at an instant.
    #[inline]
    pub fn of_three(&self, k: usize) -> ([f64; 3], [f64; 3], [f64; 3]) {
        let at = |signal: &[Vec<f64>]| [signal[0][k], signal[1][k], signal[2][k]];
        (at(&self.q_rad), at(&self.qd_rad_per_s), at(&self.qdd_rad_per_s2))
    }

    /// Angles, velocities, accelerations at an instant.
    #[inline]
    pub fn state(&self, k: usize) -> [Joints; 3] {
        let at = |signal: &[Vec<f64>]| {
            let mut values = Joints::default();
            values.iter_mut().zip(signal).for_each(|(value, signal)| *value = signal[k]);
            values
        };
        [at(&self.q_rad), at(&self.qd_rad_per_s), at(&self.qdd_rad_per_s2)]
    }
}

/// Angles and velocities of all joints in the middle of every interval, joint after joint, interval
/// after interval.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Middles {
    joints: usize,
    q_rad: Vec<f64>,
    qd_rad_per_s: Vec<f64>,
}

impl Middles {
    /// Those of a motion.
    pub fn of(motion: &Kinematics) -> Self {
        let joints = motion.joints();
        let between = |signals: &[Vec<f64>]| {
            let count = signals[0].len();
            let mut all = vec![0.0; joints * count];
            for (joint, signal) in signals.iter().enumerate() {
                for k in 0..count {
                    let next = (k + 1).min(count - 1);
                    all[joints * k + joint] = 0.5 * (signal[k] + signal[next]);
                }
            }
            all
        };
        Self { joints, q_rad: between(&motion.q_rad), qd_rad_per_s: between(&motion.qd_rad_per_s) }
    }

    /// Angles and velocities in the interval after a sample.
    #[inline]
    pub fn at(&self, k: usize) -> (&[f64], &[f64]) {
        let range = self.joints * k..self.joints * (k + 1);
        (&self.q_rad[range.clone()], &self.qd_rad_per_s[range])
    }
}

/// An unbroken stretch of a log.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Index of the log in the data set.
    pub log: usize,
    /// What the log is for.
    pub role: Role,
    /// Time of the first sample since the log began [s].
    pub start_s: f64,
    /// Time from sample to sample [s].
    pub period_s: f64,
    /// The same of the log, of which several samples may have been taken together [s].
    pub sampled_s: f64,
    /// Motion at the samples.
    pub motion: Kinematics,
    /// Command over the interval that begins at each sample [V].
    pub command_v: Vec<Vec<f64>>,
    /// Sines and cosines of the measured motion, where the closed form takes them.
    pub postures: Vec<Posture<f64>>,
    /// Angles and velocities in the middle of the intervals, once asked for.
    pub middles: OnceLock<Middles>,
    /// Whether the commands drive the joints at high frequencies.
    pub broadband: bool,
    /// First sample of each joint from which the bend of its bristles is known.
    pub settled: Vec<usize>,
    /// Samples too near to one that was lost; empty where none matters.
    pub unseen: Vec<bool>,
    /// How rough the angles of each joint are from sample to sample.
    pub roughness: Vec<Roughness>,
}

impl Stretch {
    /// The stretches of a log that holds all joints of the rig.
    pub fn of(trace: &Trace, log: usize, subject: &Subject) -> Vec<Self> {
        let criteria = &subject.criteria.logs;
        let whole = |longest_s: f64| {
            let is_long = |range: &Range<usize>| {
                trace.time_s[range.end - 1] - trace.time_s[range.start] >= criteria.shortest_s
            };
            unbroken(&trace.time_s, longest_s)
                .into_iter()
                .filter(is_long)
                .map(|range| Self::of_range(trace, log, subject, range))
                .collect::<Vec<Self>>()
        };
        let filled_s = criteria.longest_gap_periods * trace.period_s;
        let missing_s = criteria.missing_sample_periods * trace.period_s;
        let mut stretches = whole(filled_s.max(criteria.longest_gap_s));
        let lost = lost_part(&trace.time_s, trace.period_s);
        let mut shortest_s = filled_s;
        for stretch in &mut stretches {
            let is_known = !stretch.broadband || stretch.can_be_bridged(lost, subject);
            let from_s = if is_known { filled_s } else { missing_s };
            stretch.unseen = stretch.near_lost(trace, from_s, subject);
            shortest_s = shortest_s.min(from_s);
        }
        match stretches.iter().all(|stretch| stretch.is_seen(criteria.least_seen_part)) {
            true => stretches,
            false => whole(shortest_s),
        }
    }

    /// Samples from which a row would see a gap longer than this [s]: those within the reach of its
    /// low-pass. Empty where there is none.
    fn near_lost(&self, trace: &Trace, longest_s: f64, subject: &Subject) -> Vec<bool> {
        let rows = &subject.criteria.rows;
        let rows_per_s =
            if self.broadband { rows.broadband_rows_per_s } else { rows.calm_rows_per_s };
        let reach_s = 0.5 / (rows.cutoff_part * rows_per_s);
        let begin_s = trace.time_s[0] + self.start_s;
        let end_s = begin_s + self.duration_s();
        let sample = |time_s: f64| ((time_s - begin_s) / self.period_s).round().max(0.0) as usize;
        let is_gap = |pair: &&[f64]| {
            pair[1] - pair[0] > longest_s && pair[1] > begin_s && pair[0] < end_s
        };
        let gaps: Vec<&[f64]> = trace.time_s.windows(2).filter(is_gap).collect();
        let mut unseen = if gaps.is_empty() { Vec::new() } else { vec![false; self.len()] };
        for gap in gaps {
            let last = sample(gap[1] + reach_s).min(unseen.len());
            unseen[sample(gap[0] - reach_s).min(last)..last].fill(true);
        }
        unseen
    }

    /// Whether at least this part of the samples is not near one that was lost.
    fn is_seen(&self, least_part: f64) -> bool {
        let seen = self.unseen.iter().filter(|unseen| !**unseen).count();
        seen as f64 >= least_part * self.unseen.len() as f64
    }

    /// Whether filling lost samples adds little to the rows of any joint, next to its friction: what is
    /// fast in its command is missed in so many samples, and rows see a part of that.
    fn can_be_bridged(&self, lost_part: f64, subject: &Subject) -> bool {
        let (criteria, rows) = (&subject.criteria.logs, &subject.criteria.rows);
        let seen_hz = rows.cutoff_part * rows.broadband_rows_per_s;
        let missed = (lost_part * (2.0 * seen_hz * self.period_s).min(1.0)).sqrt();
        subject.joints.iter().all(|&joint| {
            let above_hz = criteria.broadband_above_hz;
            let fast_v = rms_above(&self.command_v[joint], self.period_s, above_hz);
            let level_v = subject.plant.friction[joint].alpha0_v;
            fast_v * missed <= criteria.most_bridged_part * level_v
        })
    }

    /// Root mean square of a command (joint 0 to 2) above this part of the sampling rate [V].
    pub fn fast_command_v(&self, joint: usize, fast_part: f64) -> f64 {
        rms_above(&self.command_v[joint], self.period_s, fast_part / self.period_s)
    }

    /// Its duration [s].
    pub fn duration_s(&self) -> f64 {
        self.len() as f64 * self.period_s
    }

    fn of_range(trace: &Trace, log: usize, subject: &Subject, range: Range<usize>) -> Self {
        let criteria = &subject.criteria.logs;
        let time_s = &trace.time_s[range.clone()];
        let fine = EvenClock::over(time_s, trace.period_s, criteria);
        let broadband = trace.joints.iter().any(|columns| {
            let command = fine.held_mean(&columns.command_v[range.clone()]);
            is_broadband(&command, fine.period_s(), criteria)
        });
        let clock = fine.coarser(samples_taken_together(fine.period_s(), broadband, criteria));
        let period_s = clock.period_s();
        let joints = subject.plant.joints();
        let mut stretch = Self {
            log,
            role: trace.role,
            start_s: time_s[0] - trace.time_s[0],
            period_s,
            sampled_s: fine.period_s(),
            motion: Kinematics::of_joints(joints),
            command_v: vec![Vec::new(); joints],
            postures: Vec::new(),
            middles: OnceLock::new(),
            broadband,
            settled: vec![0; joints],
            unseen: Vec::new(),
            roughness: vec![Roughness::default(); joints],
        };
        let mut angles = vec![Vec::new(); joints];
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
            let cutoff_hz = motion_cutoff_hz(&angles[joint], joint, period_s, broadband, subject);
            stretch.motion.set(joint, &angles[joint], period_s, cutoff_hz);
        }
        stretch.fill_absent();
        stretch.postures = postures_for(&subject.plant, &stretch.motion);
        stretch
    }

    /// Joints that the rig does not have hang still.
    fn fill_absent(&mut self) {
        let count = self.command_v.iter().map(Vec::len).max().unwrap_or(0);
        for joint in 0..self.command_v.len() {
            if self.command_v[joint].is_empty() {
                self.command_v[joint] = vec![0.0; count];
                self.motion.raw_rad[joint] = vec![Subject::resting_rad(joint); count];
                self.motion.q_rad[joint] = vec![Subject::resting_rad(joint); count];
                self.motion.qd_rad_per_s[joint] = vec![0.0; count];
                self.motion.qdd_rad_per_s2[joint] = vec![0.0; count];
            }
        }
    }

    /// A part of the stretch.
    pub fn part(&self, range: Range<usize>) -> Self {
        let cut = |signal: &Vec<f64>| signal[range.clone()].to_vec();
        let of = |signals: &[Vec<f64>]| signals.iter().map(cut).collect();
        let from_begin = |first: &usize| first.saturating_sub(range.start);
        Self {
            start_s: self.start_s + range.start as f64 * self.period_s,
            motion: Kinematics {
                raw_rad: of(&self.motion.raw_rad),
                q_rad: of(&self.motion.q_rad),
                qd_rad_per_s: of(&self.motion.qd_rad_per_s),
                qdd_rad_per_s2: of(&self.motion.qdd_rad_per_s2),
            },
            command_v: of(&self.command_v),
            postures: self.postures.get(range.clone()).unwrap_or_default().to_vec(),
            middles: OnceLock::new(),
            settled: self.settled.iter().map(from_begin).collect(),
            unseen: self.unseen.get(range).unwrap_or_default().to_vec(),
            roughness: self.roughness.clone(),
            ..*self
        }
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.command_v[0].len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Kinematics {
    /// Sines and cosines of the three-joint robot at every sample.
    pub fn postures(&self) -> Vec<Posture<f64>> {
        self.q_rad[1].iter().zip(&self.q_rad[2]).map(|(&q2, &q3)| Posture::new(q2, q3)).collect()
    }

    /// Every signal, by joints.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut Vec<Vec<f64>>> {
        let Self { raw_rad, q_rad, qd_rad_per_s, qdd_rad_per_s2 } = self;
        [raw_rad, q_rad, qd_rad_per_s, qdd_rad_per_s2].into_iter()
    }

    fn set(&mut self, joint: usize, q_rad: &[f64], period_s: f64, cutoff_hz: f64) {
        let smooth = LowPass::new(cutoff_hz, period_s).zero_phase(q_rad);
        self.qd_rad_per_s[joint] = derivative::first(&smooth, period_s);
        self.qdd_rad_per_s2[joint] = second_difference(q_rad, period_s);
        self.q_rad[joint] = smooth;
        self.raw_rad[joint] = q_rad.to_vec();
    }
}

/// Sines and cosines along a motion, where the closed form takes them.
pub fn postures_for(plant: &Plant, motion: &Kinematics) -> Vec<Posture<f64>> {
    if plant.body.as_rrr().is_some() { motion.postures() } else { Vec::new() }
}

/// Cut-off that keeps what the encoder's steps add to the velocity to a small part of it.
fn motion_cutoff_hz(
    q_rad: &[f64],
    joint: usize,
    period_s: f64,
    broadband: bool,
    subject: &Subject,
) -> f64 {
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

fn second_difference(q_rad: &[f64], period_s: f64) -> Vec<f64> {
    let last = q_rad.len().saturating_sub(1);
    let at = |k: usize| {
        let k = k.clamp(1, last.max(2) - 1);
        (q_rad[k + 1] + q_rad[k - 1] - 2.0 * q_rad[k]) / (period_s * period_s)
    };
    (0..q_rad.len()).map(at).collect()
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

/// Part of the samples of an even clock that a log lacks.
fn lost_part(time_s: &[f64], period_s: f64) -> f64 {
    let whole = (time_s[time_s.len() - 1] - time_s[0]) / period_s;
    (1.0 - (time_s.len() - 1) as f64 / whole).max(0.0)
}

/// Root mean square of what a signal has above a frequency.
fn rms_above(signal: &[f64], period_s: f64, frequency_hz: f64) -> f64 {
    let slow = LowPass::new(frequency_hz, period_s).zero_phase(signal);
    let fast: Vec<f64> = signal.iter().zip(&slow).map(|(u, s)| u - s).collect();
    signal::rms(&fast)
}

/// The first sample when a joint has come so far that its friction no longer depends on how its
/// bristles were bent before. A joint that never comes so far counts from its first sample.
fn settled(q_rad: &[f64], subject: &Subject, joint: usize) -> usize {
    let friction = &subject.plant.friction[joint];
    let level_v = friction.alpha0_v + friction.alpha1_v.max(0.0);
    let path_rad = subject.criteria.logs.settled_bends * level_v / friction.sigma0_v_per_rad;
    let gone = |q: &f64| (q - q_rad[0]).abs() > path_rad;
    q_rad.iter().position(gone).unwrap_or(0)
}
