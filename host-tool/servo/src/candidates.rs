//! Effects on one joint that are tried over the refitted base.

use crate::base::Base;
use crate::fit::{Field, Unknown};
use crate::joint::ServoJoint;
use crate::judged::Judged;

/// An effect with what is fitted of it and where the search begins.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Its name in reports.
    pub effect: &'static str,
    /// Its parameters.
    pub unknowns: Vec<Unknown>,
    /// Values to begin with, one per parameter, for each start.
    pub starts: Vec<Vec<f64>>,
    /// What else is set, to what.
    pub fixed: Vec<(Field, f64)>,
}

impl Candidate {
    /// All fields that it sets.
    pub fn fields(&self) -> impl Iterator<Item = Field> {
        let fitted = self.unknowns.iter().map(|unknown| unknown.field);
        fitted.chain(self.fixed.iter().map(|(field, _)| *field))
    }

    /// The joint with the effect at a start.
    pub fn start(&self, servo: &ServoJoint, values: &[f64]) -> ServoJoint {
        let mut start = *servo;
        self.fixed.iter().for_each(|(field, value)| field.set(&mut start, *value));
        for (unknown, value) in self.unknowns.iter().zip(values) {
            unknown.field.set(&mut start, *value);
        }
        start
    }
}

/// What a joint did in the logs.
#[derive(Clone, Copy, Debug)]
pub struct Typical {
    /// Largest voltage that its law asks for, distance to the goal times stiffness [V].
    pub volts: f64,
    /// Mean position [rad].
    pub position: f64,
    /// How far it went [rad].
    pub range: f64,
    /// Largest share of gravity in its voltage [V].
    pub gravity_volts: f64,
}

impl Typical {
    /// Of a joint (from 0).
    pub fn of(base: &Base, logs: &[&Judged], joint: usize) -> Self {
        let tracks = || logs.iter().map(|log| &log.record.joints[joint]);
        let servo = &base.fitted.servo;
        let pairs = tracks().flat_map(|track| track.goal.iter().zip(&track.position));
        let distance = pairs.map(|(g, q)| (g - q).abs()).fold(0.0, f64::max);
        let positions = || tracks().flat_map(|track| track.position.iter().copied());
        let (low, high) =
            positions().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), q| (l.min(q), h.max(q)));
        let loads = logs.iter().flat_map(|log| &log.along[joint]);
        let load = loads.map(|row| (row.gravity + row.constant).abs()).fold(0.0, f64::max);
        Self {
            volts: servo.stiffness * distance,
            position: 0.5 * (low + high),
            range: high - low,
            gravity_volts: load / servo.torque_constant,
        }
    }
}

fn candidate(effect: &'static str, unknowns: Vec<Unknown>, starts: Vec<Vec<f64>>) -> Candidate {
    Candidate { effect, unknowns, starts, fixed: Vec::new() }
}

