//! From logs to rows.

use files::ArmJoint;
use recordings::ArmRecording;

use super::band::Band;
use super::error::ArmError;
use super::motion::{CommandTime, Motion};
use super::rows::{Equations, StretchRows};
use super::settings::Settings;
use super::stretch::{Stretch, stretches};

/// A log cut into stretches, with its band.
#[derive(Clone, Debug, PartialEq)]
pub struct PreparedLog {
    /// File name.
    pub file: String,
    /// Its low-passes.
    pub band: Band,
    stretches: Vec<Stretch>,
}

impl PreparedLog {
    /// Prepares a log.
    ///
    /// # Errors
    /// It has no stretch that is long enough.
    pub fn of(
        recording: &ArmRecording,
        joints: &[ArmJoint],
        settings: &Settings,
    ) -> Result<Self, ArmError> {
        let mut all = stretches(&recording.log, settings.longest_gap);
        all.iter_mut().for_each(|stretch| limit(stretch, joints));
        let steps: Vec<_> = joints.iter().map(ArmJoint::count_step).collect();
        let longest_s = all.iter().map(Stretch::duration_s).fold(0.0, f64::max);
        let too_short = |needed_s, rate_hz| ArmError::TooShort {
            file: recording.file.clone(),
            longest_s,
            needed_s,
            rate_hz,
        };
        let Some(first) = all.first() else { return Err(too_short(1.0, 0.0)) };
        let rate_hz = 1.0 / first.period_s;
        let band = Band::of(&all, &steps, settings);
        let needed_s = band.shortest_s(settings);
        let stretches: Vec<_> =
            all.into_iter().filter(|stretch| stretch.duration_s() >= needed_s).collect();
        if stretches.is_empty() {
            return Err(too_short(needed_s, rate_hz));
        }
        Ok(Self { file: recording.file.clone(), band, stretches })
    }

    /// Its rows.
    pub fn rows(
        &self,
        equations: &Equations,
        time: CommandTime,
        settings: &Settings,
    ) -> Vec<StretchRows> {
        let of_stretch = |stretch: &Stretch| {
            equations.rows(Motion::of(stretch, &self.band, time), &self.band, settings)
        };
        self.stretches.iter().map(of_stretch).collect()
    }

    /// Largest command and velocity of each joint.
    pub fn scales(&self) -> Vec<[f64; 2]> {
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let joints = self.band.standstill.len();
        let mut scales = vec![[0.0; 2]; joints];
        for stretch in &self.stretches {
            let motion = Motion::of(stretch, &self.band, CommandTime::Sampled);
            for (joint, scale) in scales.iter_mut().enumerate() {
                scale[0] = largest(&motion.command[joint]).max(scale[0]);
                scale[1] = largest(&motion.states[1][joint]).max(scale[1]);
            }
        }
        scales
    }
}

/// Commands as the drives pass them on: not beyond their limits.
fn limit(stretch: &mut Stretch, joints: &[ArmJoint]) {
    for (command, joint) in stretch.command.iter_mut().zip(joints) {
        if let Some(limit) = joint.drive.as_ref().and_then(|drive| drive.limit) {
            command.iter_mut().for_each(|u| *u = u.clamp(-limit, limit));
        }
    }
}
