//! Friction and base parameters together, from logs in which all joints move.
//!
//! The earlier steps' friction and its errors stand for the logs of single joints: they
//! enter as measurements of their own. Base parameters, alpha_0 and alpha_2 are linear in
//! the command; the rest of LuGre friction is linearised about the last estimate
//! (Gauss-Newton), the state z driven by the measured velocity.

use model::base::COUNT;
use model::{BaseParameters, Friction};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::base_parameters::rows::{RowSettings, Rows};
use super::base_parameters::solve::Stack;
use super::base_parameters::{
    JointResidual, all_rows, joint_residuals, named_estimates, undetermined,
};
use super::campaign::{Known, Trace};
use super::estimate::{Estimate, StepError};
use crate::estimation::LinearProblem;
use crate::estimation::autocorrelation::meat;
use crate::signal::derivative;

/// Parameters of a joint's friction.
pub const FRICTION_COUNT: usize = 6;

/// Their names, in the order of Tables 2 and 3.
pub const FRICTION_NAMES: [&str; FRICTION_COUNT] = [
    "alpha0_V",
    "alpha1_V",
    "stribeck_velocity_rad_per_s",
    "alpha2_V_s_per_rad",
    "sigma0_V_per_rad",
    "sigma1_V_s_per_rad",
];

/// Places of alpha_1 and alpha_2 among them, which may be zero.
const ALPHA1: usize = 1;
const ALPHA2: usize = 3;

/// What earlier steps know of a joint's friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionKnowledge {
    /// The values.
    pub value: Friction<f64>,
    /// Their standard errors, entry by entry: zero holds the value as it is, infinity
    /// leaves it to this step alone.
    pub standard_error: Friction<f64>,
}

/// How the refinement works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How equations are made.
    pub rows: RowSettings,
    /// Residuals further apart than this are independent [s].
    pub block_s: f64,
    /// Doubt about the instants of command and of friction against the encoder's, in parts
    /// of the sample period.
    ///
    /// Converters take time, and so does a simulator's integration step. Lag that is not
    /// accounted for poses as inertia: a friction that is 0.05 ms late takes 0.05 ms k_t
    /// alpha_2 off the inertia, several of its standard errors.
    pub timing_doubt_periods: f64,
    /// Most steps.
    pub most_steps: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            rows: RowSettings::parallel(20.0),
            block_s: 0.25,
            timing_doubt_periods: 0.05,
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
    /// The same with standard errors and intervals, in the order of [`FRICTION_NAMES`].
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

/// Nuisance parameters of timing: the command's and the friction's lag of each joint.
const TIMING_COUNT: usize = 6;

/// Refines friction and base parameters on logs in which all joints move.
///
/// # Errors
/// No log, a log that cannot be used, or motion that does not determine the parameters.
pub fn refine(
    traces: &[&Trace],
    known: &Known,
    friction: &[FrictionKnowledge; 3],
    settings: &Settings,
) -> Result<Refined, StepError> {
    let start = friction.map(|joint| joint.value);
    let stretches = all_rows(traces, known, &start, &settings.rows)?;
    let layout = Layout::of(friction);
    let mut current = start;
    let mut weight: Option<Vec<f64>> = None;
    let mut steps = 0;
    loop {
        steps += 1;
        let stack = linearised(&stretches, &layout, &current);
        let solution =
            Solution::of(&stack, &layout, friction, &current, settings, weight.take(), &stretches)
                .ok_or_else(undetermined)?;
        let (next, largest) = layout.moved(&current, &solution);
        let converged = largest < 0.02;
        current = next;
        if converged || steps >= settings.most_steps {
            return Ok(refined(&stretches, &stack, &layout, current, &solution, steps, converged));
        }
        weight = Some(solution.weight);
    }
}

/// Which friction parameters are refined, and where their columns stand.
struct Layout {
    /// Joint and parameter of each column behind base parameters and timing.
    free: Vec<(usize, usize)>,
}

impl Layout {
    fn of(friction: &[FrictionKnowledge; 3]) -> Self {
        let mut free = Vec::new();
        for (joint, knowledge) in friction.iter().enumerate() {
            let errors = to_array(&knowledge.standard_error);
            free.extend((0..FRICTION_COUNT).filter(|&k| errors[k] > 0.0).map(|k| (joint, k)));
        }
        Self { free }
    }

    /// Parameters behind the base parameters.
    fn more_count(&self) -> usize {
        TIMING_COUNT + self.free.len()
    }

    fn column(&self, index: usize) -> usize {
        COUNT + TIMING_COUNT + index
    }

