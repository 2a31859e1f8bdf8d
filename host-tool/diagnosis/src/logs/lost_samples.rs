//! The stretches of a log, and what lost samples cost: gaps are filled, rows that would see one that
//! matters have no weight, and where that is most of them the stretch ends.

use std::ops::Range;

use super::recorded::recorded;
use super::stretch::{Stretch, rms_above};
use super::subject::Subject;
use recordings::{Trace, unbroken};

/// The stretches of a log that holds all joints of the rig.
pub fn stretches_of(trace: &Trace, log: usize, subject: &Subject) -> Vec<Stretch> {
    let criteria = &subject.criteria.logs;
    let whole = |longest_s: f64| {
        let is_long = |range: &Range<usize>| {
            trace.time_s[range.end - 1] - trace.time_s[range.start] >= criteria.shortest_s
        };
        unbroken(&trace.time_s, longest_s)
            .into_iter()
            .filter(is_long)
            .map(|range| recorded(trace, log, subject, range))
            .collect::<Vec<Stretch>>()
    };
    let filled_s = criteria.longest_gap_periods * trace.period_s;
    let missing_s = criteria.missing_sample_periods * trace.period_s;
    let mut stretches = whole(filled_s.max(criteria.longest_gap_s));
    let lost = lost_part(&trace.time_s, trace.period_s);
    let mut shortest_s = filled_s;
    for stretch in &mut stretches {
        let is_known = !stretch.broadband || can_be_bridged(stretch, lost, subject);
        let from_s = if is_known { filled_s } else { missing_s };
        stretch.unseen = near_lost(stretch, trace, from_s, subject);
        shortest_s = shortest_s.min(from_s);
    }
    match stretches.iter().all(|stretch| is_seen(stretch, criteria.least_seen_part)) {
        true => stretches,
        false => whole(shortest_s),
    }
}

/// Samples from which a row would see a gap longer than this [s]: those within the reach of its
/// low-pass. Empty where there is none.
fn near_lost(stretch: &Stretch, trace: &Trace, longest_s: f64, subject: &Subject) -> Vec<bool> {
    let reach_s = subject.criteria.rows.reach_s(stretch.broadband);
    let begin_s = trace.time_s[0] + stretch.start_s;
    let end_s = begin_s + stretch.duration_s();
    let sample = |time_s: f64| ((time_s - begin_s) / stretch.period_s).round().max(0.0) as usize;
    let is_gap =
        |pair: &&[f64]| pair[1] - pair[0] > longest_s && pair[1] > begin_s && pair[0] < end_s;
    let gaps: Vec<&[f64]> = trace.time_s.windows(2).filter(is_gap).collect();
    let mut unseen = if gaps.is_empty() { Vec::new() } else { vec![false; stretch.len()] };
    for gap in gaps {
        let last = sample(gap[1] + reach_s).min(unseen.len());
        unseen[sample(gap[0] - reach_s).min(last)..last].fill(true);
    }
    unseen
}

/// Whether at least this part of the samples is not near one that was lost.
fn is_seen(stretch: &Stretch, least_part: f64) -> bool {
    let seen = stretch.unseen.iter().filter(|unseen| !**unseen).count();
    seen as f64 >= least_part * stretch.unseen.len() as f64
}

/// Whether filling lost samples adds little to the rows of any joint, next to its friction: what is
/// fast in its command is missed in so many samples, and rows see a part of that.
fn can_be_bridged(stretch: &Stretch, lost_part: f64, subject: &Subject) -> bool {
    let (criteria, rows) = (&subject.criteria.logs, &subject.criteria.rows);
    let seen_hz = rows.cutoff_part * rows.broadband_rows_per_s;
    let missed = (lost_part * (2.0 * seen_hz * stretch.period_s).min(1.0)).sqrt();
    subject.joints.iter().all(|&joint| {
        let above_hz = criteria.broadband_above_hz;
        let fast_v = rms_above(&stretch.command_v[joint], stretch.period_s, above_hz);
        let level_v = subject.plant.friction[joint].alpha0_v;
        fast_v * missed <= criteria.most_bridged_part * level_v
    })
}

/// Part of the samples of an even clock that a log lacks.
fn lost_part(time_s: &[f64], period_s: f64) -> f64 {
    let whole = (time_s[time_s.len() - 1] - time_s[0]) / period_s;
    (1.0 - (time_s.len() - 1) as f64 / whole).max(0.0)
}
