//! What no cause explains: how much, on which joint, along which axis, as a curve.

use crate::gap_by_axis::{Samples, gap_by_axis_of};
use crate::logs::subject::Subject;
use crate::result::{Axis, GapShare, LogResiduals, Remainder, RemainderCurve};
use crate::verdict::judgement::Judgement;

/// Points of a curve; over position enough for some twenty waves per turn.
const POINTS: usize = 24;
const POINTS_OVER_POSITION: usize = 96;

/// What remains with all causes, largest first; shares are of the gap without any cause.
pub fn remainder(
    subject: &Subject,
    judgement: &Judgement,
    logs: &[LogResiduals],
) -> Vec<Remainder> {
    let criteria = &subject.criteria.axes;
    let gap_v2: f64 = Samples::of_joints(logs, criteria, |joint| &joint.refitted_v)
        .iter()
        .map(Samples::excess_v2)
        .sum();
    let left = Samples::of_joints(logs, criteria, |joint| &joint.with_effects_v);
    let left_v2: f64 = left.iter().map(Samples::excess_v2).sum();
    let (shares, units) = (gap_by_axis_of(&left, criteria), subject.units_by_number());
    let of_share = |share: GapShare| {
        let samples = left.iter().find(|samples| samples.joint == share.joint)?;
        let square_v2 = share.share * left_v2;
        Some(Remainder {
            joint: share.joint,
            axis: share.axis,
            rms_v: (square_v2 / samples.len().max(1) as f64).sqrt(),
            rms_rad: None,
            share: square_v2 / gap_v2.max(f64::MIN_POSITIVE),
            detail: units
                .get(&share.joint)
                .map_or(share.detail.clone(), |u| u.in_words(&share.detail)),
            curve: curve(samples, share.axis),
            nearest: nearest(subject, judgement, share.joint),
        })
    };
    shares.into_iter().filter_map(of_share).collect()
}

/// The effect on a joint that gained most of those that were not accepted.
fn nearest(subject: &Subject, judgement: &Judgement, joint: u8) -> Option<String> {
    let on_joint = |effect: &crate::trial::hypothesis::EffectInstance| {
        [0, joint].contains(&subject.outer_joint(effect.joint))
    };
    let refused = judgement.refused.iter().map(|rival| &rival.effect);
    let withheld = judgement.withheld.iter().map(|it| &it.effect);
    let first = withheld.chain(refused).find(|effect| on_joint(effect))?;
    Some(first.definition.name.into())
}

/// Means of what is left in classes of equal size over an axis; empty over frequencies.
fn curve(samples: &Samples, axis: Axis) -> RemainderCurve {
    let Some(x) = over(samples, axis) else { return RemainderCurve::default() };
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|a, b| x[*a].total_cmp(&x[*b]));
    let mut curve = RemainderCurve::default();
    let points = if axis == Axis::Position { POINTS_OVER_POSITION } else { POINTS };
    for class in order.chunks(x.len().div_ceil(points).max(1)) {
        let count = class.len() as f64;
        let mean = |of: &dyn Fn(usize) -> f64| class.iter().map(|&k| of(k)).sum::<f64>() / count;
        let y = mean(&|k| samples.residual_v[k]);
        let variance = mean(&|k| (samples.residual_v[k] - y).powi(2));
        curve.x.push(mean(&|k| x[k]));
        curve.y_v.push(y);
        curve.deviation_v.push((variance / independent(samples, class)).sqrt());
    }
    curve
}

/// How many pieces of the logs a class has samples in: those of one piece say the same.
fn independent(samples: &Samples, class: &[usize]) -> f64 {
    let mut pieces: Vec<(usize, u64)> =
        class.iter().map(|&k| (samples.log[k], samples.time_s[k] as u64)).collect();
    pieces.sort_unstable();
    pieces.dedup();
    pieces.len() as f64
}

/// The samples' place on an axis; none for frequencies and constants.
fn over(samples: &Samples, axis: Axis) -> Option<&[f64]> {
    match axis {
        Axis::Position => Some(&samples.position_rad),
        Axis::Velocity => Some(&samples.velocity_rad_per_s),
        Axis::Acceleration => Some(&samples.acceleration_rad_per_s2),
        Axis::Command => Some(&samples.command_v),
        Axis::Load => Some(&samples.load_nm),
        Axis::Time | Axis::Offset => Some(&samples.time_s),
        Axis::Frequency => None,
    }
}
