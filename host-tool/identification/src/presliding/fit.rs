//! The weighted fit of the excited joint's FRF, neighbours included.

use std::f64::consts::TAU;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{Complex, DVector};

use super::creep::{Creep, StribeckCurve, creep};
use super::linear::LinearRobot;
use super::prior::{Prior, Settings, Sliding};
use super::prior_distribution::{PriorDistribution, known_inertia, prior_distribution};
use super::problem::{Problem, index};
use super::record::{Record, STEP};
use super::start::start;
use recordings::StepError;
use recordings::campaign::Known;

/// Rounds of weighting, each with the residual spectrum of the last fit.
const ROUNDS: usize = 4;
/// Residual spectra are smoothed over so many frequencies to either side.
const SMOOTHING_BINS: usize = 7;

/// What came out.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The linearised robot that fits.
    pub robot: LinearRobot,
    /// Relative standard errors of sigma_0 and sigma_1 of the excited joint from noise.
    pub relative_error: [f64; 2],
    /// Mean square of the residual over what its spectrum predicts, 1 for a perfect model.
    pub misfit: f64,
    /// The bins of the fit.
    pub bins: Vec<usize>,
    /// Whether the rigid body was known.
    pub body_known: bool,
    /// Relative error of the base parameters.
    pub inertia_error: f64,
    /// RMS of the excited joint's motion at all frequencies of the fit and above [rad].
    pub motion_rms_rad: f64,
}

/// Fits a record.
pub fn fit(
    record: &Record,
    known: &Known,
    prior: &Prior,
    settings: &Settings,
) -> Result<Fitted, StepError> {
    let bins = band(record, settings)?;
    let failed = |what: &str| StepError::Numerical {
        step: STEP,
        what: format!("{}: {what}; check the torque constants and the log", record.file),
    };
    let first = start(record, &bins, known_inertia(record, known, prior))
        .ok_or_else(|| failed("the FRF is not that of an inertia on a spring"))?;
    let distribution = prior_distribution(record, known, prior, &first);
    let sliding = prior.sliding[record.excited].as_ref();
    let mut parameters = DVector::zeros(index::COUNT);
    let mut robot = distribution.robot;
    let mut solved = None;
    for round in 0..ROUNDS {
        let creep = creep_of(record, &robot, sliding);
        let power = residual_power(record, &bins, (round > 0).then_some(&robot));
        let problem = Problem::new(record, &bins, &power, distribution, creep, sliding, settings);
        let (problem, report) = LevenbergMarquardt::new().minimize(problem.at(parameters));
        if !report.termination.was_successful() {
            return Err(failed("the fit did not converge"));
        }
        parameters = problem.parameters.clone();
        robot = problem.robot();
        solved = Some(problem);
    }
    let problem = solved.ok_or_else(|| failed("the fit did not begin"))?;
    conclude(&problem, record, bins.clone(), distribution)
        .ok_or_else(|| failed("the fit is singular"))
}

fn conclude(
    problem: &Problem<'_>,
    record: &Record,
    bins: Vec<usize>,
    prior: PriorDistribution,
) -> Option<Fitted> {
    let jacobian = problem.jacobian()?;
    let covariance = (jacobian.transpose() * jacobian).try_inverse()?;
    let misfit = problem.misfit()?;
    let error = |first: usize| {
        let k = first + record.excited;
        (covariance[(k, k)] * misfit.max(1.0)).sqrt()
    };
    let robot = problem.robot();
    Some(Fitted {
        robot,
        relative_error: [error(index::SIGMA0), error(index::SIGMA1)],
        misfit,
        bins,
        body_known: prior.body_known,
        inertia_error: prior.inertia[record.excited],
        motion_rms_rad: motion_rms(record, &robot, 0),
    })
}

