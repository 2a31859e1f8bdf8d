//! Scores of answers by hand.

use std::collections::BTreeMap;

use super::*;
use crate::case::Kind;
use crate::cause::{TrueCause, TrueEffect};
use crate::claim::Claim;
use crate::diverse::knowable::Known;
use crate::foreign;
use crate::reality::Reality;
use crate::score::Share;
use diagnosis::Value;
use rig::effects::Catalogue;

fn cause(name: &str, joint: u8, values: &[f64]) -> TrueCause {
    let kind = match Catalogue::standard().by_name(name) {
        Some(definition) => TrueEffect::Catalogue(definition),
        None => TrueEffect::Foreign(foreign::by_name(name).unwrap()),
    };
    TrueCause::new(kind, joint, values.to_vec())
}

fn claim(effect: &str, joint: u8, probability: f64) -> Claim {
    Claim {
        effect: effect.into(),
        joint,
        parameters: BTreeMap::new(),
        probability,
        share_interval: [0.5, 0.8],
        parameter_intervals: BTreeMap::new(),
    }
}

/// A case with causes of which so much could be known, and an answer.
fn outcome(truth: Vec<TrueCause>, known: &[(f64, f64)], claims: Vec<Claim>) -> DiverseOutcome {
    let kind = [Kind::None, Kind::Single, Kind::Pair][truth.len()];
    let known = known.iter().map(|&(share, oracle)| Known { share: Some(share), oracle });
    let verdict = if claims.is_empty() { "unknown" } else { "partial" };
    DiverseOutcome {
        case: 1,
        kind,
        truth,
        told_shares: known.clone().map(|known| known.share).collect(),
        suspects_truth: false,
        known: known.collect(),
        reality: Reality::plain(),
        beside: Vec::new(),
        verdict: verdict.into(),
        failure: None,
        claims,
        seconds: 2.0,
        processor_seconds: 1.5,
        report: None,
    }
}

#[test]
fn a_name_counts_by_its_set_and_its_joint() {
    let lag = || vec![cause("actuator_lag", 2, &[0.005])];
    let sure = [(0.7, 0.99)];
    let right = |claims| outcome(lag(), &sure, claims);
    assert!(right(vec![claim("delay", 2, 0.9)]).is_first_right());
    assert!(right(vec![claim("delay", 3, 0.9)]).has_wrong_name());
    assert!(right(vec![claim("cogging", 2, 0.9)]).has_wrong_name());
    let shape = cause("cogging_series", 3, &[0.1, 7.5, 0.0, 0.3, 0.2, 0.0, 0.0]);
    assert!(outcome(vec![shape], &sure, vec![claim("cogging", 3, 0.6)]).is_first_right());
    let hum = cause("mains_hum", 3, &[0.1, 20.0, 0.0]);
    let outcome = outcome(vec![hum], &sure, vec![claim("cogging", 3, 0.6)]);
    assert!(outcome.has_wrong_name() && !outcome.is_knowable());
}

#[test]
fn a_force_is_a_payload_only_where_it_is_vertical() {
    let force = |values: [f64; 3]| vec![cause("tip_force", 0, &values)];
    let named = |truth| outcome(truth, &[(0.7, 0.99)], vec![claim("payload", 0, 0.8)]);
    assert!(!named(force([0.1, 0.0, -5.0])).has_wrong_name());
    assert!(named(force([4.0, 0.0, -3.0])).has_wrong_name());
}

#[test]
fn small_effects_that_are_there_are_no_wrong_names() {
    let mut found = outcome(Vec::new(), &[], vec![claim("dead_zone", 1, 0.6)]);
    assert!(found.has_wrong_name());
    found.reality.clutter = vec![cause("dead_zone", 1, &[0.02])];
    assert!(!found.has_wrong_name());
    found.truth = vec![cause("payload", 0, &[0.3])];
    assert!(!found.is_first_right());
    found.claims.push(claim("payload", 0, 0.9));
    assert!(found.is_first_right());
}

#[test]
fn the_largest_must_stand_first_unless_another_is_as_large() {
    let pair = || vec![cause("cogging", 3, &[0.1, 8.0, 0.0]), cause("payload", 0, &[0.4])];
    let claims = || vec![claim("payload", 0, 0.9), claim("cogging", 3, 0.8)];
    assert!(!outcome(pair(), &[(0.7, 0.99), (0.2, 0.95)], claims()).is_first_right());
    assert!(outcome(pair(), &[(0.5, 0.99), (0.45, 0.95)], claims()).is_first_right());
    let score = DiverseScore::of(&[outcome(pair(), &[(0.7, 0.99), (0.2, 0.95)], claims())]);
    assert_eq!(score.answers.knowable_pairs.count, 1);
    let hidden = vec![cause("cable_spring", 2, &[0.2, 0.0]), cause("dac_offset", 2, &[0.1])];
    let spring = vec![claim("cable_spring", 2, 0.9)];
    let both = outcome(hidden, &[(0.7, 0.99), (0.2, 0.95)], spring);
    assert!(both.has_named(0) && both.has_named(1));
}

