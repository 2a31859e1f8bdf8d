//! A blind trial of simulated servo arms: one effect hidden in each, or none.
//!
//!     cargo run --release -p servo --example servo_trial -- FROM TO
//!
//! runs the seeds FROM to TO - 1 and prints a row of a table for each kind: how often the hidden cause is
//! named first on the right joint, how often something else is named as well, how often nothing is.

use diagnosis::Report;
use servo::recorded::{Recording, Truth, record};
use servo::report::report;
use servo::synthetic::{links_of, pendulum, six_axes};
use servo::whole_effect::Whole;
use servo::{Outcome, ServoJoint, Settings, prepared};

/// What is hidden: its name in reports, and how it changes a joint.
type Kind = (&'static str, fn(&mut ServoJoint));

const KINDS: [Kind; 12] = [
    ("none", |_| ()),
    ("saturation", |servo| servo.limit = 1.5),
    ("stribeck", |servo| servo.stribeck = 0.15),
    ("load_friction", |servo| servo.motor_load_friction = 0.6),
    ("asymmetric_friction", |servo| servo.asymmetry = 0.3),
    ("viscous_asymmetry", |servo| servo.viscous_asymmetry = 0.3),
    ("actuator_lag", |servo| servo.lag_s = 0.03),
    ("dead_zone", |servo| servo.dead_zone = 0.3),
    ("backlash", |servo| servo.gap = 0.02),
    ("dac_offset", |servo| servo.offset = 0.3),
    ("cogging", |servo| servo.cogging = [0.2, 5.0, 0.7]),
    ("cable_spring", |servo| servo.spring = 1.0),
];

/// Simulates, diagnoses.
fn diagnosed(campaign: &recordings::ArmCampaign) -> Report {
    let outcome = Outcome::of(campaign, &Settings::default(), &|_| ());
    report(&outcome.expect("simulated logs can be used"))
}

fn recording() -> Recording {
    Recording { length_s: 30.0, logs: [6, 3], ..Recording::default() }
}

/// An arm of six axes with something hidden on a joint that the seed draws.
fn six(seed: u64, hide: fn(&mut ServoJoint)) -> (Report, usize) {
    let file = six_axes(seed);
    let mut servos = prepared::joints(&file).expect("a whole file");
    let joint = (seed * 7 % 6) as usize;
    hide(&mut servos[joint]);
    (diagnosed(&record(&file, &Truth::of(links_of(&file), servos), &recording(), seed)), joint + 1)
}

/// The same with a load in its hand.
fn loaded(seed: u64) -> Report {
    let file = six_axes(seed);
    let servos = prepared::joints(&file).expect("a whole file");
    let links = Whole::Payload.links(&links_of(&file), &[0.1, 0.04, 0.0, 0.0]);
    diagnosed(&record(&file, &Truth::of(links, servos), &recording(), seed))
}

/// A pendulum whose mass was exchanged.
fn exchanged(seed: u64) -> Report {
    let added = [0.2, -0.15, 0.35, 0.1][seed as usize % 4];
    let truth = pendulum(seed, 0.4 + added, 0.15);
    let servos = prepared::joints(&truth).expect("a whole file");
    let recording = Recording { swing_rad: 1.5, ..recording() };
    let mut campaign = record(&truth, &Truth::of(links_of(&truth), servos), &recording, seed);
    campaign.arm = pendulum(seed, 0.4, 0.15);
    diagnosed(&campaign)
}

fn tell(kind: &str, seed: u64, joint: u8, report: &Report) {
    let named = report.causes.iter().map(|cause| {
        format!(
            "{} {} {:?} ({:.0} %)",
            cause.effect,
            cause.joint,
            cause.parameters,
            100.0 * cause.share
        )
    });
    let named = named.collect::<Vec<_>>().join("; ");
    let first = report.causes.first();
    let right = first.is_some_and(|cause| cause.effect == kind && cause.joint == joint)
        || (kind == "none" && first.is_none());
    println!("{seed} | {kind} | {joint} | {:?} | {right} | {named}", report.verdict);
}

fn main() {
    let mut arguments = std::env::args().skip(1).filter_map(|text| text.parse::<u64>().ok());
    let (from, to) = (arguments.next().unwrap_or(1), arguments.next().unwrap_or(2));
    println!("seed | hidden | joint | verdict | right | named");
    for seed in from..to {
        tell("payload", seed, 0, &exchanged(seed));
        tell("payload", seed, 0, &loaded(seed));
        for (kind, hide) in KINDS {
            let (report, joint) = six(seed, hide);
            tell(kind, seed, joint as u8, &report);
        }
    }
}