/// The bins in which smoothed coherence carries the fit: those around its peak.
fn band(record: &Record, settings: &Settings) -> Result<Vec<usize>, StepError> {
    let [low, high] = settings.band_hz;
    let inside = |hz: &f64| (low..=high).contains(hz);
    let all: Vec<usize> = (2..record.spectra.bins().saturating_sub(1))
        .filter(|&bin| inside(&record.spectra.frequency_hz[bin]))
        .collect();
    let raw: Vec<f64> = all.iter().map(|&bin| record.coherence(bin)).collect();
    let smoothed = smooth(&raw);
    let carries = |&k: &usize| smoothed[k] >= settings.least_coherence;
    let peak = (0..all.len()).max_by(|&a, &b| smoothed[a].total_cmp(&smoothed[b]));
    let around = peak.filter(carries).map(|peak| {
        let first = (0..=peak).rev().take_while(carries).last().unwrap_or(peak);
        let last = (peak..all.len()).take_while(carries).last().unwrap_or(peak);
        all[first..=last].to_vec()
    });
    around.filter(|bins| bins.len() >= 10).ok_or_else(|| StepError::Unusable {
        file: record.file.clone(),
        what: format!(
            "the motion of joint {} does not follow the noise (coherence below {} from {low} to \
             {high} Hz); raise the noise, staying below static friction",
            record.excited + 1,
            settings.least_coherence
        ),
    })
}

/// lambda and kappa under the motion that a linear robot makes of the recorded commands.
fn creep_of(record: &Record, robot: &LinearRobot, sliding: Option<&Sliding>) -> Creep {
    // Without earlier estimates only the shape of g counts: lambda itself is then free.
    let curve = sliding.map_or(
        StribeckCurve { alpha0_v: 0.3, alpha1_v: 0.0, stribeck_velocity_rad_per_s: 1.0 },
        |sliding| StribeckCurve {
            alpha0_v: sliding.alpha0_v.value,
            alpha1_v: sliding.alpha1_v.value.max(-0.9 * sliding.alpha0_v.value),
            stribeck_velocity_rad_per_s: sliding.stribeck_velocity_rad_per_s.value.max(1e-6),
        },
    );
    creep(&curve, motion_rms(record, robot, 1), &record.drifts_rad_per_s)
}

/// RMS of the excited joint's angle (`derivatives` 0, [rad]) or velocity (1, [rad/s])
/// that a linear robot makes of the recorded commands.
fn motion_rms(record: &Record, robot: &LinearRobot, derivatives: i32) -> f64 {
    let power = (2..record.spectra.bins()).filter_map(|bin| {
        let frequency_hz = record.spectra.frequency_hz[bin];
        let frf = robot.frf(frequency_hz, record.period_s)?;
        let gains = [0, 1, 2].map(|j| frf[(record.excited, j)]);
        let power = record.combined_power(bin, &gains, 0.0);
        Some(power * (TAU * frequency_hz).powi(2 * derivatives))
    });
    (power.sum::<f64>() * record.spectra.step_hz()).max(0.0).sqrt()
}

/// Smoothed power spectrum of what the commands do not explain [rad^2/Hz]: with a robot
/// its residual, before that what is not coherent.
fn residual_power(record: &Record, bins: &[usize], robot: Option<&LinearRobot>) -> Vec<f64> {
    let power_of = |&bin: &usize| {
        let frf = robot.and_then(|r| r.frf(record.spectra.frequency_hz[bin], record.period_s));
        let power = match frf {
            Some(frf) => {
                let gains = [0, 1, 2].map(|j| -frf[(record.excited, j)]);
                record.combined_power(bin, &gains, 1.0)
            }
            None => {
                let total = record.combined_power(bin, &[Complex::default(); 3], 1.0);
                total * (1.0 - record.coherence(bin))
            }
        };
        power.max(f64::MIN_POSITIVE).ln()
    };
    let logarithms: Vec<f64> = bins.iter().map(power_of).collect();
    smooth(&logarithms).into_iter().map(f64::exp).collect()
}

/// Moving average over [`SMOOTHING_BINS`] to either side, as far as there are any.
fn smooth(signal: &[f64]) -> Vec<f64> {
    let window = |k: usize| {
        let reach = SMOOTHING_BINS.min(k).min(signal.len() - 1 - k);
        let piece = &signal[k - reach..=k + reach];
        piece.iter().sum::<f64>() / piece.len() as f64
    };
    (0..signal.len()).map(window).collect()
}
