//! Base parameters by least squares, sections 4.1 and 4.3.

use model::base::{COUNT, NAMES};
use model::{BaseParameters, Friction};
use nalgebra::DMatrix;

use super::estimate::Estimate;
use friction_covariance::covariance_of_friction;
use recordings::StepError;
use recordings::campaign::{Known, Trace};

pub mod convergence;
pub mod friction;
mod friction_covariance;
mod residual;
pub mod rows;
pub mod solve;

pub use convergence::ConvergencePoint;
pub use friction::FrictionEstimate;
pub use residual::JointResidual;
pub(super) use residual::joint_residuals;
pub use rows::{RowSettings, Rows};
pub use solve::Stack;

pub(super) const STEP: &str = "base parameters";

/// How base parameters are identified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How equations are made.
    pub rows: RowSettings,
    /// Weighs each joint's equations by their noise and outliers less.
    pub weighted: bool,
    /// Residuals further apart than this are independent [s].
    pub block_s: f64,
    /// Points of the convergence diagram.
    pub convergence_points: usize,
}

impl Settings {
    /// The paper's way.
    pub fn paper() -> Self {
        Self { rows: RowSettings::paper(), weighted: false, block_s: 0.25, convergence_points: 60 }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self { rows: RowSettings::parallel(20.0), weighted: true, ..Self::paper() }
    }
}

/// Identified base parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseResult {
    /// The parameters.
    pub base: BaseParameters<f64>,
    /// The same with standard errors and intervals, in the order of [`NAMES`].
    pub estimates: Vec<(&'static str, Estimate)>,
    /// Their covariance, in the order of [`NAMES`].
    pub covariance: DMatrix<f64>,
    /// J_k of Phi as recorded, eq. (14).
    pub condition_number: f64,
    /// Equations used.
    pub equations: usize,
    /// The estimates over the number of samples, Fig. 9.
    pub convergence: Vec<ConvergencePoint>,
    /// What is left in each joint.
    pub residuals: Vec<JointResidual>,
}

/// Identifies the base parameters from logs in which all joints move, their friction known.
///
/// The standard errors hold for residuals that correlate within `settings.block_s`, and
/// carry those of the friction.
///
/// # Errors
/// No log, a log that cannot be used, or motion that does not determine all parameters.
pub fn identify(
    traces: &[&Trace],
    known: &Known,
    friction: &[FrictionEstimate; 3],
    settings: &Settings,
) -> Result<BaseResult, StepError> {
    let values = friction.map(|joint| joint.value);
    let stretches = all_rows(traces, known, &values, &settings.rows)?;
    let right: Vec<[Vec<f64>; 3]> =
        stretches.iter().map(|rows| without_friction(rows, &values)).collect();
    let stack = Stack::new(&stretches, &right, &[], 0);
    let solved = if settings.weighted {
        stack.solve_weighted(true)
    } else {
        stack.problem.solve().map(|fit| (fit, vec![1.0; stack.origin.len()]))
    };
    let (fit, weight) = solved.ok_or_else(undetermined)?;
    let covariance = stack.covariance(&fit, &weight, settings.block_s)
        + covariance_of_friction(&stretches, &stack, &fit, &weight, friction);
    let parameters: [f64; COUNT] = std::array::from_fn(|k| fit.parameters[k]);
    Ok(BaseResult {
        base: BaseParameters::from_array(parameters),
        estimates: named_estimates(&parameters, &covariance),
        condition_number: stack.problem.condition_number(),
        equations: stack.origin.len(),
        convergence: convergence::convergence(&stack, &weight, settings.convergence_points),
        residuals: joint_residuals(
            &stack,
            &stretches,
            &(&stack.problem.right - &stack.problem.rows * &fit.parameters),
        ),
        covariance,
    })
}

/// The equations of all logs.
pub(super) fn all_rows(
    traces: &[&Trace],
    known: &Known,
    friction: &[Friction<f64>; 3],
    settings: &RowSettings,
) -> Result<Vec<Rows>, StepError> {
    if traces.is_empty() {
        return Err(StepError::NoLog { step: STEP, experiment: "excitation".into() });
    }
    let mut all = Vec::new();
    for trace in traces {
        check_motion(trace)?;
        all.extend(Rows::of(trace, known, friction, settings)?);
    }
    Ok(all)
}

/// Every joint of the log must move and be driven.
fn check_motion(trace: &Trace) -> Result<(), StepError> {
    let range = |signal: &[f64]| {
        let (low, high) = signal
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
        high - low
    };
    for joint in &trace.joints {
        // A thousandth of a radian is bristle deflection, not motion.
        let moved_rad = range(&joint.q_rad);
        if moved_rad.is_nan() || moved_rad < 1e-2 {
            let what = format!(
                "joint {} did not move, or its encoder is stuck; base parameters need motion of all joints",
                joint.number
            );
            return Err(StepError::Unusable { file: trace.file.clone(), what });
        }
    }
    Ok(())
}

pub(super) fn undetermined() -> StepError {
    StepError::Numerical {
        step: STEP,
        what: "the motion does not determine all base parameters; record an excitation that \
               moves all joints at once"
            .into(),
    }
}

/// u of eq. (8): the command less the friction.
fn without_friction(rows: &Rows, friction: &[Friction<f64>; 3]) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|joint| {
        let friction_v = rows.friction_v(joint, &friction[joint]);
        rows.joints[joint].command_v.iter().zip(friction_v).map(|(u, f)| u - f).collect()
    })
}

pub(super) fn named_estimates(
    parameters: &[f64; COUNT],
    covariance: &DMatrix<f64>,
) -> Vec<(&'static str, Estimate)> {
    let estimate = |k: usize| Estimate::new(parameters[k], covariance[(k, k)].max(0.0).sqrt());
    NAMES.into_iter().enumerate().map(|(k, name)| (name, estimate(k))).collect()
}
