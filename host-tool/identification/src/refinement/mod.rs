//! Friction and base parameters together, from logs in which all joints move.
//!
//! The earlier steps' friction and its errors stand for the logs of single joints: they
//! enter as measurements of their own. Base parameters, alpha_0 and alpha_2 are linear in
//! the command; the rest of LuGre friction is linearised about the last estimate
//! (Gauss-Newton), the state z driven by the measured velocity.

mod layout;
mod linearised;
mod model_uncertainty;
mod solution;

use model::base::COUNT;
use model::{BaseParameters, Friction, friction_parameters};
use nalgebra::DMatrix;

pub use super::base_parameters::FrictionEstimate;
use super::base_parameters::rows::{RowSettings, Rows};
use super::base_parameters::solve::Stack;
use super::base_parameters::{
    JointResidual, all_rows, joint_residuals, named_estimates, undetermined,
};
use super::estimate::Estimate;
use layout::{Layout, UNDETERMINED};
use linearised::{LinearisationPoint, RigidBody, linearised};
pub use model_uncertainty::ModelUncertainty;
use recordings::StepError;
use recordings::campaign::{Known, Trace};
use solution::{Solution, prior_rows};

/// How the refinement works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How equations are made.
    pub rows: RowSettings,
    /// Residuals further apart than this are independent [s].
    pub block_s: f64,
    /// Standard deviation of the lag of command and friction behind the encoder, in sample
    /// periods.
    ///
    /// Converters take time, and so does a simulator's integration step. Lag that is not
    /// accounted for poses as inertia: a friction that is late by t takes t k_t alpha_2 off
    /// the inertia, which at 0.05 ms is several of its standard errors.
    pub timing_error_periods: f64,
    /// Uncertainty of the model itself.
    pub model_uncertainty: ModelUncertainty,
    /// Most steps.
    pub most_steps: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            rows: RowSettings::parallel(20.0),
            block_s: 0.25,
            timing_error_periods: 0.05,
            model_uncertainty: ModelUncertainty::default(),
            most_steps: 12,
        }
    }
}

/// Friction and base parameters, refined.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined {
    /// Base parameters.
    pub base: BaseParameters<f64>,
    /// The same with standard errors and intervals, in the order of their names.
    pub base_estimates: Vec<(&'static str, Estimate)>,
    /// Their covariance.
    pub base_covariance: DMatrix<f64>,
    /// Friction of the joints.
    pub friction: [Friction<f64>; 3],
    /// The same with standard errors and intervals, in the order of [`friction_parameters::NAMES`].
    pub friction_estimates: [Vec<(&'static str, Estimate)>; 3],
    /// By how much commands come later than the log says [s], found along.
    pub command_lag_s: [f64; 3],
    /// What is left in each joint.
    pub residuals: Vec<JointResidual>,
    /// Gauss-Newton steps taken.
    pub steps: usize,
    /// Whether the last step was small against the standard errors.
    pub converged: bool,
}

/// Refines friction and base parameters on logs in which all joints move.
///
/// # Errors
/// No log, a log that cannot be used, or motion that does not determine the parameters.
pub fn refine(
    traces: &[&Trace],
    known: &Known,
    friction: &[FrictionEstimate; 3],
    settings: &Settings,
) -> Result<Refined, StepError> {
    let start = friction.map(|joint| joint.value);
    let stretches = all_rows(traces, known, &start, &settings.rows)?;
    let layout = Layout::of(friction);
    let timing_s = settings.timing_error_periods * stretches[0].motion.period_s;
    let mut point = LinearisationPoint { friction: start, rigid: None };
    let mut weight = None;
    for steps in 1.. {
        let stack = linearised(&stretches, &layout, &point);
        let prior = prior_rows(&layout, friction, &point.friction, timing_s);
        let solution = Solution::of(&stack, &prior, settings.block_s, weight.take())
            .ok_or_else(undetermined)?;
        let (next, largest) = solution.applied_to(&point.friction, &layout);
        let converged = largest < SMALL_STEP;
        if converged || steps >= settings.most_steps {
            let solution =
                solution.with_model_uncertainty(&settings.model_uncertainty, &layout, &next);
            return Ok(refined(&stretches, &stack, &layout, next, &solution, steps, converged));
        }
        let rigid = RigidBody::of(known, &solution);
        point = LinearisationPoint { friction: next, rigid };
        // Weights that keep changing with the residuals would keep the search from resting.
        weight = (steps >= SETTLED_STEPS).then_some(solution.weight);
    }
    Err(undetermined())
}

/// Steps below this, in standard errors, end the search.
const SMALL_STEP: f64 = 0.05;
/// Steps after which weights stay as they are.
const SETTLED_STEPS: usize = 3;

fn refined(
    stretches: &[Rows],
    stack: &Stack,
    layout: &Layout,
    friction: [Friction<f64>; 3],
    solution: &Solution,
    steps: usize,
    converged: bool,
) -> Refined {
    let parameters: [f64; COUNT] = std::array::from_fn(|k| solution.parameters[k]);
    let base_covariance = solution.covariance.view((0, 0), (COUNT, COUNT)).into_owned();
    Refined {
        base: BaseParameters::from_array(parameters),
        base_estimates: named_estimates(&parameters, &base_covariance),
        base_covariance,
        friction,
        friction_estimates: friction_estimates(layout, &friction, &solution.covariance),
        command_lag_s: std::array::from_fn(|joint| solution.parameters[COUNT + joint]),
        residuals: joint_residuals(stack, stretches, &solution.residuals),
        steps,
        converged,
    }
}

fn friction_estimates(
    layout: &Layout,
    friction: &[Friction<f64>; 3],
    covariance: &DMatrix<f64>,
) -> [Vec<(&'static str, Estimate)>; 3] {
    [0, 1, 2].map(|joint| {
        let values = friction[joint].to_array();
        let estimate = |parameter: usize| {
            let place = layout.free.iter().position(|&free| free == (joint, parameter));
            let Some(index) = place else {
                return Estimate::new(values[parameter], 0.0).with_note("held as given");
            };
            let column = layout.column(index);
            let error = covariance[(column, column)].max(0.0).sqrt();
            let estimate = Estimate::new(values[parameter], error);
            if UNDETERMINED.contains(&parameter) {
                return estimate.with_note("as given; this motion does not tell it");
            }
            estimate
        };
        friction_parameters::NAMES
            .into_iter()
            .enumerate()
            .map(|(k, name)| (name, estimate(k)))
            .collect()
    })
}
