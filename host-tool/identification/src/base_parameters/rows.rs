//! The equations (13)-(15) that a log gives, one per joint and instant.

use model::base::COUNT;
use model::regressor::regressor;
use model::{Friction, FrictionState, Geometry, Posture};
use rayon::prelude::*;

use recordings::StepError;
use recordings::campaign::{Known, Trace};
use recordings::motion::{Instant, Motion};
use signal::{LowPass, derivative};

/// How equations are made of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowSettings {
    /// Cut-off of the positions' low-pass [Hz].
    pub motion_cutoff_hz: f64,
    /// Cut-off of the low-pass that both sides of each equation go through [Hz]; `None`
    /// compares instants, as the paper does.
    pub row_cutoff_hz: Option<f64>,
    /// Time between equations [s].
    pub row_period_s: f64,
    /// Which instants are compared.
    pub instant: Instant,
}

impl RowSettings {
    /// The paper's way: smoothed motion against the raw command of the same row, every
    /// 10 ms. The paper gives no cut-off; 20 Hz passes all of its motion.
    pub fn paper() -> Self {
        Self {
            motion_cutoff_hz: 20.0,
            row_cutoff_hz: None,
            row_period_s: 0.01,
            instant: Instant::Sample,
        }
    }

    /// Both sides through the same filter, at the middle of each command's interval.
    ///
    /// The positions' own filter only keeps encoder steps out of the products of the
    /// regressor: ten times the rows' cut-off, so that it takes nothing that they keep, and
    /// little of the velocity's corners where friction reverses: with five times, sigma_0
    /// and sigma_1 come out wrong by more than their standard errors. Between 10 and 30 Hz
    /// the rows' cut-off changes no parameter by more than its standard error: weights make
    /// up for the noise that a higher one lets in.
    pub fn parallel(cutoff_hz: f64) -> Self {
        Self {
            motion_cutoff_hz: 10.0 * cutoff_hz,
            row_cutoff_hz: Some(cutoff_hz),
            row_period_s: 0.2 / cutoff_hz,
            instant: Instant::Middle,
        }
    }
}

/// Takes equations from signals on the log's clock.
#[derive(Clone, Copy, Debug)]
pub struct RowSampler {
    filter: Option<LowPass>,
    margin: usize,
    every: usize,
}

impl RowSampler {
    /// For signals of a period.
    pub fn new(settings: &RowSettings, period_s: f64) -> Self {
        let filter = settings.row_cutoff_hz.map(|cutoff_hz| LowPass::new(cutoff_hz, period_s));
        let memory = filter.map_or(0, |filter| filter.memory());
        let margin = memory.max((0.1 / period_s).round() as usize);
        let every = (settings.row_period_s / period_s).round().max(1.0) as usize;
        Self { filter, margin, every }
    }

    /// The signal's values in the equations.
    pub fn take(&self, signal: &[f64]) -> Vec<f64> {
        let inside = signal.len().saturating_sub(self.margin);
        match &self.filter {
            Some(filter) => {
                derivative::decimated(&filter.zero_phase(signal)[..inside], self.margin, self.every)
            }
            None => derivative::decimated(&signal[..inside], self.margin, self.every),
        }
    }

    /// The equations' instants [s].
    pub fn times(&self, motion: &Motion) -> Vec<f64> {
        let inside = motion.len().saturating_sub(self.margin);
        let instants = (self.margin..inside).step_by(self.every);
        instants.map(|k| motion.start_s + k as f64 * motion.period_s).collect()
    }

    /// First equation that does not depend on the signal before an instant.
    fn first_after(&self, instant: usize) -> usize {
        let memory = self.filter.map_or(0, |filter| filter.memory() / 2);
        (instant + memory).saturating_sub(self.margin).div_ceil(self.every)
    }
}

/// The equations of one joint over a stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRows {
    /// A column of k_t^-1 R per base parameter [V per unit]; empty where it is zero.
    pub columns: Vec<Vec<f64>>,
    /// Command [V].
    pub command_v: Vec<f64>,
    /// First equation that can be used: before it, the joint has not yet slid far enough
    /// to tell the deflection of its friction.
    pub first: usize,
}

/// The equations of an unbroken stretch of a log.
#[derive(Clone, Debug)]
pub struct Rows {
    /// The log's file name.
    pub file: String,
    /// Instants [s].
    pub time_s: Vec<f64>,
    /// The equations of each joint.
    pub joints: [JointRows; 3],
    /// The motion that they come from.
    pub motion: Motion,
    /// Takes further signals on the motion's clock to the equations.
    pub sampler: RowSampler,
}