/// All effects that are tried on a joint; `cogging` lists orders per turn.
pub fn of_joint(base: &Base, typical: &Typical, cogging: &[f64]) -> Vec<Candidate> {
    let servo = &base.fitted.servo;
    let (level, viscous) = (servo.coulomb.max(0.01), servo.viscous.max(0.01));
    let volts = level.max(0.02);
    let free =
        |field, bounds, size: f64| Unknown::between(field, bounds, (0.0, 10.0 * size), 0.1 * size);
    let parts = |field| free(field, [-0.9, 0.9], 0.2);
    let top = typical.volts.min(servo.limit);
    let mut all = vec![
        candidate(
            "saturation",
            vec![Unknown {
                low: 1.2 * level,
                high: NEAREST_LIMIT * servo.limit,
                ..Unknown::positive(Field::Limit, top, 3.0)
            }],
            vec![vec![0.7 * top], vec![0.4 * top]],
        ),
        candidate(
            "load_friction",
            vec![free(
                Field::MotorLoadFriction,
                [0.0, MOST_LOST / servo.torque_constant],
                0.2 / servo.torque_constant,
            )],
            vec![vec![0.3 / servo.torque_constant]],
        ),
        candidate(
            "stribeck",
            vec![
                free(Field::Stribeck, [0.0, 4.0 * level], 0.3 * level),
                Unknown {
                    low: 0.01,
                    high: 1.0,
                    ..Unknown::positive(Field::StribeckVelocity, 0.1, 0.7)
                },
            ],
            vec![vec![0.2 * level, 0.1]],
        ),
        candidate("viscous_asymmetry", vec![parts(Field::ViscousAsymmetry)], vec![vec![0.0]]),
        candidate("asymmetric_friction", vec![parts(Field::Asymmetry)], vec![vec![0.0]]),
        candidate(
            "quadratic_drag",
            vec![free(Field::Drag, [-2.0 * viscous, 0.0], 0.2 * viscous)],
            vec![vec![-0.1 * viscous]],
        ),
        candidate("actuator_lag", vec![free(Field::Lag, [1e-3, 0.3], 0.02)], vec![vec![0.02]]),
        candidate(
            "dead_zone",
            vec![free(Field::DeadZone, [0.0, 5.0 * volts], 0.3 * volts)],
            vec![vec![0.3 * volts]],
        ),
        candidate("backlash", vec![free(Field::Gap, [0.0, 0.3], 0.01)], vec![vec![0.01]]),
        candidate(
            "dac_offset",
            vec![free(Field::Offset, [-10.0 * volts, 10.0 * volts], volts)],
            vec![vec![0.0]],
        ),
        Candidate {
            fixed: vec![(Field::DriftTime, 40.0)],
            ..candidate(
                "friction_drift",
                vec![
                    free(Field::Drift, [-0.9, 3.0], 0.2),
                    Unknown {
                        low: 3.0,
                        high: 600.0,
                        ..Unknown::positive(Field::DriftTime, 40.0, 1.0)
                    },
                ],
                vec![vec![-0.1, 40.0]],
            )
        },
        delay(base),
    ];
    if typical.gravity_volts > volts {
        all.push(candidate(
            "encoder_offset",
            vec![free(Field::EncoderOffset, [-1.0, 1.0], 0.1)],
            vec![vec![0.0]],
        ));
        let of_joint = vec![free(
            Field::JointLoadFriction,
            [0.0, 0.9 / servo.torque_constant],
            0.2 / servo.torque_constant,
        )];
        all.push(candidate("load_friction", of_joint, vec![vec![0.3 / servo.torque_constant]]));
    }
    if typical.range > SPRING_RANGE_RAD {
        all.push(cable_spring(typical, volts));
    }
    all.extend(cogging.iter().map(|order| self::cogging(*order, volts)));
    all
}

/// A limit that is nearer to the one that is known is an error of the drive's gains.
const NEAREST_LIMIT: f64 = 0.85;

/// The part of the motor's torque that friction in a gear may take: four tenths were measured.
pub const MOST_LOST: f64 = 0.6;

/// Below this a spring is an offset [rad].
const SPRING_RANGE_RAD: f64 = 0.3;

/// Goals act late; beyond what the row's own timing can be.
fn delay(base: &Base) -> Candidate {
    let late = Unknown::between(Field::Delay, [0.0, 0.2], (0.0, 0.2), 0.003);
    // Where the row's timing is within its bounds nothing is late.
    let starts = if base.fitted.servo.read_after_s > 1e-3 { vec![] } else { vec![vec![0.01]] };
    candidate("delay", vec![late], starts)
}

fn cable_spring(typical: &Typical, volts: f64) -> Candidate {
    let size = volts / typical.range;
    let rest = typical.position;
    let spring =
        Unknown::between(Field::Spring, [0.0, 20.0 * size], (0.0, 10.0 * size), 0.1 * size);
    let reach = typical.range;
    let at = Unknown::between(
        Field::SpringRest,
        [rest - reach, rest + reach],
        (rest, reach),
        0.05 * reach,
    );
    candidate("cable_spring", vec![spring, at], vec![vec![0.2 * size, rest]])
}

/// Cogging of an order per turn of the joint.
pub fn cogging(order: f64, volts: f64) -> Candidate {
    let part = |field| {
        Unknown::between(field, [-10.0 * volts, 10.0 * volts], (0.0, 3.0 * volts), 0.1 * volts)
    };
    let mut found = candidate(
        "cogging",
        vec![part(Field::CoggingSine), part(Field::CoggingCosine)],
        vec![vec![0.0, 0.05 * volts]],
    );
    found.fixed = vec![(Field::CoggingOrder, order)];
    found
}
