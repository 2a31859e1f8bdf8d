//! What `rrr identify` says of campaigns that are not as they should be.
#![allow(missing_docs)]

mod campaign;

use campaign::{perturbed_robot, recorded_campaign};
use files::{Experiment, Role};
use identification::procedure::{Identified, identify};
use recordings::campaign::Trace;
use recordings::{Campaign, StepError};

fn whole() -> Campaign {
    recorded_campaign(&perturbed_robot(7), 7)
}

fn run(campaign: &Campaign) -> Result<Identified, StepError> {
    identify(campaign, &|_| {})
}

fn excitation(campaign: &mut Campaign) -> &mut Trace {
    let wanted = |t: &&mut Trace| t.experiment == Experiment::Excitation && t.role == Role::Train;
    campaign.traces.iter_mut().find(wanted).unwrap()
}

/// What it says after the excitation has been spoiled.
fn refusal(spoil: impl FnOnce(&mut Trace)) -> String {
    let mut campaign = whole();
    spoil(excitation(&mut campaign));
    let message = run(&campaign).map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("excitation"), "{message}");
    message
}

#[test]
fn without_an_experiment_the_rest_is_done_and_the_gap_is_named() {
    for (experiment, name) in [
        (Experiment::ConstantVelocity, "constant-velocity of joint 2"),
        (Experiment::PreslidingNoise, "presliding-noise of joint 2"),
    ] {
        let mut campaign = whole();
        campaign.traces.retain(|t| t.experiment != experiment || t.joint != Some(2));
        let found = run(&campaign).unwrap();
        assert!(found.missing.iter().any(|m| m.contains(name)), "{:?}", found.missing);
        for residual in found.held_out.iter().flat_map(|held| held.residuals()) {
            assert!(residual.share < 0.02, "{name}: {residual:?}");
        }
    }
}

#[test]
fn without_an_excitation_there_is_no_model() {
    let mut campaign = whole();
    campaign.traces.retain(|t| t.experiment != Experiment::Excitation);
    let message = run(&campaign).map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("no log of excitation"), "{message}");
}

#[test]
fn a_joint_that_never_moved_is_named() {
    let message = refusal(|trace| trace.joints[2].q_rad.fill(0.1));
    assert!(message.contains("joint 3"), "{message}");
}

#[test]
fn a_stuck_encoder_is_named_with_its_time() {
    let message = refusal(|trace| {
        let q = &mut trace.joints[1].q_rad;
        let moving = (8000..20_000).find(|&k| (q[k] - q[k - 10]).abs() > 0.02).unwrap();
        let value = q[moving];
        q[moving..moving + 1000].fill(value);
    });
    assert!(message.contains("q2 stands still from") && message.contains("stuck"), "{message}");
}

#[test]
fn swapped_joints_are_named() {
    let message = refusal(|trace| {
        let first = trace.joints[0].q_rad.clone();
        trace.joints[0].q_rad = trace.joints[1].q_rad.clone();
        trace.joints[1].q_rad = first;
    });
    assert!(message.contains("swapped"), "{message}");
}

#[test]
fn wrong_units_are_named() {
    let message = refusal(|trace| {
        for q in &mut trace.joints[0].q_rad {
            *q = q.to_degrees();
        }
    });
    assert!(message.contains("radians or counts"), "{message}");
    let message = refusal(|trace| {
        for u in &mut trace.joints[1].command_v {
            *u *= 1000.0;
        }
    });
    assert!(message.contains("in volts"), "{message}");
}

#[test]
fn saturated_commands_and_gaps_are_remarked() {
    let mut campaign = whole();
    let trace = excitation(&mut campaign);
    for u in &mut trace.joints[2].command_v[5000..8000] {
        *u = 10.0_f64.copysign(*u);
    }
    let keep = |k: usize| !(12_000..13_000).contains(&k);
    let thin = |column: &mut Vec<f64>| {
        let kept = column.iter().enumerate().filter(|(k, _)| keep(*k)).map(|(_, x)| *x);
        *column = kept.collect();
    };
    thin(&mut trace.time_s);
    for joint in &mut trace.joints {
        thin(&mut joint.q_rad);
        thin(&mut joint.command_v);
        joint.reference_rad.as_mut().map(thin);
    }
    let found = run(&campaign).unwrap();
    let remarks = found.missing.join("; ");
    assert!(remarks.contains("joint 3 is at its limit"), "{remarks}");
    assert!(remarks.contains("of the samples are missing"), "{remarks}");
}
