//! What a model under trial leaves open, and what is known of it beforehand.

use model::BaseParameters;
use model::base::COUNT;

use crate::logs::subject::Subject;
use crate::trial::hypothesis::Hypothesis;
use model::Friction;
use model::friction_parameters::COUNT as FRICTION_COUNT;

/// Places of a joint's friction parameters.
const COULOMB: usize = 0;
const STRIBECK_LEVEL: usize = 1;
const STRIBECK_VELOCITY: usize = 2;
const VISCOUS: usize = 3;
const STIFFNESS: usize = 4;
const DAMPING: usize = 5;

/// Most by which one step of a fit multiplies or divides what shapes friction about standstill.
const STEP_FACTOR: f64 = 4.0;

/// One open parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// A base parameter.
    Base(usize),
    /// A friction parameter of a joint.
    Friction {
        /// Joint, 0 to 2.
        joint: usize,
        /// Which of the six.
        parameter: usize,
    },
    /// The lag of a joint's command.
    Lag(usize),
    /// By how much a joint's friction runs ahead of its velocity.
    FrictionLead(usize),
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
}

/// Everything that a refit may change.
pub fn expected(subject: &Subject, period_s: f64) -> Vec<Expected> {
    let base = subject.robot.base.to_array();
    let prior = &subject.criteria.prior;
    let scales = base_scales(&subject.robot.base);
    let mut all: Vec<Expected> = subject
        .free_base()
        .into_iter()
        .map(|k| Expected {
            unknown: Unknown::Base(k),
            mean: base[k],
            deviation: prior.relative * base[k].abs() + prior.of_largest * scales[k],
        })
        .collect();
    for &joint in &subject.joints {
        let values = subject.robot.friction[joint].to_array();
        all.extend((0..FRICTION_COUNT).map(|parameter| Expected {
            unknown: Unknown::Friction { joint, parameter },
            mean: values[parameter],
            deviation: friction_deviation(&values, parameter, subject),
        }));
        all.push(Expected {
            unknown: Unknown::Lag(joint),
            mean: 0.0,
            deviation: prior.lag_periods * period_s,
        });
        all.push(Expected {
            unknown: Unknown::FrictionLead(joint),
            mean: 0.0,
            deviation: prior.friction_lead_s,
        });
    }
    all
}

fn friction_deviation(values: &[f64; FRICTION_COUNT], parameter: usize, subject: &Subject) -> f64 {
    let (prior, bristles_known) = (&subject.criteria.prior, subject.bristles_known);
    let own = prior.friction * values[parameter].abs();
    let shape = prior.friction_shape * values[parameter].abs();
    let least = match parameter {
        STRIBECK_LEVEL => prior.friction_shape_level * values[COULOMB],
        // Identification gives zero where it is small, and the truth may differ.
        VISCOUS => own.max(prior.viscous * values[COULOMB]),
        STIFFNESS => shape,
        DAMPING if !bristles_known => prior.unknown_damping * values[STIFFNESS],
        DAMPING => shape.max(prior.damping * values[STIFFNESS]),
        STRIBECK_VELOCITY => shape.max(1e-6),
        _ => own,
    };
    prior.relative * values[parameter].abs() + least
}

/// The largest parameter of each one's kind: inertias and first moments, link by link.
fn base_scales(base: &BaseParameters<f64>) -> [f64; COUNT] {
    let (first, second) = (base.zz1r.abs().min(1e3), base.zz2r.abs().min(1e3));
    let third = (base.zz3r + base.ia3).abs();
    let moment2 = base.mx2r.hypot(base.my2r);
    let moment3 = match base.mx3r.hypot(base.my3r) {
        // A balanced link may yet be slightly off balance: its scale is that of its inertia at 1 m.
        0.0 => third,
        moment => moment,
    };
    BaseParameters {
        zz1r: first,
        xx2r: second,
        xy2r: second,
        xz2r: second,
        yz2r: second,
        zz2r: second,
        mx2r: moment2,
        my2r: moment2,
        xx3r: third,
        xy3r: third,
        xz3r: third,
        yz3r: third,
        zz3r: third,
        mx3r: moment3,
        my3r: moment3,
        ia3: third,
    }
    .to_array()
}

impl Unknown {
    /// Whether it shapes a joint's friction around standstill, of which little is known beforehand.
    pub fn shapes_friction(self) -> bool {
        match self {
            Self::Friction { parameter, .. } => parameter != COULOMB && parameter != VISCOUS,
            Self::FrictionLead(_) => true,
            _ => false,
        }
    }

    /// Its value at a hypothesis.
    pub fn get(self, hypothesis: &Hypothesis) -> f64 {
        match self {
            Self::Base(k) => hypothesis.robot.base.to_array()[k],
            Self::Friction { joint, parameter } => {
                hypothesis.robot.friction[joint].to_array()[parameter]
            }
            Self::Lag(joint) => hypothesis.lag_s[joint],
            Self::FrictionLead(joint) => hypothesis.friction_lead_s[joint],
            Self::Table { index, knot } => hypothesis.tables[index].values_v[knot],
            Self::Effect { index, value } => hypothesis.effects[index].values[value],
        }
    }

    /// Sets its value at a hypothesis.
    pub fn set(self, hypothesis: &mut Hypothesis, to: f64) {
        match self {
            Self::Base(k) => {
                let mut base = hypothesis.robot.base.to_array();
                base[k] = to;
                hypothesis.robot.base = BaseParameters::from_array(base);
            }
            Self::Friction { joint, parameter } => {
                let friction = &mut hypothesis.robot.friction[joint];
                let mut values = friction.to_array();
                values[parameter] = to;
                *friction = Friction::from_array(values);
            }
            Self::Lag(joint) => hypothesis.lag_s[joint] = to,
            Self::FrictionLead(joint) => hypothesis.friction_lead_s[joint] = to,
            Self::Table { index, knot } => hypothesis.tables[index].values_v[knot] = to,
            Self::Effect { index, value } => hypothesis.effects[index].values[value] = to,
        }
    }
}

/// Where a parameter of friction is one of friction.
fn physical(unknown: Unknown, hypothesis: &Hypothesis, subject: &Subject) -> [f64; 2] {
    let Unknown::Friction { joint, parameter } = unknown else {
        return [f64::NEG_INFINITY, f64::INFINITY];
    };
    let bounds = &subject.criteria.prior;
    let given = subject.robot.friction[joint].to_array()[parameter];
    let least = match parameter {
        COULOMB => bounds.least_coulomb * given,
        STRIBECK_LEVEL => -bounds.most_stribeck_drop * hypothesis.robot.friction[joint].alpha0_v,
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

/// Friction parameters kept where friction is friction.
pub fn kept_physical(hypothesis: &mut Hypothesis, subject: &Subject) {
    for joint in 0..subject.robot.friction.len() {
        // Coulomb friction comes first, for it bounds the Stribeck level.
        for parameter in 0..FRICTION_COUNT {
            let unknown = Unknown::Friction { joint, parameter };
            let [least, most] = physical(unknown, hypothesis, subject);
            unknown.set(hypothesis, unknown.get(hypothesis).max(least).min(most));
        }
    }
}
