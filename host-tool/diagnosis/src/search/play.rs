//! Where a search for backlash begins: gap and stiffness from which a link bounces as it was measured.

use super::candidate::Candidate;
use super::promise::{Start, promised};
use crate::fit::linearisation::Linearisation;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::EffectInstance;

/// Factors of gap and stiffness to go on with. A link that crosses its gap too early or too late by half
/// a bounce fits no better than without play, so steps along slopes do not lead there.
const FACTORS: [[f64; 2]; 6] =
    [[0.7, 1.0], [0.85, 1.0], [1.18, 1.0], [1.4, 1.0], [1.0, 0.5], [1.0, 2.0]];

/// Gaps and stiffnesses closer than this are alike, a quarter.
const ALIKE: f64 = 0.22;

/// Gaps wider than a catalogue's [rad; m]: of a link that flies from one flank to the other, few fit.
const WIDE_GAPS: [f64; 5] = [0.042, 0.057, 0.077, 0.103, 0.14];

/// Starts for backlash and, of those with the first gap, the same with wider ones; others as they are.
pub(super) fn with_wider_gaps(mut starts: Vec<EffectInstance>) -> Vec<EffectInstance> {
    let narrow = starts.first().filter(|start| start.has_backlash()).map(|start| start.values[0]);
    let of_narrow = |start: &&EffectInstance| Some(start.values[0]) == narrow;
    let narrow: Vec<EffectInstance> = starts.iter().filter(of_narrow).cloned().collect();
    for gap_rad in WIDE_GAPS {
        let widened = |start: &EffectInstance| {
            let mut start = start.clone();
            start.values[0] = gap_rad;
            start
        };
        starts.extend(narrow.iter().map(widened));
    }
    starts
}

/// Of starts with the same gap, the best first, keeps the first: what a wider gap does lies in another
/// minimum, and others of the first must not take its place.
pub(super) fn best_of_each_gap(starts: &mut Vec<Start>) {
    let mut gaps = Vec::new();
    starts.retain(|start| {
        let gap_rad = start.effect.values[0];
        let is_new = !gaps.contains(&gap_rad);
        gaps.push(gap_rad);
        is_new
    });
}

/// The best backlash that promising starts lead to; none that leaves too much.
///
/// Each start is gone on with by factors, then by a few steps along slopes, and the best by as many steps as
/// it takes: which minimum is the deepest shows only there.
pub(super) fn best_play(
    linear: &Linearisation,
    evidence: &Evidence,
    starts: Vec<Start>,
) -> Option<Candidate> {
    let effort = &evidence.criteria.search;
    let near = starts.into_iter().map(|start| best_near(linear, evidence, start)).collect();
    let begun = apart(near).into_iter().map(|start| {
        let first = Candidate::of(linear, evidence, start.effect).0;
        first.refined(linear, evidence, effort.first_play_steps)
    });
    let mut begun: Vec<Candidate> = begun.collect();
    begun.sort_by(|a, b| a.train.total_cmp(&b.train));
    begun.truncate(effort.starts);
    let steps = effort.spring_steps.saturating_sub(effort.first_play_steps);
    let refined = begun.into_iter().map(|first| first.refined(linear, evidence, steps));
    let best = refined.min_by(|a, b| a.train.total_cmp(&b.train));
    best.filter(|best| best.train < effort.left_by_backlash * linear.refitted_objective())
}

/// Starts without those that are nearly the same as one that promises more.
fn apart(mut starts: Vec<Start>) -> Vec<Start> {
    starts.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    let mut kept: Vec<Start> = Vec::new();
    for start in starts {
        let is_near = |other: &Start| {
            let mut both = start.effect.values.iter().zip(&other.effect.values).take(2);
            both.all(|(a, b)| (a / b).ln().abs() < ALIKE)
        };
        if !kept.iter().any(is_near) {
            kept.push(start);
        }
    }
    kept
}

/// A start gone to from this one as long as a factor of gap or stiffness leads to one that promises more.
fn best_near(linear: &Linearisation, evidence: &Evidence, start: Start) -> Start {
    let mut best = start;
    for _ in 0..evidence.criteria.search.play_scans {
        let around = FACTORS.iter().map(|factors| scaled(&best.effect, factors));
        let starts =
            around.map(|effect| Start { gain: promised(linear, evidence, &effect), effect });
        match starts.max_by(|a, b| a.gain.total_cmp(&b.gain)) {
            Some(better) if better.gain > best.gain => best = better,
            _ => break,
        }
    }
    best
}

/// Backlash with another gap and stiffness, its first two values.
fn scaled(backlash: &EffectInstance, factors: &[f64; 2]) -> EffectInstance {
    let mut scaled = backlash.clone();
    scaled.values.iter_mut().zip(factors).for_each(|(value, factor)| *value *= factor);
    scaled
}
