//! Effects that change friction.

use super::candidate::{Candidate, free};
use crate::base::Base;
use crate::fit::{Field, Unknown};
use crate::over_speed::SPEEDS;

/// The part of the motor's torque that friction in a gear may take: four tenths were measured.
pub const MOST_LOST: f64 = 0.6;
/// The part of the torque on the joint that friction may take.
const MOST_OF_LOAD: f64 = 0.9;

/// All that are tried.
pub fn effects(base: &Base) -> Vec<Candidate> {
    vec![
        by_motor_torque(base),
        stribeck(base),
        one_way("viscous_asymmetry", Field::ViscousAsymmetry),
        one_way("asymmetric_friction", Field::Asymmetry),
        drag(base),
        drift(),
        load_friction(base, Field::JointLoadFriction, MOST_OF_LOAD),
    ]
}

/// Friction by the motor's torque [V/Nm].
pub fn by_motor_torque(base: &Base) -> Candidate {
    load_friction(base, Field::MotorLoadFriction, MOST_LOST)
}

/// Friction over speed by a table up to the speed `top` [rad/s; m/s], values in V: what no formula holds, within a
/// level and a fifth of what viscous friction is there.
pub fn over_speed(base: &Base, top: f64) -> Candidate {
    let servo = &base.fitted.servo;
    let size = servo.coulomb.max(0.01) + 0.2 * servo.viscous * top;
    let value = |knot| free(Field::OverSpeed(knot), [-0.9 * size, 4.0 * size], 0.1 * size);
    let count = SPEEDS.len() as u8;
    let unknowns = (0..count).map(value).collect();
    let found = Candidate::new("friction_over_speed", unknowns, vec![vec![0.0; SPEEDS.len()]]);
    Candidate { fixed: vec![(Field::OverSpeedTop, top)], ..found }
}

/// Friction by a torque, of which it takes no more than a part.
fn load_friction(base: &Base, field: Field, most: f64) -> Candidate {
    let one = 1.0 / base.fitted.servo.torque_constant;
    let coefficient = free(field, [0.0, most * one], 0.2 * one);
    let starts = [0.02, 0.3].map(|part| vec![part * one]).to_vec();
    Candidate::new("load_friction", vec![coefficient], starts)
}

fn stribeck(base: &Base) -> Candidate {
    let level = base.fitted.servo.coulomb.max(0.01);
    let velocity = Unknown::positive(Field::StribeckVelocity, 0.1, 0.7);
    let unknowns = vec![
        free(Field::Stribeck, [0.0, 4.0 * level], 0.3 * level),
        Unknown { low: 0.01, high: 1.0, ..velocity },
    ];
    Candidate::new("stribeck", unknowns, vec![vec![0.2 * level, 0.1], vec![0.1 * level, 0.5]])
}

/// More of it one way than the other.
fn one_way(effect: &'static str, field: Field) -> Candidate {
    Candidate::of_one(effect, free(field, [-0.9, 0.9], 0.2), 0.0)
}

/// Viscous friction that grows less than with the velocity, or, in air, more. Air drags little on an arm:
/// at 1 rad/s less than a tenth of what the viscous friction of its gears does.
fn drag(base: &Base) -> Candidate {
    let viscous = base.fitted.servo.viscous.max(0.01);
    let drag = free(Field::Drag, [-2.0 * viscous, 0.1 * viscous], 0.2 * viscous);
    // At a few rad/s a larger step is no slope.
    let drag = Unknown { step: 2e-3 * viscous, ..drag };
    let starts = [-0.1, 0.02].map(|part| vec![part * viscous]).to_vec();
    Candidate::new("quadratic_drag", vec![drag], starts)
}

fn drift() -> Candidate {
    let usual_s = 40.0;
    let time = Unknown::positive(Field::DriftTime, usual_s, 1.0);
    let unknowns =
        vec![free(Field::Drift, [-0.9, 3.0], 0.2), Unknown { low: 0.3, high: 600.0, ..time }];
    let drift = Candidate::new(
        "friction_drift",
        unknowns,
        [usual_s, 5.0, 1.0].map(|time_s| vec![-0.1, time_s]).to_vec(),
    );
    Candidate { fixed: vec![(Field::DriftTime, usual_s)], ..drift }
}