impl Rows {
    /// The equations of a log, stretch by stretch.
    ///
    /// # Errors
    /// A log that lacks a joint, or a rig without lengths.
    pub fn of(
        trace: &Trace,
        known: &Known,
        friction: &[Friction<f64>; 3],
        settings: &RowSettings,
    ) -> Result<Vec<Self>, StepError> {
        let geometry = known.geometry.ok_or_else(|| StepError::Numerical {
            step: "base parameters",
            what: "the robot file has no lengths; give d1_m to a3_m of a rig of three joints"
                .into(),
        })?;
        let stretches = Motion::stretches(trace, settings.motion_cutoff_hz, settings.instant)?;
        let rows = stretches
            .into_iter()
            .map(|motion| Self::of_motion(trace, motion, known, &geometry, friction, settings));
        Ok(rows.filter(|rows| !rows.time_s.is_empty()).collect())
    }

    fn of_motion(
        trace: &Trace,
        motion: Motion,
        known: &Known,
        geometry: &Geometry<f64>,
        friction: &[Friction<f64>; 3],
        settings: &RowSettings,
    ) -> Self {
        let sampler = RowSampler::new(settings, motion.period_s);
        let regressors = regressors(&motion, geometry);
        let joints = [0, 1, 2].map(|joint| {
            let k_t = known.torque_constant(joint as u8 + 1);
            let column = |parameter: usize| {
                let raw: Vec<f64> = regressors.iter().map(|r| r[joint][parameter] / k_t).collect();
                if raw.iter().all(|&x| x == 0.0) { Vec::new() } else { sampler.take(&raw) }
            };
            JointRows {
                columns: (0..COUNT).into_par_iter().map(column).collect(),
                command_v: sampler.take(&motion.command_v[joint]),
                first: sampler.first_after(settled(&motion.q_rad[joint], &friction[joint])),
            }
        });
        Self { file: trace.file.clone(), time_s: sampler.times(&motion), joints, motion, sampler }
    }

    /// Friction voltages of a joint (0 to 2) in the equations [V].
    pub fn friction_v(&self, joint: usize, friction: &Friction<f64>) -> Vec<f64> {
        self.sampler.take(&self.friction_raw_v(joint, friction))
    }

    /// Friction voltages of a joint (0 to 2) on the log's clock [V].
    pub fn friction_raw_v(&self, joint: usize, friction: &Friction<f64>) -> Vec<f64> {
        friction_voltage(friction, &self.motion.qd_rad_per_s[joint], self.motion.period_s)
    }
}

/// R of eq. (5) at every instant.
fn regressors(motion: &Motion, geometry: &Geometry<f64>) -> Vec<[[f64; COUNT]; 3]> {
    let at = |k: usize| {
        let (q, qd, qdd) = motion.state(k);
        regressor(&Posture::new(q[1], q[2]), geometry, &qd, &qdd)
    };
    (0..motion.len()).map(at).collect()
}

/// LuGre friction driven by a velocity [V], its mean over the period about each instant.
///
/// Each period is taken in [`FRICTION_STEPS`] steps along the velocity's slope: a constant velocity
/// over a whole millisecond would err around reversals.
pub fn friction_voltage(
    friction: &Friction<f64>,
    velocity_rad_per_s: &[f64],
    period_s: f64,
) -> Vec<f64> {
    let v = velocity_rad_per_s;
    let mut state = FrictionState::default();
    let at = |k: usize| {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(v.len() - 1));
        let slope = (v[after] - v[before]) / (after - before).max(1) as f64;
        let steps = (0..FRICTION_STEPS).map(|step| {
            let offset = (f64::from(step) + 0.5) / f64::from(FRICTION_STEPS) - 0.5;
            state.step(friction, v[k] + offset * slope, period_s / f64::from(FRICTION_STEPS))
        });
        steps.sum::<f64>() / f64::from(FRICTION_STEPS)
    };
    (0..v.len()).map(at).collect()
}

/// Friction steps per period.
const FRICTION_STEPS: u32 = 2;

/// The first instant when a joint has come so far from its start that its friction no
/// longer remembers the deflection there: five times the largest one.
fn settled(q_rad: &[f64], friction: &Friction<f64>) -> usize {
    let level_v = friction.alpha0_v + friction.alpha1_v.max(0.0);
    let path_rad = 5.0 * level_v / friction.sigma0_v_per_rad;
    let gone = |q: &f64| (q - q_rad[0]).abs() > path_rad;
    q_rad.iter().position(gone).unwrap_or(q_rad.len())
}
