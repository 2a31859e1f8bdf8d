//! Where the gap lies before any cause: by joint and axis, and the seconds of contact.

use diagnosis::report::words::axis_words;
use diagnosis::{Axis, Gap, GapShare};

use crate::outcome::Outcome;

/// Bins of an axis.
const BINS: usize = 12;

/// Parts of the refitted model's gap that vary with position, velocity or goal, largest first;
/// behind them contacts.
pub fn places(outcome: &Outcome, gap: &Gap) -> Vec<GapShare> {
    let all: f64 = gap.refitted_rad.iter().map(|rms| rms * rms).sum();
    let mut found: Vec<GapShare> = (0..outcome.models.len())
        .map(|joint| {
            let part = gap.refitted_rad[joint].powi(2) / all.max(f64::MIN_POSITIVE);
            let (axis, explained) = axis(outcome, joint);
            let detail = format!(
                "joint {} holds {:.0} % of the squares of position; {:.0} % of them vary with {}",
                joint + 1,
                100.0 * part,
                100.0 * explained,
                axis_words(axis)
            );
            GapShare { joint: joint as u8 + 1, axis, share: part * explained, detail }
        })
        .collect();
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found.extend(outcome.prepared.contacts.iter().map(|contact| {
        let [from, to] = contact.seconds;
        let detail = format!("contact: {}, {from:.1} s to {to:.1} s; cut out", contact.file);
        GapShare { joint: contact.joint, axis: Axis::Time, share: 0.0, detail }
    }));
    found
}

/// The axis with which most of a joint's squares vary, and how much of them.
fn axis(outcome: &Outcome, joint: usize) -> (Axis, f64) {
    let mut points: [Vec<(f64, f64)>; 3] = Default::default();
    for motion in &outcome.motions {
        let log = &outcome.prepared.logs[motion.log];
        let track = &log.record.joints[joint];
        for row in (0..log.record.len()).filter(|row| log.counts[joint][*row]) {
            let error = track.position[row] - motion.stages[1][joint][row];
            let ways =
                [track.position[row], track.velocity[row], track.goal[row] - track.position[row]];
            points.iter_mut().zip(ways).for_each(|(points, x)| points.push((x, error)));
        }
    }
    let found = [Axis::Position, Axis::Velocity, Axis::Command]
        .into_iter()
        .zip(points.iter().map(|p| explained(p)));
    found.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((Axis::Offset, 0.0))
}

/// The part of squares that means over bins of x explain.
fn explained(points: &[(f64, f64)]) -> f64 {
    let low = points.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let high = points.iter().map(|p| p.0).fold(f64::NEG_INFINITY, f64::max);
    let mut sums = [(0.0, 0.0); BINS];
    for (x, error) in points {
        let bin = ((x - low) / (high - low).max(1e-12) * BINS as f64) as usize;
        let bin = &mut sums[bin.min(BINS - 1)];
        *bin = (bin.0 + error, bin.1 + 1.0);
    }
    let all: f64 = points.iter().map(|p| p.1 * p.1).sum();
    let means = sums.iter().filter(|bin| bin.1 > 0.0).map(|bin| bin.0 * bin.0 / bin.1);
    means.sum::<f64>() / all.max(f64::MIN_POSITIVE)
}
