//! Unbroken motion with its commands, prepared once for all models that are tried.
//!
//! A command acts over the interval from its sample to the next. So everything that
//! drives the motor belongs to intervals, and accelerations belong to samples: the second
//! difference of sampled positions is exactly the mean of the accelerations in the two
//! intervals about it, whatever the frequency.

use std::ops::Range;

use model::Posture;

use super::derived::Derived;
use super::kinematics::{Kinematics, Sines};
use super::sampling_jitter::Roughness;
use files::Role;
use signal::LowPass;

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
    /// What follows from the motion.
    pub derived: Derived,
    /// Whether the commands drive the joints at high frequencies.
    pub broadband: bool,
    /// First sample of each joint from which the bend of its bristles is known.
    pub settled: Vec<usize>,
    /// Samples too near to one that was lost; empty where none matters.
    pub unseen: Vec<bool>,
    /// The part for which each joint's samples count, as far as its friction is known where the command throws it;
    /// empty where all count in full.
    pub known_part: Vec<Vec<f64>>,
    /// How far each joint's smoothed angle wavers to either side while the joint stands, a third of what encoder
    /// steps add to it, rms; 0 where noise drives the joints, and of the three-joint robot [rad].
    pub at_rest_rad: Vec<f64>,
    /// How rough the angles of each joint are from sample to sample.
    pub roughness: Vec<Roughness>,
}

impl Stretch {
    /// One of so many joints without a sample.
    pub fn empty(log: usize, role: Role, period_s: f64, joints: usize) -> Self {
        Self {
            log,
            role,
            start_s: 0.0,
            period_s,
            sampled_s: period_s,
            motion: Kinematics::of_joints(joints),
            command_v: vec![Vec::new(); joints],
            postures: Vec::new(),
            derived: Derived::default(),
            broadband: false,
            settled: vec![0; joints],
            unseen: Vec::new(),
            known_part: vec![Vec::new(); joints],
            at_rest_rad: vec![0.0; joints],
            roughness: vec![Roughness::default(); joints],
        }
    }

    /// Root mean square of a command (joint 0 to 2) above this part of the sampling rate [V].
    pub fn fast_command_v(&self, joint: usize, fast_part: f64) -> f64 {
        rms_above(&self.command_v[joint], self.period_s, fast_part / self.period_s)
    }

    /// Lets all commands, which are held over an interval each, act later by so much [s].
    pub fn act_later(&mut self, late_s: f64) {
        let periods = late_s / self.period_s;
        self.command_v.iter_mut().for_each(|command| *command = later(command, periods));
    }

    /// Its duration [s].
    pub fn duration_s(&self) -> f64 {
        self.len() as f64 * self.period_s
    }

    /// A part of the stretch.
    pub fn part(&self, range: Range<usize>) -> Self {
        let cut = |signal: &Vec<f64>| signal[range.clone()].to_vec();
        let of = |signals: &[Vec<f64>]| signals.iter().map(cut).collect();
        let part = |of: &Vec<f64>| of.get(range.clone()).unwrap_or_default().to_vec();
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
            derived: Derived::default(),
            settled: self.settled.iter().map(from_begin).collect(),
            unseen: self.unseen.get(range.clone()).unwrap_or_default().to_vec(),
            known_part: self.known_part.iter().map(part).collect(),
            at_rest_rad: self.at_rest_rad.clone(),
            roughness: self.roughness.clone(),
            ..*self
        }
    }

    /// Sines and cosines of all joints' angles.
    pub fn sines(&self) -> &[Sines] {
        self.derived.sines.get_or_init(|| self.motion.sines())
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

/// Root mean square of what a signal has above a frequency.
pub fn rms_above(signal: &[f64], period_s: f64, frequency_hz: f64) -> f64 {
    let slow = LowPass::new(frequency_hz, period_s).zero_phase(signal);
    let fast: Vec<f64> = signal.iter().zip(&slow).map(|(u, s)| u - s).collect();
    signal::rms(&fast)
}

/// Commands that are held over an interval each, so many periods later.
fn later(command: &[f64], periods: f64) -> Vec<f64> {
    let (whole, part) = (periods.floor(), periods - periods.floor());
    let at = |k: usize, back: f64| {
        let place = k as f64 - whole - back;
        command[place.clamp(0.0, command.len() as f64 - 1.0) as usize]
    };
    (0..command.len()).map(|k| (1.0 - part) * at(k, 0.0) + part * at(k, 1.0)).collect()
}
