//! Effects that change what the drive gives.

use super::candidate::{Candidate, free};
use super::typical::Typical;
use crate::base::Base;
use crate::fit::{Field, Unknown};

/// A limit that is nearer to the one that is known is an error of the drive's gains.
const NEAREST_LIMIT: f64 = 0.95;
/// Goals go on by this part of the joint's range where they are clipped.
const CLIPPED_PART: f64 = 0.2;
/// Below this a spring is an offset [rad].
const SPRING_RANGE_RAD: f64 = 0.3;

/// All that are tried; `orders` of cogging per turn of the joint.
pub fn effects(base: &Base, typical: &Typical, orders: &[f64]) -> Vec<Candidate> {
    let volts = typical.friction_volts;
    let mut all = vec![
        saturation(base, typical),
        lag(),
        dead_zone(volts),
        Candidate::of_one(
            "dac_offset",
            free(Field::Offset, [-10.0 * volts, 10.0 * volts], volts),
            0.0,
        ),
        delay(base),
    ];
    all.extend(goal_clip(typical));
    if typical.range > SPRING_RANGE_RAD {
        all.push(cable_spring(typical));
    }
    all.extend(orders.iter().map(|order| cogging(*order, volts)));
    all
}

fn saturation(base: &Base, typical: &Typical) -> Candidate {
    let servo = &base.fitted.servo;
    let top = typical.volts.min(servo.limit);
    let limit = Unknown {
        low: 1.2 * servo.coulomb.max(0.01),
        high: NEAREST_LIMIT * servo.limit,
        ..Unknown::positive(Field::Limit, top, 3.0)
    };
    Candidate::new(
        "saturation",
        vec![limit],
        [0.9, 0.7, 0.5, 0.3, 0.15].map(|part| vec![part * top]).to_vec(),
    )
}

fn lag() -> Candidate {
    let lag = free(Field::Lag, [1e-3, 0.3], 0.02);
    Candidate::new("actuator_lag", vec![lag], vec![vec![0.004], vec![0.02]])
}

fn dead_zone(volts: f64) -> Candidate {
    let half_width = free(Field::DeadZone, [0.0, 5.0 * volts], 0.3 * volts);
    let starts = [0.3, 0.05].map(|part| vec![part * volts]).to_vec();
    Candidate::new("dead_zone", vec![half_width], starts)
}

/// Goals act late; beyond what the row's own timing can be.
fn delay(base: &Base) -> Candidate {
    let late = Unknown::between(Field::Delay, [0.0, 0.2], (0.0, 0.2), 0.003);
    // Where the row's timing is within its bounds nothing is late.
    let starts = if base.fitted.servo.read_after_s > 1e-3 { vec![] } else { vec![vec![0.01]] };
    Candidate::new("delay", vec![late], starts)
}

/// Goals that end where the joint's furthest positions are, where they go on much further.
fn goal_clip(typical: &Typical) -> Option<Candidate> {
    let (middle, half) = (typical.position, 0.5 * typical.range);
    let [low, high] = [middle - half, middle + half];
    let beyond = (low - typical.goals[0]).max(typical.goals[1] - high);
    if beyond < CLIPPED_PART * typical.range {
        return None;
    }
    let reach = typical.range.max(1e-3);
    let end = |field, bounds, likely| {
        Unknown::between(field, bounds, (likely, 10.0 * reach), 0.01 * reach)
    };
    let unknowns = vec![
        end(Field::GoalLow, [typical.goals[0] - reach, middle], low),
        end(Field::GoalHigh, [middle, typical.goals[1] + reach], high),
    ];
    Some(Candidate::new("goal_clip", unknowns, vec![vec![low, high]]))
}

fn cable_spring(typical: &Typical) -> Candidate {
    let size = typical.friction_volts / typical.range;
    let (rest, reach) = (typical.position, typical.range);
    let around = [rest - reach, rest + reach];
    let unknowns = vec![
        free(Field::Spring, [0.0, 20.0 * size], size),
        Unknown::between(Field::SpringRest, around, (rest, reach), 0.05 * reach),
    ];
    Candidate::new("cable_spring", unknowns, vec![vec![0.2 * size, rest]])
}

/// Cogging of an order per turn of the joint.
fn cogging(order: f64, volts: f64) -> Candidate {
    let bounds = [-10.0 * volts, 10.0 * volts];
    let part = |field| Unknown::between(field, bounds, (0.0, 3.0 * volts), 0.1 * volts);
    let unknowns = vec![part(Field::CoggingSine), part(Field::CoggingCosine)];
    let cogging = Candidate::new("cogging", unknowns, vec![vec![0.0, 0.05 * volts]]);
    Candidate { fixed: vec![(Field::CoggingOrder, order)], ..cogging }
}
