//! Logs of arms of any kind under a PD loop with hidden effects.
#![allow(dead_code)] // Each test file uses a part of it.

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
