//! Why a log says nothing about a model, whatever it holds.

use super::subject::Subject;
use recordings::Trace;
use recordings::campaign::JointTrace;
use recordings::one_joint::{NotDriven, check_driven};

/// The model of one joint does not hold where others of the arm move along.
pub fn others_move(trace: &Trace, subject: &Subject) -> Option<String> {
    let moves = |joint: &&JointTrace| {
        !subject.numbers.contains(&joint.number)
            && span(&joint.q_rad) > subject.criteria.logs.still_rad
    };
    let other = trace.joints.iter().find(moves)?;
    Some(format!(
        "joint {} moves by {:.2} rad, but the model has joint {} alone; give the model of the \
         whole arm, or a log in which the other joints stand still",
        other.number,
        span(&other.q_rad),
        subject.numbers[0]
    ))
}

/// Why a log that can be what it says cannot be judged by a model.
pub fn cannot_be_judged(trace: &Trace, subject: &Subject) -> Option<String> {
    let of_joint = |joint: &JointTrace| {
        dead_encoder(joint, subject).or_else(|| mostly_at_the_limit(joint, subject))
    };
    let outside = || {
        let alone = subject.one_joint.then_some(subject.numbers[0])?;
        let why = check_driven(trace, alone, &subject.known).err()?;
        (why == NotDriven::ExternalForce)
            .then(|| format!("{why}; record motion that the motor drives"))
    };
    trace.joints.iter().find_map(of_joint).or_else(outside)
}

/// An angle that never changes under commands that friction cannot hold.
fn dead_encoder(joint: &JointTrace, subject: &Subject) -> Option<String> {
    if span(&joint.q_rad) > 0.0 {
        return None;
    }
    let place = subject.numbers.iter().position(|&number| number == joint.number)?;
    let friction = &subject.plant.friction[subject.joints[place]];
    let level_v = friction.alpha0_v + friction.alpha1_v.max(0.0);
    let span_v = span(&joint.command_v);
    (span_v > subject.criteria.logs.stuck_encoder_ratio * 2.0 * level_v).then(|| {
        format!(
            "q{} never changes while u{}_V spans {span_v:.2} V, more than friction holds; the \
             encoder is stuck or not connected",
            joint.number, joint.number
        )
    })
}

fn mostly_at_the_limit(joint: &JointTrace, subject: &Subject) -> Option<String> {
    let (known, criteria) = (&subject.known, &subject.criteria.logs);
    let limit_v = subject.command_limit_v(joint.number);
    let edge_v = limit_v - criteria.limit_steps * known.command_step_v;
    let at_limit = joint.command_v.iter().filter(|u| u.abs() >= edge_v).count();
    let share = at_limit as f64 / joint.command_v.len().max(1) as f64;
    (share > criteria.most_at_limit).then(|| {
        format!(
            "joint {} is at its limit for {:.0} % of the time; record it with less motion",
            joint.number,
            100.0 * share
        )
    })
}

/// How far a signal goes.
fn span(signal: &[f64]) -> f64 {
    let low = signal.iter().copied().fold(f64::INFINITY, f64::min);
    let high = signal.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (high - low).max(0.0)
}