    /// Friction after a step, and the step's largest part in standard errors.
    ///
    /// A step changes no value by more than a third, so that none leaves its range.
    fn moved(&self, from: &[Friction<f64>; 3], solution: &Solution) -> ([Friction<f64>; 3], f64) {
        let mut values = from.each_ref().map(to_array);
        let mut largest = 0.0f64;
        for (index, &(joint, parameter)) in self.free.iter().enumerate() {
            let column = self.column(index);
            let wanted = solution.parameters[column];
            let error = solution.covariance[(column, column)].sqrt();
            let scale = match parameter {
                ALPHA1 => values[joint][0] + values[joint][ALPHA1],
                _ => values[joint][parameter],
            };
            let allowed = if parameter == ALPHA2 { f64::INFINITY } else { scale.abs() / 3.0 };
            values[joint][parameter] += wanted.clamp(-allowed, allowed);
            largest = largest.max(wanted.abs() / error);
        }
        for joint in &mut values {
            joint[ALPHA2] = joint[ALPHA2].max(0.0);
        }
        (values.map(from_array), largest)
    }
}

/// The equations linearised about a friction: right-hand sides and the columns of timing
/// and friction.
fn linearised(stretches: &[Rows], layout: &Layout, friction: &[Friction<f64>; 3]) -> Stack {
    let pieces: Vec<[JointPiece; 3]> = stretches
        .par_iter()
        .map(|rows| [0, 1, 2].map(|joint| JointPiece::of(rows, joint, layout, &friction[joint])))
        .collect();
    let (right, more): (Vec<_>, Vec<_>) = pieces
        .into_iter()
        .map(|[a, b, c]| ([a.right, b.right, c.right], [a.columns, b.columns, c.columns]))
        .unzip();
    Stack::new(stretches, &right, &more, layout.more_count())
}

/// One joint's right-hand side and columns over a stretch.
struct JointPiece {
    right: Vec<f64>,
    columns: Vec<(usize, Vec<f64>)>,
}

impl JointPiece {
    fn of(rows: &Rows, joint: usize, layout: &Layout, friction: &Friction<f64>) -> Self {
        let period_s = rows.motion.period_s;
        let friction_v = rows.friction_raw_v(joint, friction);
        let net_v: Vec<f64> =
            rows.motion.command_v[joint].iter().zip(&friction_v).map(|(u, f)| u - f).collect();
        let slope = |signal: &[f64]| rows.sampler.take(&derivative::first(signal, period_s));
        let mut columns =
            vec![(joint, slope(&rows.motion.command_v[joint])), (3 + joint, slope(&friction_v))];
        let mine: Vec<(usize, usize)> = layout
            .free
            .iter()
            .enumerate()
            .filter(|(_, free)| free.0 == joint)
            .map(|(index, free)| (TIMING_COUNT + index, free.1))
            .collect();
        columns.par_extend(mine.into_par_iter().map(|(place, parameter)| {
            let slope = sensitivity(rows, joint, friction, parameter, &friction_v);
            (place, rows.sampler.take(&slope))
        }));
        Self { right: rows.sampler.take(&net_v), columns }
    }
}

/// Derivative of a joint's friction voltage by one of its parameters.
fn sensitivity(
    rows: &Rows,
    joint: usize,
    friction: &Friction<f64>,
    parameter: usize,
    friction_v: &[f64],
) -> Vec<f64> {
    if parameter == ALPHA2 {
        return rows.motion.qd_rad_per_s[joint].clone();
    }
    let mut values = to_array(friction);
    let scale = if parameter == ALPHA1 { values[0] + values[ALPHA1] } else { values[parameter] };
    let step = 1e-4 * scale;
    values[parameter] += step;
    let moved_v = rows.friction_raw_v(joint, &from_array(values));
    moved_v.iter().zip(friction_v).map(|(a, b)| (a - b) / step).collect()
}

/// A Gauss-Newton step with its covariance.
struct Solution {
    /// Base parameters, lags, and changes of the free friction parameters.
    parameters: DVector<f64>,
    covariance: DMatrix<f64>,
    residuals: DVector<f64>,
    weight: Vec<f64>,
}

