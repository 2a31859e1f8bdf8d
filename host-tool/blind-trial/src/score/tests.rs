//! Scores of diagnoses by hand: an oracle, which knows the truth, and fools, which do not.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::median::median;
use super::*;
use crate::case::Kind;
use crate::cause::{TrueCause, TrueEffect};
use crate::foreign;
use diagnosis::{Alternative, Axis, Cause, DataParts, Gap, GapShare, Report, Value, Verdict};
use rig::effects::Catalogue;

fn cause(name: &str, joint: u8, values: &[f64]) -> TrueCause {
    let kind = match Catalogue::standard().by_name(name) {
        Some(definition) => TrueEffect::Catalogue(definition),
        None => TrueEffect::Foreign(foreign::by_name(name).unwrap()),
    };
    TrueCause::new(kind, joint, values.to_vec())
}

fn cogging() -> TrueCause {
    cause("cogging", 3, &[0.1, 8.0, 3.0])
}

/// A cause as a diagnosis names it.
fn named(truth: &TrueCause, confidence: f64) -> Cause {
    Cause {
        effect: truth.effect.clone(),
        joint: truth.joint,
        parameters: truth.parameters.clone(),
        parameter_intervals: BTreeMap::new(),
        probability: confidence,
        confidence,
        share: 0.9,
        share_interval: [0.8, 1.0],
        shrinkage: 0.8,
        shrinkage_interval: [0.7, 0.9],
        shrinkage_halves: None,
    }
}

fn report(verdict: Verdict, causes: Vec<Cause>, with_effects_v: f64) -> Report {
    let shares = causes.first().map(|cause| GapShare {
        joint: cause.joint,
        axis: Axis::Position,
        share: 0.8,
        detail: String::new(),
    });
    let gap = Gap {
        refitted_v: vec![0.0, 0.0, 0.050],
        with_effects_v: vec![0.0, 0.0, with_effects_v],
        noise_floor_v: vec![0.0, 0.0, 0.005],
        ..Gap::default()
    };
    Report {
        format: 2,
        verdict,
        causes,
        alternatives: Vec::new(),
        parameters_changed: Vec::new(),
        remainder: Vec::new(),
        data: DataParts::default(),
        gap_shares: shares.into_iter().collect(),
        gap,
        untestable: Vec::new(),
        detectable: Vec::new(),
        remarks: Vec::new(),
        model_fault: None,
        contact: None,
    }
}

fn outcome(kind: Kind, truth: Vec<TrueCause>, report: Report) -> Outcome {
    Outcome {
        case: 1,
        kind,
        truth,
        visibility: None,
        answer: Answer::Report(Box::new(report)),
        seconds: 2.0,
        ceiling_v: None,
    }
}

/// Truths of all kinds.
fn truths() -> Vec<(Kind, Vec<TrueCause>)> {
    vec![
        (Kind::None, Vec::new()),
        (Kind::Single, vec![cogging()]),
        (Kind::Single, vec![cause("payload", 0, &[0.3])]),
        (Kind::Pair, vec![cause("delay", 2, &[0.002]), cause("dac_offset", 1, &[0.05])]),
        (Kind::Foreign, vec![cause("mains_hum", 2, &[0.1, 50.0, 0.0])]),
    ]
}

fn oracle(kind: Kind, truth: Vec<TrueCause>) -> Outcome {
    let verdict = match kind {
        Kind::None => Verdict::None,
        Kind::Foreign => Verdict::Unknown,
        _ => Verdict::Effect,
    };
    let known = truth.iter().filter(|truth| !truth.is_foreign());
    // In any order.
    let causes = known.rev().map(|truth| named(truth, 1.0)).collect();
    outcome(kind, truth, report(verdict, causes, 0.005))
}

/// Says the same of every case.
fn fool(kind: Kind, truth: Vec<TrueCause>) -> Outcome {
    let guess = cause("cogging", 1, &[0.2, 9.0, 0.0]);
    outcome(kind, truth, report(Verdict::Effect, vec![named(&guess, 0.99)], 0.060))
}

fn score(diagnose: impl Fn(Kind, Vec<TrueCause>) -> Outcome) -> Score {
    let outcomes: Vec<Outcome> = truths().into_iter().map(|(k, t)| diagnose(k, t)).collect();
    score_of(&outcomes)
}

fn score_of(outcomes: &[Outcome]) -> Score {
    Score::of(outcomes, &Catalogue::standard())
}

fn share(count: usize, of: usize) -> Share {
    Share { count, of }
}

#[test]
fn an_oracle_is_wholly_right() {
    let score = score(oracle);
    assert_eq!(score.right, share(5, 5));
    assert_eq!(score.singles.right_alone, share(2, 2));
    assert_eq!(score.pairs.both, share(1, 1));
    assert_eq!(score.nothing.false_alarms, share(0, 1));
    assert_eq!(score.foreign.unknown, share(1, 1));
    assert_eq!(score.joints.named, share(1, 1));
    assert!(score.confusion.iter().all(|row| row.right == row.cases));
    assert!(score.parameters.iter().all(|p| p.median_error == Some(0.0) && p.small.count == 1));
    assert!((score.shrinkage.median.unwrap() - 1.0).abs() < 1e-12);
    assert_eq!(score.calibration.brier, Some(0.0));
    assert_eq!(score.mean_seconds, 2.0);
}

