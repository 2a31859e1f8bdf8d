//! Friction and base parameters together, from logs in which all joints move.
//!
//! The earlier steps' friction and its errors stand for the logs of single joints: they
//! enter as measurements of their own. Base parameters, alpha_0 and alpha_2 are linear in
//! the command; the rest of LuGre friction is linearised about the last estimate
//! (Gauss-Newton), the state z driven by the measured velocity.

use model::base::COUNT;
use model::{BaseParameters, Friction, Geometry, Posture};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::base_parameters::friction::{
    ALPHA2, FRICTION_COUNT, FRICTION_NAMES, FrictionKnowledge, from_array, magnitude, sensitivity,
    to_array,
};
use super::base_parameters::rows::{RowSettings, Rows};
use super::base_parameters::solve::Stack;
use super::base_parameters::{
    JointResidual, all_rows, joint_residuals, named_estimates, undetermined,
};
use super::campaign::{Known, Trace};
use super::estimate::{Estimate, StepError};
use super::motion::Motion;
use crate::estimation::LinearProblem;
use crate::estimation::autocorrelation::meat;
use crate::signal::derivative;

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

/// Nuisance parameters of timing: the command's lag of each joint, the friction's, and
/// that of the velocities which drive Coriolis and centrifugal torques.
const TIMING_COUNT: usize = 7;
/// Place of the last one.
const CORIOLIS_LAG: usize = 6;

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
    let timing_s = settings.timing_doubt_periods * stretches[0].motion.period_s;
    let mut point = Point { friction: start, rigid: None };
    let mut weight = None;
    for steps in 1.. {
        let stack = linearised(&stretches, &layout, &point);
        let prior = prior_rows(&layout, friction, &point.friction, timing_s);
        let solution = Solution::of(&stack, &prior, settings.block_s, weight.take())
            .ok_or_else(undetermined)?;
        let (next, largest) = layout.moved(&point.friction, &solution);
        let converged = largest < SMALL_STEP;
        if converged || steps >= settings.most_steps {
            return Ok(refined(&stretches, &stack, &layout, next, &solution, steps, converged));
        }
        let rigid = RigidBody::of(known, &solution);
        point = Point { friction: next, rigid };
        // Weights that keep changing with the residuals would keep the search from resting.
        weight = (steps >= SETTLED_STEPS).then_some(solution.weight);
    }
    Err(undetermined())
}

/// Places of alpha_1 and the Stribeck velocity: a motion that reverses at rad/s^2 crosses
/// 0.003 rad/s within a millisecond and tells nothing of them. They stay as the earlier
/// steps found them, and their doubt is carried along.
const UNSEEN: [usize; 2] = [1, 2];

/// Steps below this, in standard errors, end the search.
const SMALL_STEP: f64 = 0.05;
/// Steps after which weights stay as they are.
const SETTLED_STEPS: usize = 3;

/// Where the equations are linearised.
struct Point {
    friction: [Friction<f64>; 3],
    /// Known from the first step on.
    rigid: Option<RigidBody>,
}

/// The rigid body that Coriolis torques are computed with.
struct RigidBody {
    base: BaseParameters<f64>,
    geometry: Geometry<f64>,
    torque_constant_nm_per_v: [f64; 3],
}

impl RigidBody {
    fn of(known: &Known, solution: &Solution) -> Option<Self> {
        Some(Self {
            base: BaseParameters::from_array(std::array::from_fn(|k| solution.parameters[k])),
            geometry: known.geometry?,
            torque_constant_nm_per_v: [1, 2, 3].map(|joint| known.torque_constant(joint)),
        })
    }

