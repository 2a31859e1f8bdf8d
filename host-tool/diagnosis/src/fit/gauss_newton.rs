//! Fits of a model to the train logs: Gauss-Newton steps with a prior.

use super::linearisation::Linearisation;
use super::normal_equations::{objective, train_rows};
use super::unknowns::{Expected, Unknown, expected, kept_physical, range};
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, Rows};
use crate::trial::hypothesis::Hypothesis;
use crate::trial::residual_rows::train_residual_rows;
use crate::trial::warmth::WARMTH_VALUES;

/// Fits a model with everything open in it; `None` where the numbers do not work out.
pub fn fit(
    evidence: &Evidence,
    subject: &Subject,
    start: Hypothesis,
    most_steps: usize,
) -> Option<Linearisation> {
    let mut open = open_in(evidence, subject, &start);
    let mut best = Linearisation::of(evidence, start, open.clone())?;
    for _ in 0..most_steps {
        let Some((next, _, objective)) = improved(evidence, subject, &best, &open) else { break };
        let gain = best.objective - objective;
        lags_about_others(&mut open, &next, subject);
        best = Linearisation::of(evidence, next, open.clone())?;
        if gain < subject.criteria.fit.converged_part * best.objective {
            break;
        }
    }
    Some(best)
}

/// A fit that keeps the slopes of where it begins: each step costs but the residual.
pub fn fit_with_slopes(
    evidence: &Evidence,
    subject: &Subject,
    mut best: Linearisation,
    most_steps: usize,
) -> Linearisation {
    for _ in 0..most_steps {
        let open = best.expected.clone();
        let Some((next, residual, objective)) = improved(evidence, subject, &best, &open) else {
            break;
        };
        let gain = best.objective - objective;
        best = best.moved_to(next, residual, objective);
        if gain < subject.criteria.fit.converged_part * best.objective {
            break;
        }
    }
    best
}

/// A fitted model brought back to where base parameters, Coulomb and viscous friction and lags are
/// no further than a few deviations from what is known of them, by the slopes that it has.
pub fn fit_held(
    evidence: &Evidence,
    subject: &Subject,
    fitted: &Linearisation,
) -> Option<Linearisation> {
    let within = subject.criteria.fit.within_deviations;
    let mut best = fitted.clone();
    for _ in 0..subject.criteria.fit.bound_rounds {
        let held = held(evidence, subject, best, within)?;
        let better = improved(evidence, subject, &held, &held.expected);
        best = better.map_or(held.clone(), |(next, residual, objective)| {
            held.moved_to(next, residual, objective)
        });
    }
    held(evidence, subject, best, within)
}

/// The same with what lies more than `within` deviations off fixed there; what shapes friction follows,
/// so that it stays friction.
fn held(
    evidence: &Evidence,
    subject: &Subject,
    linear: Linearisation,
    within: f64,
) -> Option<Linearisation> {
    let (mut open, mut hypothesis) = (linear.expected.clone(), linear.hypothesis.clone());
    if !hold(&mut open, &mut hypothesis, within) {
        return Some(linear);
    }
    kept_physical(&mut hypothesis, subject);
    let residual = train_residual_rows(evidence, &hypothesis);
    let objective = objective(&residual, &linear.train, &hypothesis, &open);
    linear.with_known(open).map(|linear| linear.moved_to(hypothesis, residual, objective))
}

/// Fixes what lies more than `within` deviations off there, and says whether anything does.
fn hold(open: &mut [Expected], hypothesis: &mut Hypothesis, within: f64) -> bool {
    const FIXED: f64 = 1e-3;
    let mut any = false;
    for expected in open {
        let deviations = (expected.unknown.get(hypothesis) - expected.mean) / expected.deviation;
        let is_effect = matches!(expected.unknown, Unknown::Effect { .. } | Unknown::Table { .. });
        let may_be_held = !is_effect && !expected.unknown.shapes_friction();
        if may_be_held && deviations.abs() > within {
            expected.mean += within * expected.deviation * deviations.signum();
            expected.deviation *= FIXED;
            expected.unknown.set(hypothesis, expected.mean);
            any = true;
        }
    }
    any
}

