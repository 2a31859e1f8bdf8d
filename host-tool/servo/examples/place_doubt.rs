//! How far from the last link's centre a load may sit: masses of loads that are found by several choices.
//!
//!     cargo run --release -p servo --example place_doubt -- FROM TO [DOUBT DOUBT ...]
//!
//! runs the seeds FROM to TO - 1, with doubts of 0.01 and 0.03 unless others are given: a pendulum whose mass was exchanged, whose load is where the link's is,
//! and six axes with 0.1 kg in the hand 30 mm beyond it and beside it.

use diagnosis::{Report, Value};
use recordings::ArmCampaign;
use servo::recorded::{Recording, Truth, record};
use servo::report::report;
use servo::synthetic::{links_of, pendulum, six_axes};
use servo::whole_effect::Whole;
use servo::{Outcome, Settings, prepared};

/// Where a load of 0.1 kg is in the last link, whose own centre is at (0.03, 0, 0) [m].
const PLACES: [[f64; 3]; 2] = [[0.04, 0.0, 0.0], [0.05, 0.02, 0.01]];

fn recording() -> Recording {
    Recording { length_s: 24.0, logs: [5, 3], ..Recording::default() }
}

fn exchanged(seed: u64, added_kg: f64) -> ArmCampaign {
    let truth = pendulum(seed, 0.4 + added_kg, 0.15);
    let recording = Recording { swing_rad: 1.5, ..recording() };
    let servos = prepared::joints(&truth).expect("a whole file");
    let mut campaign = record(&truth, &Truth::of(links_of(&truth), servos), &recording, seed);
    campaign.arm = pendulum(seed, 0.4, 0.15);
    campaign
}

fn loaded(seed: u64, at_m: [f64; 3]) -> ArmCampaign {
    let file = six_axes(seed);
    let servos = prepared::joints(&file).expect("a whole file");
    let links = Whole::Payload.links(&links_of(&file), &[0.1, at_m[0], at_m[1], at_m[2]]);
    record(&file, &Truth::of(links, servos), &recording(), seed)
}

/// What is named, and the mass where that is a payload.
fn named(report: &Report) -> String {
    let words = report.causes.iter().map(|cause| match cause.parameters.get("mass_kg") {
        Some(Value::Number(mass)) => format!("payload {mass:.3} kg"),
        _ => format!("{} {}", cause.effect, cause.joint),
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() { format!("{:?}", report.verdict) } else { words.join("; ") }
}

fn tell(seed: u64, truth: &str, campaign: &ArmCampaign, doubts: &[f64]) {
    let of = |place_doubt: f64| {
        let settings = Settings { place_doubt, ..Settings::default() };
        let outcome = Outcome::of(campaign, &settings, &|_| ());
        named(&report(&outcome.expect("simulated logs can be used")))
    };
    let found: Vec<String> = doubts.iter().map(|doubt| of(*doubt)).collect();
    println!("{seed} | {truth} | {}", found.join(" | "));
}

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|text| text.parse::<f64>().ok());
    let (from, to) = (numbers.next().unwrap_or(1.0), numbers.next().unwrap_or(2.0));
    let given: Vec<f64> = numbers.collect();
    let doubts = if given.is_empty() { vec![0.01, 0.03] } else { given };
    println!("seed | truth | doubts {doubts:?}");
    for seed in from as u64..to as u64 {
        let added_kg = [0.2, -0.15, 0.35, 0.1][seed as usize % 4];
        tell(seed, &format!("exchanged {added_kg:+} kg"), &exchanged(seed, added_kg), &doubts);
        for at_m in PLACES {
            tell(seed, &format!("0.1 kg at {at_m:?}"), &loaded(seed, at_m), &doubts);
        }
    }
}
