//! Friction of joints that may be of no formula, open in a fit.

use crate::base::{Base, Frame};
use crate::candidates::{Candidate, by_motor_torque, over_speed};
use crate::cross::Gain;
use crate::fit::fit;
use crate::joint::ServoJoint;
use crate::joint_model::Model;
use crate::prepared::Prepared;
use crate::ranking::suffices;
use crate::settings::Settings;

/// The joints `from` where a fit ended, friction open where that takes a good part, or where a joint is alone; none
/// where it is opened on no joint. `prepared` is the arm with an effect of all of it in its logs.
pub fn with_open_friction(
    prepared: &Prepared,
    bases: &[Base],
    from: &[ServoJoint],
    settings: &Settings,
) -> Option<Vec<Base>> {
    let train = prepared.train();
    let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
    let of = |(joint, (base, from)): (usize, (&Base, &ServoJoint))| {
        let fitted = fit(&frame.problem(joint, &base.unknowns, base.scale), from);
        opened(&frame, joint, Base { fitted, ..base.clone() }, bases.len() == 1)
    };
    let found: Vec<(bool, Base)> = bases.iter().zip(from).enumerate().map(of).collect();
    let any = found.iter().any(|(is_open, _)| *is_open);
    any.then(|| found.into_iter().map(|(_, base)| base).collect())
}

/// A joint with friction open where that takes a good part, or `always`; and whether it is.
fn opened(frame: &Frame, joint: usize, base: Base, always: bool) -> (bool, Base) {
    let bare = Model::of_base(frame, joint, &base);
    let model = with_friction(frame, joint, &base, &bare);
    let takes = suffices(&Gain::of(&model.left, &bare.left), &bare.settings(frame.settings));
    let is_open = takes || always;
    let Model { unknowns, fitted, .. } = if is_open { model } else { bare };
    (is_open, Base { unknowns, fitted, ..base })
}

/// A joint with friction over speed and by the motor's torque. Each is added first in turn, for a search from where
/// one has taken what is the other's may stop there.
fn with_friction(frame: &Frame, joint: usize, base: &Base, bare: &Model) -> Model {
    let [torque, speed] = [by_motor_torque(base), over_speed(base, top_speed(frame, joint))];
    let more = |model: Model, effect: &Candidate| {
        model.with(frame, joint, base.scale, effect).unwrap_or(model)
    };
    let polished = |order: [&Candidate; 2]| {
        let mut model = order.into_iter().fold(bare.clone(), more);
        model.polish(frame, joint, base.scale);
        model
    };
    let cost = |model: &Model| model.left.robust.iter().sum::<f64>();
    let [one, other] = [[&torque, &speed], [&speed, &torque]].map(polished);
    if cost(&other).total_cmp(&cost(&one)).is_lt() { other } else { one }
}

/// The highest smoothed speed of the rows that count [rad/s; m/s].
fn top_speed(frame: &Frame, joint: usize) -> f64 {
    let of = |log: &&crate::judged::Judged| {
        let counted = log.record.joints[joint].velocity.iter().zip(&log.counts[joint]);
        counted.filter(|(_, counts)| **counts).fold(0.0_f64, |top, (speed, _)| top.max(speed.abs()))
    };
    frame.logs.iter().map(of).fold(0.0, f64::max)
}
