//! A log of noise on one joint, as spectra.

use nalgebra::Complex;

use super::prior::Settings;
use recordings::StepError;
use recordings::campaign::{JointTrace, Known, Trace};
use signal::spectrum::{Spectra, Welch};
use signal::spectrum_window::{mean, slope_per_sample};

/// Averaged spectra of all joints in a log, and what else the fit needs.
#[derive(Clone, Debug)]
pub struct Record {
    /// The log's name.
    pub file: String,
    /// Index of the excited joint, 0 to 2.
    pub excited: usize,
    /// Which joints the log shows.
    pub present: [bool; 3],
    /// Sample period [s].
    pub period_s: f64,
    /// Mean angles, the posture [rad].
    pub posture_rad: [f64; 3],
    /// Drift of the excited joint in each segment [rad/s].
    pub drifts_rad_per_s: Vec<f64>,
    /// Mean position of the excited joint in each segment [encoder steps].
    pub positions_in_steps: Vec<f64>,
    /// Segments averaged.
    pub segments: usize,
    /// RMS of the noise [V].
    pub command_rms_v: f64,
    /// The spectra; signals are addressed by the methods below.
    pub spectra: Spectra,
    /// Encoder step [rad], 0 where none is known.
    pub encoder_step_rad: f64,
    instrument: usize,
    columns: [Option<usize>; 3],
}

/// The name of this step in messages.
pub const STEP: &str = "pre-sliding FRF";
/// Fewer segments than this are no average.
const LEAST_SEGMENTS: usize = 8;
/// Shorter segments resolve no resonance.
const LEAST_SAMPLES: usize = 256;

impl Record {
    /// The spectra of a log in which `joint` (1 to 3) is excited.
    pub fn of(
        trace: &Trace,
        joint: u8,
        known: &Known,
        settings: &Settings,
    ) -> Result<Self, StepError> {
        let moving = moving_joint(trace, joint, known)?;
        let (welch, starts) = segments(trace, &settings.welch)?;
        let signals = Signals::of(trace, moving);
        let spectra = welch.spectra(&signals.columns, &starts, trace.period_s);
        let spectra = spectra.ok_or_else(|| unusable(trace, "columns of different lengths"))?;
        let pieces = || starts.iter().map(|&k| &moving.q_rad[k..k + welch.segment_samples]);
        let step_rad = known.encoder_step_rad;
        let mean_of = |joint| trace.joint(joint).map_or(0.0, |joint| mean(&joint.q_rad));
        Ok(Self {
            file: trace.file.clone(),
            excited: usize::from(joint) - 1,
            present: [1, 2, 3].map(|joint| trace.joint(joint).is_some()),
            period_s: trace.period_s,
            posture_rad: [1, 2, 3].map(mean_of),
            drifts_rad_per_s: pieces().map(|p| slope_per_sample(p) / trace.period_s).collect(),
            positions_in_steps: pieces().map(|p| mean(p) / step_rad).collect(),
            segments: starts.len(),
            command_rms_v: deviation(&moving.command_v),
            spectra,
            encoder_step_rad: step_rad,
            instrument: signals.instrument,
            columns: signals.joints,
        })
    }

    /// Cross spectrum of a joint's command with the instrument.
    pub fn command_by_instrument(&self, bin: usize, joint: usize) -> Complex<f64> {
        self.columns[joint].map_or_else(Complex::default, |column| {
            self.spectra.cross(bin, column, self.instrument)
        })
    }

    /// Cross spectrum of the excited joint's angle with the instrument.
    pub fn angle_by_instrument(&self, bin: usize) -> Complex<f64> {
        self.spectra.cross(bin, self.angle_column(), self.instrument)
    }

    /// Power spectrum of the instrument: the noise, or the reference.
    pub fn instrument_power(&self, bin: usize) -> f64 {
        self.spectra.auto(bin, self.instrument)
    }

    /// Coherence of the noise with the excited joint's angle.
    pub fn coherence(&self, bin: usize) -> f64 {
        self.spectra.coherence(bin, self.angle_column(), self.instrument)
    }

    /// Share of the angle's power that the commands of all joints explain.
    pub fn multiple_coherence(&self, bin: usize) -> f64 {
        let inputs: Vec<usize> = self.columns.iter().flatten().copied().collect();
        self.spectra.multiple_coherence(bin, &inputs, self.angle_column())
    }

    /// The excited joint's FRF from command to angle [rad/V]: H1, or by the reference.
    pub fn frf(&self, bin: usize) -> Complex<f64> {
        let input = self.columns[self.excited].unwrap_or(self.instrument);
        self.spectra.frf_by_reference(bin, self.instrument, input, self.angle_column())
    }