impl Solution {
    fn of(
        stack: &Stack,
        layout: &Layout,
        friction: &[FrictionKnowledge; 3],
        current: &[Friction<f64>; 3],
        settings: &Settings,
        weight: Option<Vec<f64>>,
        stretches: &[Rows],
    ) -> Option<Self> {
        let period_s = stretches.first()?.motion.period_s;
        let prior = prior_rows(layout, friction, current, settings.timing_doubt_periods * period_s);
        let mut weight = match weight {
            Some(weight) => weight,
            None => first_weights(stack, &prior)?,
        };
        let mut parameters = DVector::zeros(0);
        let mut residuals = DVector::zeros(0);
        for _ in 0..2 {
            let fit = with_prior(&stack.problem, &weight, &prior).solve()?;
            residuals = &stack.problem.right - &stack.problem.rows * &fit.parameters;
            parameters = fit.parameters;
            weight = stack.weights(&residuals, true);
        }
        let whole = with_prior(&stack.problem, &weight, &prior);
        let unit = whole.solve()?.unit_covariance;
        let weighted = stack.problem.clone().weighted(&weight);
        let left = &weighted.right - &weighted.rows * &parameters;
        let scores = meat(&weighted.rows, &left, &stack.blocks(settings.block_s));
        let covariance = &unit * (scores + prior.rows.tr_mul(&prior.rows)) * &unit;
        Some(Self { parameters, covariance, residuals, weight })
    }
}

/// Weights before any residual is known: those of a fit without regard to weights.
fn first_weights(stack: &Stack, prior: &LinearProblem) -> Option<Vec<f64>> {
    // A hundredth of a volt is about what unrefined friction leaves.
    let equal = vec![1e4; stack.origin.len()];
    let fit = with_prior(&stack.problem, &equal, prior).solve()?;
    Some(stack.weights(&(&stack.problem.right - &stack.problem.rows * &fit.parameters), true))
}

/// What earlier steps know, as equations of variance one.
fn prior_rows(
    layout: &Layout,
    friction: &[FrictionKnowledge; 3],
    current: &[Friction<f64>; 3],
    timing_s: f64,
) -> LinearProblem {
    let count = COUNT + layout.more_count();
    let mut entries: Vec<(usize, f64, f64)> =
        (0..TIMING_COUNT).map(|k| (COUNT + k, 0.0, timing_s)).collect();
    for (index, &(joint, parameter)) in layout.free.iter().enumerate() {
        let error = to_array(&friction[joint].standard_error)[parameter];
        if error.is_finite() {
            let known = to_array(&friction[joint].value)[parameter];
            let change = known - to_array(&current[joint])[parameter];
            entries.push((layout.column(index), change, error));
        }
    }
    let mut rows = DMatrix::zeros(entries.len(), count);
    for (row, &(column, _, error)) in entries.iter().enumerate() {
        rows[(row, column)] = 1.0 / error;
    }
    let right = DVector::from_iterator(entries.len(), entries.iter().map(|e| e.1 / e.2));
    LinearProblem { rows, right }
}

/// Weighted equations with the prior's below them.
fn with_prior(problem: &LinearProblem, weight: &[f64], prior: &LinearProblem) -> LinearProblem {
    let weighted = problem.clone().weighted(weight);
    let (data, more, columns) = (weighted.rows.nrows(), prior.rows.nrows(), weighted.rows.ncols());
    let mut rows = DMatrix::zeros(data + more, columns);
    rows.rows_mut(0, data).copy_from(&weighted.rows);
    rows.rows_mut(data, more).copy_from(&prior.rows);
    let mut right = DVector::zeros(data + more);
    right.rows_mut(0, data).copy_from(&weighted.right);
    right.rows_mut(data, more).copy_from(&prior.right);
    LinearProblem { rows, right }
}

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
        command_lag_s: std::array::from_fn(|joint| -solution.parameters[COUNT + joint]),
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
        let values = to_array(&friction[joint]);
        let estimate = |parameter: usize| {
            let place = layout.free.iter().position(|&free| free == (joint, parameter));
            let Some(index) = place else {
                return Estimate::new(values[parameter], 0.0).with_note("held as given");
            };
            let column = layout.column(index);
            Estimate::new(values[parameter], covariance[(column, column)].max(0.0).sqrt())
        };
        FRICTION_NAMES.into_iter().enumerate().map(|(k, name)| (name, estimate(k))).collect()
    })
}

/// A friction's values in the order of [`FRICTION_NAMES`].
pub fn to_array(friction: &Friction<f64>) -> [f64; FRICTION_COUNT] {
    [
        friction.alpha0_v,
        friction.alpha1_v,
        friction.stribeck_velocity_rad_per_s,
        friction.alpha2_v_s_per_rad,
        friction.sigma0_v_per_rad,
        friction.sigma1_v_s_per_rad,
    ]
}

/// A friction of values in the order of [`FRICTION_NAMES`].
pub fn from_array(values: [f64; FRICTION_COUNT]) -> Friction<f64> {
    let [alpha0_v, alpha1_v, v_s, alpha2, sigma0, sigma1] = values;
    Friction {
        alpha0_v,
        alpha1_v,
        stribeck_velocity_rad_per_s: v_s,
        alpha2_v_s_per_rad: alpha2,
        sigma0_v_per_rad: sigma0,
        sigma1_v_s_per_rad: sigma1,
    }
}
