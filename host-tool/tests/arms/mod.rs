//! Logs of arms of any kind under a PD loop with hidden effects.
#![allow(dead_code)] // Each test file uses a part of it.

use diagnosis::{Criteria, Diagnosis, Report};
use files::{ArmFile, EffectTable};
use recordings::{ArmCampaign, ArmRecording};
use rig::Plant;
use rig::effects::{Catalogue, Effect, table_from_text};
use simulation::arm_recording::{ArmPlan, gap_plans};
use simulation::{ArmMotion, record_arm};

fn effects(arm: &ArmFile, texts: &[&str]) -> Vec<Box<dyn Effect>> {
    let catalogue = Catalogue::of_arm(arm.joints.len());
    let table = |text: &&str| -> EffectTable { table_from_text(text).unwrap() };
    texts.iter().map(|text| catalogue.effect_of(&table(text)).unwrap()).collect()
}

/// The logs of an arm with hidden effects.
pub fn recorded(arm: &ArmFile, rate_hz: f64, duration_s: f64, hidden: &[&str]) -> ArmCampaign {
    let plant = Plant::of_arm(arm).unwrap();
    let recording = |plan: ArmPlan| {
        let motion = ArmMotion { duration_s, ..plan.motion };
        let log = record_arm(arm, &plant, effects(arm, hidden), &motion);
        ArmRecording { file: format!("{}.csv", plan.name), role: plan.role, log }
    };
    let recordings = gap_plans(rate_hz, 1).into_iter().map(recording).collect();
    ArmCampaign { arm: arm.clone(), recordings }
}

/// What a diagnosis with the effects for such an arm finds, in words on the standard error, too.
pub fn diagnosed(campaign: &ArmCampaign) -> Diagnosis {
    let catalogue = Catalogue::of_arm(campaign.arm.joints.len());
    let found =
        diagnosis::diagnose_arm(campaign, &catalogue, &Criteria::default(), &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&found));
    found
}

/// What is hidden, the effect and the joint to be named, its size, and how near that is to be found.
pub type Case = (&'static str, &'static str, u8, (&'static str, f64), f64);

/// The one cause that is named, with its size within this part of the truth.
pub fn names(report: &Report, effect: &str, joint: u8, size: (&str, f64), within: f64) {
    let named: Vec<_> = report.causes.iter().map(|c| (c.effect.as_str(), c.joint)).collect();
    assert_eq!(named, [(effect, joint)]);
    let found = match &report.causes[0].parameters[size.0] {
        diagnosis::Value::Number(found) => *found,
        other => panic!("{other:?}"),
    };
    assert!((found / size.1 - 1.0).abs() < within, "{found} rather than {}", size.1);
}

/// Each is the one cause that is named of its arm.
pub fn all_are_named(diagnosed: fn(&[&str]) -> Report, cases: &[Case]) {
    for &(hidden, effect, joint, size, within) in cases {
        names(&diagnosed(&[hidden]), effect, joint, size, within);
    }
}
