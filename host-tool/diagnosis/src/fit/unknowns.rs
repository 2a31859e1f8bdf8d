//! What a model under trial leaves open, and what is known of it beforehand.

use crate::logs::subject::{STIFFNESS, Subject};
use crate::trial::hypothesis::Hypothesis;
use model::Friction;
use model::friction_parameters::COUNT as FRICTION_COUNT;

/// Places of a joint's friction parameters.
const COULOMB: usize = 0;
const STRIBECK_LEVEL: usize = 1;
const STRIBECK_VELOCITY: usize = 2;
const VISCOUS: usize = 3;
const DAMPING: usize = 5;

/// Most by which one step of a fit multiplies or divides what shapes friction about standstill.
const STEP_FACTOR: f64 = 4.0;

/// Part of Coulomb friction, of the Stribeck velocity and of the bristles' stiffness within which friction
/// about standstill changes along its slopes.
const LINEAR_PART: f64 = 0.5;

/// One open parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// A base parameter.
    Base(usize),
    /// A friction parameter of a joint.
    Friction {
        /// Joint, from 0.
        joint: usize,
        /// Which of the six.
        parameter: usize,
    },
    /// The lag of a joint's command.
    Lag(usize),
    /// By how much a joint's dry friction runs ahead of its velocity.
    FrictionLead(usize),
    /// The part of every motor's torque by which friction grows.
    GearLoss,
    /// What a joint's friction has more of in a log.
    Warmth {
        /// Joint, from 0.
        joint: usize,
        /// Index of the log.
        log: usize,
        /// Which of its two parts.
        value: usize,
    },
    /// The value of a table at one of its knots.
    Table {
        /// Which table.
        index: usize,
        /// Which of its knots.
        knot: usize,
    },
    /// A parameter of an effect.
    Effect {
        /// Which effect.
        index: usize,
        /// Which of its values.
        value: usize,
    },
}

/// A parameter with its expectation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The parameter.
    pub unknown: Unknown,
    /// Expected value.
    pub mean: f64,
    /// Standard deviation of the truth about it.
    pub deviation: f64,
    /// Deviation that counts where a model is asked whether it is another robot's: no smaller than links' values and
    /// the usual doubt leave. The standard error of what was identified tells what noise left of it, and friction of
    /// another law may have bent it by more.
    pub tolerance: f64,
}

impl Expected {
    /// A parameter whose tolerance is its deviation.
    pub fn new(unknown: Unknown, mean: f64, deviation: f64) -> Self {
        Self { unknown, mean, deviation, tolerance: deviation }
    }

    /// The same with a tolerance no smaller than this.
    pub fn tolerating(self, least: f64) -> Self {
        Self { tolerance: self.tolerance.max(least), ..self }
    }
}

/// Everything that a refit may change.
pub fn expected(subject: &Subject, period_s: f64) -> Vec<Expected> {
    let prior = &subject.criteria.prior;
    let mut all: Vec<Expected> = subject
        .base_deviations()
        .into_iter()
        .map(|(k, deviation)| Expected::new(Unknown::Base(k), subject.plant.base(k), deviation))
        .collect();
    for (expected, by_links) in all.iter_mut().zip(subject.link_spread.by_links()) {
        *expected = expected.tolerating(by_links);
    }
    for &joint in &subject.joints {
        let values = subject.plant.friction[joint].to_array();
        all.extend((0..FRICTION_COUNT).map(|parameter| {
            let usual = usual_friction_deviation(&values, joint, parameter, subject);
            let deviation = told_friction_deviation(&values, joint, parameter, subject);
            let unknown = Unknown::Friction { joint, parameter };
            Expected::new(unknown, values[parameter], deviation.unwrap_or(usual)).tolerating(usual)
        }));
        all.push(Expected::new(Unknown::Lag(joint), 0.0, prior.lag_periods * period_s));
        all.push(Expected::new(Unknown::FrictionLead(joint), 0.0, prior.friction_lead_s));
    }
    if subject.gears_lose {
        all.push(Expected::new(Unknown::GearLoss, 0.0, prior.gear_loss));
    }
    all
}

/// What a file tells of a friction parameter.
fn told_friction_deviation(
    values: &[f64; FRICTION_COUNT],
    joint: usize,
    parameter: usize,
    subject: &Subject,
) -> Option<f64> {
    let told = subject.friction_deviations[joint][parameter]?;
    matches!(parameter, COULOMB | VISCOUS | DAMPING).then(|| told.max(1e-6 * values[COULOMB]))
}

fn usual_friction_deviation(
    values: &[f64; FRICTION_COUNT],
    joint: usize,
    parameter: usize,
    subject: &Subject,
) -> f64 {
    let prior = &subject.criteria.prior;
    let own = prior.friction * values[parameter].abs();
    let shape = prior.friction_shape * values[parameter].abs();
    let least = match parameter {
        STRIBECK_LEVEL => prior.friction_shape_level * values[COULOMB],
        // Identification gives zero where it is small, and the truth may differ.
        VISCOUS => own.max(prior.viscous * values[COULOMB]),
        STIFFNESS => shape,
        DAMPING if !subject.knows_bristles(joint) => prior.unknown_damping * values[STIFFNESS],
        DAMPING => shape.max(prior.damping * values[STIFFNESS]),
        STRIBECK_VELOCITY => shape.max(1e-6),
        _ => own,
    };
    prior.relative_friction * values[parameter].abs() + least
}