#[test]
fn a_fool_is_right_nowhere_and_too_sure() {
    let score = score(fool);
    assert_eq!(score.right, share(0, 5));
    assert_eq!(score.singles.right, share(0, 2));
    assert_eq!(score.singles.effect_right, share(1, 2), "cogging, but of another joint");
    assert_eq!(score.nothing.false_alarms, share(1, 1));
    assert_eq!(score.foreign.wrong_name, share(1, 1));
    assert_eq!(score.joints.named, share(0, 1));
    assert_eq!(score.pairs.wrong_name, share(1, 1));
    assert!(score.parameters.is_empty(), "no cause is rightly named");
    assert!(score.shrinkage.median.unwrap() < 0.0);
    let [bin] = &score.calibration.bins[..] else { panic!("one bin") };
    assert_eq!((bin.right, bin.from), (share(0, 5), 0.97));
}

#[test]
fn one_who_says_unknown_misses_all_but_the_foreign() {
    let score = score(|kind, truth| {
        outcome(kind, truth, report(Verdict::Unknown, vec![named(&cogging(), 0.4)], 0.05))
    });
    assert_eq!(score.right, share(1, 5));
    assert_eq!(score.foreign.unknown, share(1, 1), "a part that is explained is no verdict");
    assert_eq!(score.singles.unknown, share(2, 2));
    assert_eq!(score.nothing.unknown, share(1, 1));
    assert!(score.calibration.bins.is_empty());
}

#[test]
fn a_diagnosis_that_fails_is_counted() {
    let score = score(|kind, truth| Outcome {
        answer: Answer::Failed("no excitation".into()),
        ..oracle(kind, truth)
    });
    assert_eq!((score.failed, score.right), (share(5, 5), share(0, 5)));
    assert_eq!(score.confusion[0].answers["failed"], 1);
}

#[test]
fn half_a_pair_is_half_right() {
    let (kind, truth) = truths().remove(3);
    let mut half = oracle(kind, truth);
    if let Answer::Report(report) = &mut half.answer {
        report.causes.truncate(1);
    }
    let score = score_of(&[half]);
    assert_eq!((score.pairs.both, score.pairs.one), (share(0, 1), share(1, 1)));
    assert_eq!(score.right, share(0, 1));
}

#[test]
fn a_truth_that_was_not_ruled_out_is_told_apart() {
    let mut wrong = fool(Kind::Single, vec![cogging()]);
    if let Answer::Report(report) = &mut wrong.answer {
        let right = Alternative {
            effect: "cogging".into(),
            joint: 3,
            probability: 0.1,
            confidence: 0.1,
            instead_of: Some(0),
            share: 0.3,
            why: None,
        };
        report.alternatives.push(right);
    }
    let singles = score_of(&[wrong]).singles;
    assert_eq!((singles.right, singles.not_ruled_out), (share(0, 1), share(1, 1)));
}

/// Errors of a cause that is named with other values.
fn errors_of(truth: &TrueCause, values: &[(&str, Value)]) -> BTreeMap<&'static str, f64> {
    let mut named = named(truth, 1.0);
    for (name, value) in values {
        named.parameters.insert((*name).to_owned(), value.clone());
    }
    errors(truth, &named).into_iter().map(|error| (error.parameter, error.error)).collect()
}

#[test]
fn phases_count_modulo_a_turn_and_only_at_the_right_harmonic() {
    let phase = |phase_rad| ("phase_rad", Value::Number(phase_rad));
    let found = errors_of(&cogging(), &[phase(3.2 - TAU)]);
    assert!((found["phase_rad"] - 0.2).abs() < 1e-12);
    let found = errors_of(&cogging(), &[phase(1.0), ("harmonic", Value::Number(9.0))]);
    assert!(!found.contains_key("phase_rad"));
    assert!((found["harmonic"] - 0.125).abs() < 1e-12);
}

#[test]
fn vectors_count_by_the_norm_of_their_difference() {
    let force = cause("tip_force", 0, &[3.0, 0.0, 4.0]);
    let found = errors_of(&force, &[("force_N", Value::Vector(vec![3.0, 1.0, 4.0]))]);
    assert!((found["force_N"] - 0.2).abs() < 1e-12);
    let tilt = cause("base_tilt", 0, &[0.03, 0.04]);
    let found = errors_of(&tilt, &[("tilt_x_rad", Value::Number(0.035))]);
    assert!((found["tilt"] - 0.1).abs() < 1e-12);
}

#[test]
fn sizes_count_in_parts_and_missing_ones_as_infinite() {
    let found = errors_of(&cogging(), &[("amplitude_V", Value::Number(0.11))]);
    assert!((found["amplitude_V"] - 0.1).abs() < 1e-12);
    let mut bare = named(&cogging(), 1.0);
    bare.parameters.clear();
    let all = errors(&cogging(), &bare);
    assert!(all.iter().all(|error| error.error.is_infinite()));
}

#[test]
fn a_refit_that_holds_all_leaves_nothing_to_close() {
    let mut payload = oracle(Kind::Single, vec![cause("payload", 0, &[0.3])]);
    payload.ceiling_v = Some(vec![0.0, 0.0, 0.049]);
    assert_eq!(score_of(&[payload]).shrinkage.cases, 0);
}

#[test]
fn intervals_of_shares_are_wilsons() {
    let [from, to] = share(9, 10).interval().unwrap();
    assert!((from - 0.596).abs() < 1e-3 && (to - 0.982).abs() < 1e-3, "{from} {to}");
    assert_eq!(share(0, 0).interval(), None);
}

#[test]
fn the_middle_of_an_even_number_is_the_mean_of_two() {
    assert_eq!(median(vec![3.0, 1.0, 2.0, 10.0]), Some(2.5));
    assert_eq!(median(Vec::new()), None);
}
