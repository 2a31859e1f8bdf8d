//! How often the 95 % intervals of `rrr identify` hold the truth, and how far it errs.
//!
//! `cargo test --release -p host-tool --test identify_coverage -- --ignored --nocapture`
//! repeats the study whose result stands in docs/identification.md.
#![allow(missing_docs)]

mod campaign;

use std::collections::BTreeMap;

use campaign::{perturbed_robot, recorded_campaign, torque_error};
use identification::Estimate;
use identification::procedure::{Identified, identify};
use model::base::NAMES;
use model::{Friction, Robot};

/// Errors and coverage of one parameter over many robots.
#[derive(Default)]
struct Score {
    held: usize,
    all: usize,
    worst_share: f64,
    largest_z: f64,
}

impl Score {
    fn take(&mut self, estimate: &Estimate, truth: f64, scale: f64) {
        self.all += 1;
        self.held += usize::from(estimate.covers(truth));
        let error = (estimate.value - truth).abs();
        self.worst_share = self.worst_share.max(error / scale);
        self.largest_z = self.largest_z.max(error / estimate.standard_error);
    }
}

fn friction_truths(friction: &Friction<f64>) -> [(&'static str, f64); 6] {
    [
        ("alpha0_V", friction.alpha0_v),
        ("alpha1_V", friction.alpha1_v),
        ("stribeck_velocity_rad_per_s", friction.stribeck_velocity_rad_per_s),
        ("alpha2_V_s_per_rad", friction.alpha2_v_s_per_rad),
        ("sigma0_V_per_rad", friction.sigma0_v_per_rad),
        ("sigma1_V_s_per_rad", friction.sigma1_v_s_per_rad),
    ]
}

fn score(scores: &mut BTreeMap<String, Score>, found: &Identified, robot: &Robot<f64>) {
    for (joint, estimates) in found.refined.friction_estimates.iter().enumerate() {
        let truths = friction_truths(&robot.friction[joint]);
        for ((name, estimate), (_, truth)) in estimates.iter().zip(truths) {
            let score = scores.entry(format!("{name} {}", joint + 1)).or_default();
            score.take(estimate, truth, truth.abs());
        }
    }
    let largest = robot.base.to_array().into_iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    for (k, truth) in robot.base.to_array().into_iter().enumerate() {
        let score = scores.entry(NAMES[k].to_owned()).or_default();
        score.take(&found.refined.base_estimates[k].1, truth, largest);
    }
}

#[test]
#[ignore = "minutes long; its result stands in docs/identification.md"]
fn intervals_hold_the_truth() {
    const ROBOTS: u32 = 50;
    let mut scores = BTreeMap::new();
    let (mut torque, mut share) = (0.0_f64, 0.0_f64);
    for seed in 0..ROBOTS {
        let robot = perturbed_robot(seed);
        let found = identify(&recorded_campaign(&robot, seed), &|_| {}).unwrap();
        score(&mut scores, &found, &robot);
        torque = torque.max(torque_error(&found.robot, &robot));
        let residuals = found.held_out.iter().flat_map(|held| held.residuals());
        share = residuals.map(|residual| residual.share).fold(share, f64::max);
    }
    println!(
        "| parameter | interval holds the truth | worst error | largest error / its standard error |"
    );
    println!("| --- | --- | --- | --- |");
    let (mut held, mut all) = (0, 0);
    for (name, score) in &scores {
        let rate = 100.0 * score.held as f64 / score.all as f64;
        println!(
            "| {name} | {rate:.0} % | {:.2} % | {:.1} |",
            100.0 * score.worst_share,
            score.largest_z
        );
        (held, all) = (held + score.held, all + score.all);
    }
    let rate = held as f64 / all as f64;
    println!(
        "\nall: {:.1} %, worst torque error {:.3} %, worst share left {:.3} %",
        100.0 * rate,
        100.0 * torque,
        100.0 * share
    );
    assert!((0.90..=0.99).contains(&rate), "{rate}");
}

#[test]
fn an_unknown_robot_is_identified_within_the_promised_errors() {
    let robot = perturbed_robot(1001);
    let found = identify(&recorded_campaign(&robot, 1001), &|_| {}).unwrap();
    for (truth, estimate) in robot.friction.iter().zip(&found.robot.friction) {
        let within = |a: f64, b: f64, share: f64| assert!((a / b - 1.0).abs() < share, "{a} {b}");
        within(estimate.alpha0_v, truth.alpha0_v, 0.03);
        within(estimate.alpha2_v_s_per_rad, truth.alpha2_v_s_per_rad, 0.03);
        within(estimate.alpha0_v + estimate.alpha1_v, truth.alpha0_v + truth.alpha1_v, 0.10);
        within(estimate.sigma0_v_per_rad, truth.sigma0_v_per_rad, 0.07);
        within(estimate.sigma1_v_s_per_rad, truth.sigma1_v_s_per_rad, 0.20);
    }
    let error = torque_error(&found.robot, &robot);
    assert!(error < 0.01, "{error}");
    for residual in found.held_out.iter().flat_map(|held| held.residuals()) {
        assert!(residual.share < 0.02, "{residual:?}");
    }
}
