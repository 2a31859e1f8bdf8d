//! A gap without a name, in words.

use super::causes::{found_not_named, not_named};
use super::figures::{LEAST_SAID_SHARE, MOST_SAID, joint_numbers, largest_excess, size};
use super::refit::refitted;
use crate::report::remaining_words::along;
use crate::report::words::{axis_words, effect_words, joint_words, parameter_words, percent};
use crate::result::{Diagnosis, GapShare, Rival};

/// Where the gap lies, and what came nearest.
pub(super) fn unexplained(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let largest = largest_excess(&report.gap.refitted_v, &report.gap.noise_floor_v);
    let joints = joint_numbers(diagnosis);
    let place = largest.and_then(|(index, excess_v)| Some((*joints.get(index)?, excess_v)));
    let Some((joint, excess_v)) = place else {
        return "A gap that nothing in the catalogue explains.".into();
    };
    let share = report.gap_shares.iter().find(|share| share.joint == joint);
    let found = found_not_named(diagnosis);
    let is_found_here = found.iter().any(|other| [0, joint].contains(&other.joint));
    let explains = if is_found_here { "no cause surely" } else { "nothing in the catalogue" };
    let mut parts = vec![format!(
        "A gap of {} on joint {joint} that {explains} explains{}.",
        size(diagnosis, joint, excess_v),
        share.map_or_else(String::new, |share| {
            format!("; {}, {} % of the gap", varies(share), percent(share.share))
        })
    )];
    parts.extend(elsewhere(&report.gap_shares, share));
    parts.extend(not_named(diagnosis, &found));
    parts.extend((!is_found_here).then(|| nearest(diagnosis, joint)).flatten());
    parts.extend(refitted(diagnosis));
    parts.join(" ")
}

/// Where else the gap lies.
fn elsewhere(shares: &[GapShare], said: Option<&GapShare>) -> Option<String> {
    let others = shares.iter().filter(|share| Some(*share) != said).take(MOST_SAID);
    let words = |share: &GapShare| {
        format!("{}, {} %", along(share.joint, share.axis, &share.detail), percent(share.share))
    };
    let others: Vec<String> = others.map(words).collect();
    (!others.is_empty()).then(|| format!("Elsewhere: {}.", others.join("; ")))
}

/// The effect on a joint that takes most of its gap, and what it lacks.
fn nearest(diagnosis: &Diagnosis, joint: u8) -> Option<String> {
    let on_joint = |rival: &&Rival| [0, joint].contains(&rival.joint);
    let rival = diagnosis.rivals.iter().find(on_joint)?;
    let parameters = parameter_words(&diagnosis.catalogue, &rival.effect, &rival.parameters, false);
    let parameters = diagnosis.units_of(rival.joint).in_words(&parameters);
    (rival.explained >= LEAST_SAID_SHARE).then(|| {
        format!(
            "Nearest: {} on {}, {parameters}, would take {} %, but {}.",
            effect_words(&rival.effect),
            joint_words(rival.joint),
            percent(rival.explained),
            rival.why
        )
    })
}

/// "it varies with position: order 8 per revolution", or what the detail says by itself.
fn varies(share: &GapShare) -> String {
    let detail = &share.detail;
    let begins = |words: &[&str]| words.iter().any(|word| detail.starts_with(word));
    if begins(&["varies", "grows", "falls"]) {
        format!("it {detail}")
    } else if begins(&["proportional", "even", "odd", "constant"]) {
        format!("it is {detail}")
    } else {
        format!("it varies with {}: {detail}", axis_words(share.axis))
    }
}