impl Unknown {
    /// Whether it shapes friction in a way of which little is known beforehand: a joint's around standstill, or all
    /// joints' by what their gears take. A search begins where these are refitted: begun without a loss of gears that is
    /// there, it misses loads, while a load that is missing takes the loss back once it is found.
    pub fn shapes_friction(self) -> bool {
        match self {
            Self::Friction { parameter, .. } => parameter != COULOMB && parameter != VISCOUS,
            Self::FrictionLead(_) | Self::GearLoss | Self::Warmth { .. } => true,
            _ => false,
        }
    }

    /// The joint (from 0) whose friction or command it is of; none where it is the arm's, or an effect's.
    pub fn own_joint(self) -> Option<usize> {
        match self {
            Self::Friction { joint, .. }
            | Self::Lag(joint)
            | Self::FrictionLead(joint)
            | Self::Warmth { joint, .. } => Some(joint),
            _ => None,
        }
    }

    /// How far slopes along it hold, where that is not far: a peak of friction at a few mrad/s is another
    /// curve once its level or its velocity has changed by half.
    pub fn linear_range(self, hypothesis: &Hypothesis) -> Option<f64> {
        let Self::Friction { joint, parameter } = self else { return None };
        let values = hypothesis.plant.friction[joint].to_array();
        match parameter {
            STRIBECK_LEVEL => Some(LINEAR_PART * values[COULOMB]),
            STRIBECK_VELOCITY | STIFFNESS => Some(LINEAR_PART * values[parameter]),
            _ => None,
        }
    }

    /// Its value at a hypothesis.
    pub fn get(self, hypothesis: &Hypothesis) -> f64 {
        match self {
            Self::Base(k) => hypothesis.plant.base(k),
            Self::Friction { joint, parameter } => {
                hypothesis.plant.friction[joint].to_array()[parameter]
            }
            Self::Lag(joint) => hypothesis.lag_s[joint],
            Self::FrictionLead(joint) => hypothesis.friction_lead_s[joint],
            Self::GearLoss => hypothesis.gear_loss,
            Self::Warmth { joint, log, value } => {
                hypothesis.warmth(joint, log).unwrap_or_default().parts[value]
            }
            Self::Table { index, knot } => hypothesis.tables[index].values_v[knot],
            Self::Effect { index, value } => hypothesis.effects[index].values[value],
        }
    }

    /// Sets its value at a hypothesis.
    pub fn set(self, hypothesis: &mut Hypothesis, to: f64) {
        match self {
            Self::Base(k) => hypothesis.plant.set_base(k, to),
            Self::Friction { joint, parameter } => {
                let friction = &mut hypothesis.plant.friction[joint];
                let mut values = friction.to_array();
                values[parameter] = to;
                *friction = Friction::from_array(values);
            }
            Self::Lag(joint) => hypothesis.lag_s[joint] = to,
            Self::FrictionLead(joint) => hypothesis.friction_lead_s[joint] = to,
            Self::GearLoss => hypothesis.gear_loss = to,
            Self::Warmth { joint, log, value } => {
                hypothesis.warmths.entry((joint, log)).or_default().parts[value] = to;
            }
            Self::Table { index, knot } => hypothesis.tables[index].values_v[knot] = to,
            Self::Effect { index, value } => hypothesis.effects[index].values[value] = to,
        }
    }
}

/// Where a parameter is physical: one of friction, or what gears take.
fn physical(unknown: Unknown, hypothesis: &Hypothesis, subject: &Subject) -> [f64; 2] {
    if unknown == Unknown::GearLoss {
        return [0.0, subject.criteria.prior.most_gear_loss];
    }
    let Unknown::Friction { joint, parameter } = unknown else {
        return [f64::NEG_INFINITY, f64::INFINITY];
    };
    let bounds = &subject.criteria.prior;
    let given = subject.plant.friction[joint].to_array()[parameter];
    let least = match parameter {
        COULOMB => bounds.least_coulomb * given,
        STRIBECK_LEVEL => -bounds.most_stribeck_drop * hypothesis.plant.friction[joint].alpha0_v,
        STRIBECK_VELOCITY => bounds.least_stribeck_velocity * given,
        STIFFNESS => bounds.least_bristle_stiffness * given,
        _ => 0.0,
    };
    [least, f64::INFINITY]
}

/// Where one step of a fit may take a parameter: where it is physical, and for what shapes friction
/// about standstill, whose slopes hold but near by, no further than by a factor.
pub fn range(unknown: Unknown, hypothesis: &Hypothesis, subject: &Subject) -> [f64; 2] {
    let [least, most] = physical(unknown, hypothesis, subject);
    match unknown {
        Unknown::Friction { parameter: STRIBECK_VELOCITY | STIFFNESS, .. } => {
            let now = unknown.get(hypothesis);
            [least.max(now / STEP_FACTOR), now * STEP_FACTOR]
        }
        _ => [least, most],
    }
}

/// Parameters of friction kept where it is friction.
pub fn kept_physical(hypothesis: &mut Hypothesis, subject: &Subject) {
    for joint in 0..subject.plant.friction.len() {
        // Coulomb friction comes first, for it bounds the Stribeck level.
        for parameter in 0..FRICTION_COUNT {
            let unknown = Unknown::Friction { joint, parameter };
            let [least, most] = physical(unknown, hypothesis, subject);
            unknown.set(hypothesis, unknown.get(hypothesis).max(least).min(most));
        }
    }
    let most = subject.criteria.prior.most_gear_loss;
    hypothesis.gear_loss = hypothesis.gear_loss.clamp(0.0, most);
}