    /// Power that `gains` (one per joint's command) and `own` times the angle leave.
    pub fn combined_power(&self, bin: usize, gains: &[Complex<f64>; 3], own: f64) -> f64 {
        let commands = (0..3).filter_map(|j| self.columns[j].map(|column| (column, gains[j])));
        let mut terms: Vec<(usize, Complex<f64>)> = commands.collect();
        terms.push((self.angle_column(), Complex::from(own)));
        let pair = |&(a, x): &(usize, Complex<f64>)| -> f64 {
            terms.iter().map(|&(b, y)| (x * y.conj() * self.spectra.cross(bin, a, b)).re).sum()
        };
        terms.iter().map(pair).sum()
    }

    /// The excited joint's angle is the last column but for a reference.
    fn angle_column(&self) -> usize {
        self.columns.iter().flatten().count()
    }
}

/// The columns of which spectra are taken: commands, the angle, and the reference where
/// it moves.
struct Signals<'a> {
    columns: Vec<&'a [f64]>,
    joints: [Option<usize>; 3],
    instrument: usize,
}

impl<'a> Signals<'a> {
    fn of(trace: &'a Trace, moving: &'a JointTrace) -> Self {
        let mut columns: Vec<&[f64]> = Vec::new();
        let mut joints = [None; 3];
        for joint in trace.joints.iter().filter(|joint| (1..=3).contains(&joint.number)) {
            joints[usize::from(joint.number) - 1] = Some(columns.len());
            columns.push(&joint.command_v);
        }
        let own = joints[usize::from(moving.number) - 1].unwrap_or(0);
        columns.push(&moving.q_rad);
        let reference = moving.reference_rad.as_deref().filter(|r| deviation(r) > 0.0);
        let instrument = if reference.is_some() { columns.len() } else { own };
        columns.extend(reference);
        Self { columns, joints, instrument }
    }
}

/// The excited joint's columns, checked.
fn moving_joint<'a>(
    trace: &'a Trace,
    joint: u8,
    known: &Known,
) -> Result<&'a JointTrace, StepError> {
    let missing = || {
        unusable(
            trace,
            format!("no columns of joint {joint}; check `joint` of the log in dataset.toml"),
        )
    };
    let found = trace.joint(joint).filter(|_| (1..=3).contains(&joint)).ok_or_else(missing)?;
    let constant = known.torque_constant(joint);
    if constant.is_nan() || constant <= 0.0 {
        let cure = "no torque constant; add it to torque_constant_Nm_per_V of the robot file";
        return Err(unusable(trace, format!("joint {joint} has {cure}")));
    }
    let finite = |signal: &[f64]| signal.iter().all(|x| x.is_finite());
    if !finite(&found.q_rad) || !finite(&found.command_v) {
        return Err(unusable(trace, format!("joint {joint} has values that are not numbers")));
    }
    if deviation(&found.command_v) == 0.0 {
        let cure = "is the noise on another joint? Check `joint` of the log in dataset.toml";
        return Err(unusable(trace, format!("u{joint}_V never changes; {cure}")));
    }
    if deviation(&found.q_rad) == 0.0 {
        let cure =
            "its encoder is stuck or the noise is too weak: check the encoder, raise the noise";
        return Err(unusable(trace, format!("joint {joint} never moved; {cure}")));
    }
    let limit_v = 0.999 * known.command_limit_v;
    let limited = found.command_v.iter().filter(|u| u.abs() >= limit_v).count();
    if limited * 100 > found.command_v.len() {
        let cure = "lower the noise below the static friction";
        return Err(unusable(trace, format!("u{joint}_V is at the command limit; {cure}")));
    }
    Ok(found)
}

/// Segments of the length that is set, or shorter ones where the log is short.
fn segments(trace: &Trace, welch: &Welch) -> Result<(Welch, Vec<usize>), StepError> {
    let mut welch = *welch;
    loop {
        let starts = welch.segments(&trace.time_s, trace.period_s);
        if starts.len() >= LEAST_SEGMENTS {
            return Ok((welch, starts));
        }
        if welch.segment_samples / 2 < LEAST_SAMPLES {
            let what = format!(
                "not {LEAST_SEGMENTS} stretches of {LEAST_SAMPLES} evenly spaced samples; \
                 record 100 s without gaps for the {STEP}"
            );
            return Err(unusable(trace, what));
        }
        welch.segment_samples /= 2;
    }
}

/// Standard deviation.
fn deviation(signal: &[f64]) -> f64 {
    let first = signal.first().copied().unwrap_or(0.0);
    let middle = mean(&signal.iter().map(|x| x - first).collect::<Vec<_>>()) + first;
    let power: f64 = signal.iter().map(|x| (x - middle).powi(2)).sum();
    if signal.iter().all(|&x| x == first) { 0.0 } else { (power / signal.len() as f64).sqrt() }
}

/// The log cannot be used.
pub fn unusable(trace: &Trace, what: impl Into<String>) -> StepError {
    StepError::Unusable { file: trace.file.clone(), what: what.into() }
}
