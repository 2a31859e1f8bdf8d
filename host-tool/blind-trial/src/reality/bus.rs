//! What lies between the robot and the log: encoder, clock, bus.

use rand_distr::{Distribution, StandardNormal};
use serde::Serialize;

use crate::rng::Rng;
use files::{JointLog, Log, Position};
use rig::effects::Random;

/// Encoder, clock and bus of a rig.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bus {
    /// Time from tick to tick [s].
    pub sample_period_s: f64,
    /// The encoders count 2^bits a turn.
    pub encoder_bits: u32,
    /// How far from its tick a sample is really taken [s rms].
    pub sampling_jitter_s: f64,
    /// By how much the times in the log are wrong [s rms].
    pub stamp_jitter_s: f64,
    /// By which part the log's clock is too fast.
    pub clock_error: f64,
    /// How far the log's clock wanders [s], slowly.
    pub clock_wander_s: f64,
    /// How long it takes to wander there and back [s].
    pub wander_period_s: f64,
    /// Which part of the rows is lost.
    pub lost_part: f64,
    /// How many are lost at once, on average.
    pub lost_run: f64,
    /// Which part of the positions is wrong in the log.
    pub outlier_part: f64,
    /// By how much [rad rms].
    pub outlier_rad: f64,
}

impl Bus {
    /// 19 bits at 1 kHz, and nothing lost or late.
    pub fn faultless() -> Self {
        Self {
            sample_period_s: 1e-3,
            encoder_bits: 19,
            sampling_jitter_s: 0.0,
            stamp_jitter_s: 0.0,
            clock_error: 0.0,
            clock_wander_s: 0.0,
            wander_period_s: 10.0,
            lost_part: 0.0,
            lost_run: 1.0,
            outlier_part: 0.0,
            outlier_rad: 0.0,
        }
    }

    /// Encoder counts per turn.
    pub fn counts_per_turn(&self) -> u32 {
        1 << self.encoder_bits
    }

    /// The log as it arrives; same numbers, same damage.
    pub fn damage(&self, log: Log, rng: &mut Rng) -> Log {
        self.with_its_clock(self.with_losses(self.with_outliers(log, rng), rng), rng)
    }

    fn with_outliers(&self, mut log: Log, rng: &mut Rng) -> Log {
        let counts_per_rad = f64::from(self.counts_per_turn()) / std::f64::consts::TAU;
        for joint in &mut log.joints {
            let Position::Count(counts) = &mut joint.position else { continue };
            for count in counts.iter_mut() {
                if rng.unit() < self.outlier_part {
                    let off_rad = self.outlier_rad * rng.normal();
                    *count += (off_rad * counts_per_rad).round() as i64;
                }
            }
        }
        log
    }

    fn with_losses(&self, log: Log, rng: &mut Rng) -> Log {
        if self.lost_part <= 0.0 {
            return log;
        }
        let begins = self.lost_part / self.lost_run;
        let mut lost = false;
        let kept: Vec<bool> = (0..log.len())
            .map(|row| {
                let chance = if lost { 1.0 - 1.0 / self.lost_run } else { begins };
                lost = rng.unit() < chance && row > 0;
                !lost
            })
            .collect();
        only(log, &kept)
    }

    /// Times by the log's own clock; they stay in order.
    fn with_its_clock(&self, mut log: Log, rng: &mut Rng) -> Log {
        let most_s = 0.3 * self.sample_period_s;
        let phase = rng.phase_rad();
        let frequency = std::f64::consts::TAU / self.wander_period_s;
        for time_s in &mut log.time_s {
            let jitter_s = (self.stamp_jitter_s * rng.normal()).clamp(-most_s, most_s);
            let wander_s = self.clock_wander_s * (frequency * *time_s + phase).sin();
            *time_s += self.clock_error * *time_s + wander_s + jitter_s;
        }
        log
    }
}

impl Rng {
    /// A normal deviate.
    fn normal(&mut self) -> f64 {
        StandardNormal.sample(self.generator())
    }
}

/// The rows that are kept.
fn only(log: Log, kept: &[bool]) -> Log {
    fn some<T>(values: Vec<T>, kept: &[bool]) -> Vec<T> {
        values.into_iter().zip(kept).filter_map(|(value, &kept)| kept.then_some(value)).collect()
    }
    let joint = |joint: JointLog| JointLog {
        joint: joint.joint,
        position: match joint.position {
            Position::Count(counts) => Position::Count(some(counts, kept)),
            Position::Radian(angles) => Position::Radian(some(angles, kept)),
        },
        command_v: some(joint.command_v, kept),
        reference_rad: joint.reference_rad.map(|reference| some(reference, kept)),
    };
    Log { time_s: some(log.time_s, kept), joints: log.joints.into_iter().map(joint).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bus() -> Bus {
        Bus {
            stamp_jitter_s: 5e-4,
            clock_error: 1e-3,
            clock_wander_s: 1e-3,
            lost_part: 0.05,
            lost_run: 3.0,
            outlier_part: 0.01,
            outlier_rad: 0.01,
            ..Bus::faultless()
        }
    }

    #[test]
    fn a_log_arrives_damaged_but_in_order() {
        let rows = 20_000;
        let joint = |joint| JointLog {
            joint,
            position: Position::Count(vec![0; rows]),
            command_v: vec![1.0; rows],
            reference_rad: None,
        };
        let log = Log {
            time_s: (0..rows).map(|k| k as f64 * 1e-3).collect(),
            joints: (1..=3).map(joint).collect(),
        };
        let damaged = bus().damage(log.clone(), &mut Rng::new(1, 1));
        assert!(damaged.time_s.windows(2).all(|pair| pair[0] < pair[1]));
        let lost = 1.0 - damaged.len() as f64 / rows as f64;
        assert!((0.03..0.07).contains(&lost), "{lost}");
        assert_eq!(damaged.joints[2].command_v.len(), damaged.len());
        let Position::Count(counts) = &damaged.joints[0].position else { panic!("counts") };
        let wrong = counts.iter().filter(|&&count| count != 0).count();
        assert!((100..400).contains(&wrong), "{wrong}");
        assert!(damaged == bus().damage(log, &mut Rng::new(1, 1)));
    }
}