/// A better hypothesis along the step, what it leaves, and its objective; or none.
fn improved(
    evidence: &Evidence,
    subject: &Subject,
    best: &Linearisation,
    open: &[Expected],
) -> Option<(Hypothesis, Rows, f64)> {
    let step = best.step_within(|unknown| range(unknown, &best.hypothesis, subject));
    if best.gain_of(&step) < subject.criteria.fit.least_step_gain {
        return None;
    }
    let train = train_rows(evidence);
    [1.0, 0.5, 0.2, 0.05].into_iter().find_map(|part| {
        let mut hypothesis = best.moved(&step, part);
        kept_physical(&mut hypothesis, subject);
        for effect in &mut hypothesis.effects {
            effect.normalise();
        }
        let residual = train_residual_rows(evidence, &hypothesis);
        let objective = objective(&residual, &train, &hypothesis, open);
        (objective < best.objective).then_some((hypothesis, residual, objective))
    })
}

/// Everything open in a model with these effects and tables; those that the model as given holds
/// already are not.
pub fn open_in(evidence: &Evidence, subject: &Subject, hypothesis: &Hypothesis) -> Vec<Expected> {
    let mut open = expected(subject, evidence.stretches[0].sampled_s);
    let late: Vec<usize> = hypothesis.late_joints(subject.known_effects.len()).collect();
    let part = subject.criteria.prior.lag_beside_lateness;
    open.iter_mut().filter(|e| is_lag_of(&late, e)).for_each(|lag| lag.deviation *= part);
    lags_about_others(&mut open, hypothesis, subject);
    open.extend(warmths(evidence, subject));
    let effects = hypothesis.effects.iter().enumerate().skip(subject.known_effects.len());
    for (index, effect) in effects {
        for (value, parameter) in effect.definition.parameters.iter().enumerate() {
            if parameter.kind.is_tried() {
                continue;
            }
            let unknown = Unknown::Effect { index, value };
            // So wide that it only keeps what the logs do not tell where it is.
            let deviation = 0.5 * (parameter.highest - parameter.lowest);
            open.push(Expected::new(unknown, effect.values[value], deviation));
        }
    }
    let tables = hypothesis.tables.iter().enumerate().skip(subject.known_tables.len());
    for (index, table) in tables {
        let deviation = subject.table_deviations_v[usize::from(table.joint.max(1)) - 1];
        let of_knot = |knot| Expected::new(Unknown::Table { index, knot }, 0.0, deviation);
        open.extend((0..table.knots.len()).map(of_knot));
    }
    open
}

/// What friction may have more of in train logs, where they asked for it.
fn warmths(evidence: &Evidence, subject: &Subject) -> Vec<Expected> {
    if !subject.warms {
        return Vec::new();
    }
    let mut logs: Vec<usize> =
        evidence.stretches[..evidence.train_stretches()].iter().map(|s| s.log).collect();
    logs.dedup();
    let deviation = subject.criteria.prior.warmth;
    let of = |(joint, log): (usize, usize)| {
        let unknown = move |value| Unknown::Warmth { joint, log, value };
        (0..WARMTH_VALUES).map(move |value| Expected::new(unknown(value), 0.0, deviation))
    };
    let joints = subject.joints.iter();
    joints.flat_map(|&joint| logs.iter().map(move |&log| (joint, log))).flat_map(of).collect()
}

/// Puts the means of lags beside effects that make commands late to the lag of the other joints: the log tells instants of
/// all joints alike, or a lag would be told as another one and a delay.
fn lags_about_others(open: &mut [Expected], hypothesis: &Hypothesis, subject: &Subject) {
    let late: Vec<usize> = hypothesis.late_joints(subject.known_effects.len()).collect();
    for lag in open.iter_mut().filter(|e| is_lag_of(&late, e)) {
        let Unknown::Lag(joint) = lag.unknown else { continue };
        lag.mean = hypothesis.lag_of_others_s(joint);
    }
}

fn is_lag_of(joints: &[usize], expected: &Expected) -> bool {
    matches!(expected.unknown, Unknown::Lag(joint) if joints.contains(&joint))
}