/// On the logs held out parameters make up for a lag that twins with the true ones show.
#[test]
fn what_a_report_would_not_tell_of_a_cause_is_a_row_of_its_own() {
    let lag = || vec![cause("actuator_lag", 2, &[0.005])];
    let named = outcome(lag(), &[(0.2, 0.99)], vec![claim("actuator_lag", 2, 0.9)]);
    let unseen = outcome(lag(), &[(0.2, 0.99)], Vec::new());
    let unseen = DiverseOutcome { told_shares: vec![Some(0.02)], ..unseen };
    let score = DiverseScore::of(&[named, unseen]).answers;
    let counts = |share: Share| (share.count, share.of);
    assert_eq!((counts(score.confirmable_first), counts(score.measurable_first)), ((1, 2), (1, 1)));
}

#[test]
fn probabilities_that_are_right_as_often_as_they_say_have_no_error() {
    let said = |right: bool| {
        let joint = if right { 3 } else { 1 };
        let truth = vec![cause("cogging", 3, &[0.1, 8.0, 0.0])];
        outcome(truth, &[(0.7, 0.99)], vec![claim("cogging", joint, 0.75)])
    };
    let outcomes: Vec<_> = [true, true, true, false].map(said).into();
    let score = DiverseScore::of(&outcomes);
    assert_eq!(score.reliability.error, Some(0.0));
    assert_eq!(score.reliability.bins.len(), 1);
    assert_eq!((score.answers.wrong_name.count, score.answers.wrong_name.of), (1, 4));
    let all = score.reliability.risk.last().unwrap();
    assert_eq!((all.coverage, all.least, all.wrong.count), (1.0, 0.75, 1));
    assert_eq!(score.intervals.shares.count, 3);
    assert_eq!(score.times.mean_processor_seconds, 1.5);
}

#[test]
fn intervals_hold_phases_modulo_a_turn() {
    let truth = cause("cogging", 3, &[0.1, 8.0, 3.1]);
    let mut named = claim("cogging", 3, 0.9);
    named.parameters.insert("harmonic".into(), Value::Number(8.0));
    named.parameter_intervals = BTreeMap::from([
        ("amplitude_V".into(), vec![[0.11, 0.12]]),
        ("harmonic".into(), vec![[8.0, 8.0]]),
        ("phase_rad".into(), vec![[-3.3, -3.1]]),
    ]);
    let score = DiverseScore::of(&[outcome(vec![truth], &[(0.9, 0.99)], vec![named])]);
    assert_eq!((score.intervals.parameters.count, score.intervals.parameters.of), (1, 2));
    assert_eq!(score.intervals.shares.count, 0);
}

#[test]
fn an_interval_from_nothing_on_holds_a_cause_that_takes_nothing() {
    let held = |from: f64, true_share: f64| {
        let claims = vec![Claim { share_interval: [from, 0.2], ..claim("cogging", 3, 0.9) }];
        let truth = vec![cause("cogging", 3, &[0.1, 8.0, 0.0])];
        let shares =
            DiverseScore::of(&[outcome(truth, &[(true_share, 0.99)], claims)]).intervals.shares;
        (shares.count, shares.of)
    };
    assert_eq!(held(0.0, -0.1), (1, 1));
    assert_eq!(held(0.01, -0.1), (0, 1));
    assert_eq!(held(0.0, 0.3), (0, 1));
}

#[test]
fn what_is_true_beside_the_causes_is_no_wrong_name() {
    let constant = |value: f64| cause("torque_constant", 1, &[value]);
    let claimed = |value: f64| Claim {
        parameters: [("relative_error".to_owned(), Value::Number(value))].into(),
        ..claim("torque_constant", 1, 0.9)
    };
    let answered = |value: f64| DiverseOutcome {
        beside: vec![constant(-0.03)],
        ..outcome(Vec::new(), &[], vec![claimed(value)])
    };
    assert!(!answered(-0.05).has_wrong_name());
    assert!(answered(0.05).has_wrong_name());
}