    /// Change of a joint's voltage per second that velocities come early [V/s].
    fn coriolis_slope(&self, motion: &Motion, joint: usize) -> Vec<f64> {
        const STEP_S: f64 = 1e-4;
        let at = |k: usize| {
            let (q, qd, qdd) = motion.state(k);
            let posture = Posture::new(q[1], q[2]);
            let torque = |step_s: f64| {
                let velocity = [0, 1, 2].map(|i| qd[i] + step_s * qdd[i]);
                posture.coriolis(&self.base, &self.geometry, &velocity)[joint]
            };
            (torque(STEP_S) - torque(-STEP_S))
                / (2.0 * STEP_S)
                / self.torque_constant_nm_per_v[joint]
        };
        (0..motion.len()).map(at).collect()
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
        let moving = self.free.iter().enumerate().filter(|(_, free)| !UNSEEN.contains(&free.1));
        for (index, &(joint, parameter)) in moving {
            let column = self.column(index);
            let wanted = solution.parameters[column];
            let error = solution.covariance[(column, column)].sqrt();
            let scale = magnitude(&values[joint], parameter);
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
fn linearised(stretches: &[Rows], layout: &Layout, point: &Point) -> Stack {
    let pieces: Vec<[JointPiece; 3]> = stretches
        .par_iter()
        .map(|rows| [0, 1, 2].map(|joint| JointPiece::of(rows, joint, layout, point)))
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
    fn of(rows: &Rows, joint: usize, layout: &Layout, point: &Point) -> Self {
        let friction = &point.friction[joint];
        let period_s = rows.motion.period_s;
        let friction_v = rows.friction_raw_v(joint, friction);
        let net_v: Vec<f64> =
            rows.motion.command_v[joint].iter().zip(&friction_v).map(|(u, f)| u - f).collect();
        let slope = |signal: &[f64]| rows.sampler.take(&derivative::first(signal, period_s));
        let mut columns =
            vec![(joint, slope(&rows.motion.command_v[joint])), (3 + joint, slope(&friction_v))];
        if let Some(rigid) = &point.rigid {
            let slope = rigid.coriolis_slope(&rows.motion, joint);
            columns.push((CORIOLIS_LAG, rows.sampler.take(&slope)));
        }
        let mine: Vec<(usize, usize)> = layout
            .free
            .iter()
            .enumerate()
            .filter(|(_, free)| free.0 == joint)
            .map(|(index, free)| (TIMING_COUNT + index, free.1))
            .collect();
        columns.par_extend(mine.into_par_iter().map(|(place, parameter)| {
            (place, sensitivity(rows, joint, friction, parameter, &friction_v))
        }));
        Self { right: rows.sampler.take(&net_v), columns }
    }
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
    /// Solves with the given weights, or with those that follow from the residuals.
    fn of(
        stack: &Stack,
        prior: &LinearProblem,
        block_s: f64,
        weight: Option<Vec<f64>>,
    ) -> Option<Self> {
        let solve = |weight: &[f64]| {
            let (parameters, unit) = with_prior(&stack.problem, weight, prior).solve_fast()?;
            let residuals = &stack.problem.right - &stack.problem.rows * &parameters;
            Some((parameters, unit, residuals))
        };
        let weight = match weight {
            Some(weight) => weight,
            None => {
                // A hundredth of a volt is about what unrefined friction leaves.
                let (_, _, first) = solve(&vec![1e4; stack.origin.len()])?;
                let (_, _, second) = solve(&stack.weights(&first, true))?;
                stack.weights(&second, true)
            }
        };
        let (parameters, unit, residuals) = solve(&weight)?;
        let weighted = stack.problem.clone().weighted(&weight);
        let left = &weighted.right - &weighted.rows * &parameters;
        let blocks = stack.blocks(block_s);
        let scores = meat(&weighted.rows, &left, &blocks);
        let known = prior.rows.tr_mul(&prior.rows);
        // Residuals of a fit are smaller than the errors: one block is spent per parameter
        // that the data, not the prior, determine.
        let determined = unit.ncols() as f64 - (&unit * &known).trace();
        let blocks = blocks.len() as f64;
        let spent = blocks / (blocks - determined).max(1.0);
        let covariance = &unit * (scores * spent + known) * &unit;
        Some(Self { parameters, covariance, residuals, weight })
    }
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
