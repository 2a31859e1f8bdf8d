//! Arms of any kind, and their logs under a PD loop with hidden effects.
#![allow(dead_code)] // Each test file uses a part of it.

use files::{ArmFile, EffectTable};
use recordings::{ArmCampaign, ArmRecording};
use rig::Plant;
use rig::effects::{Catalogue, Effect, table_from_text};
use simulation::arm_recording::{ArmPlan, gap_plans};
use simulation::{ArmMotion, record_arm};

/// A pendulum of two links with voltages.
pub const PENDULUM: &str = r#"
format = 2
[robot]
name = "two-link pendulum"
[[joint]]
kind = "revolute"
axis = [0.0, -1.0, 0.0]
mass_kg = 1.4
com_m = [0.15, 0.0, 0.01]
inertia_kg_m2 = [2e-3, 0.0, 1e-4, 1.2e-2, 0.0, 1.1e-2]
armature_kg_m2 = 0.004
drive = { kind = "voltage", torque_constant_Nm_per_V = 1.6 }
encoder = { counts_per_rev = 65536 }
friction = { alpha0_V = 0.2, alpha2_V_s_per_rad = 0.05 }
[[joint]]
kind = "revolute"
origin_xyz_m = [0.3, 0.0, 0.0]
axis = [0.0, -1.0, 0.0]
mass_kg = 0.8
com_m = [0.12, 0.0, 0.0]
inertia_kg_m2 = [1e-3, 0.0, 0.0, 5e-3, 0.0, 5e-3]
armature_kg_m2 = 0.002
drive = { kind = "voltage", torque_constant_Nm_per_V = 0.9 }
encoder = { counts_per_rev = 65536 }
friction = { alpha0_V = 0.1, alpha2_V_s_per_rad = 0.03 }
"#;

/// A sliding axis with a torque drive, a force that is.
pub const AXIS: &str = r#"
format = 2
[robot]
name = "linear axis"
[[joint]]
kind = "prismatic"
axis = [1.0, 0.0, 0.0]
mass_kg = 12.0
com_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [0.1, 0.0, 0.0, 0.1, 0.0, 0.1]
drive = { kind = "torque" }
encoder = { counts_per_m = 1e6 }
friction = { alpha0_V = 9.0, alpha2_V_s_per_m = 40.0 }
"#;

/// An arm from its text.
pub fn parse(text: &str) -> ArmFile {
    ArmFile::parse("arm.toml", text.as_bytes().to_vec()).unwrap()
}

/// Six joints with gears: about the size of a small industrial arm.
pub fn six_joints() -> ArmFile {
    let axes = ["0, 0, 1", "0, 1, 0", "0, 1, 0", "1, 0, 0", "0, 1, 0", "1, 0, 0"];
    let origins =
        ["0, 0, 0.2", "0.05, 0, 0.15", "0, 0, 0.4", "0.1, 0, 0.05", "0.3, 0, 0", "0.08, 0, 0"];
    let masses = [8.0, 6.0, 4.0, 2.5, 1.2, 0.5];
    let centres = [
        "0.02, 0.01, 0.1",
        "0.01, 0.03, 0.18",
        "0.05, -0.01, 0.03",
        "0.14, 0.01, 0",
        "0.03, 0, 0.01",
        "0.02, 0.005, 0",
    ];
    let sizes: [f64; 6] = [0.15, 0.2, 0.1, 0.12, 0.05, 0.03];
    let rotors = [1.2, 1.0, 0.6, 0.15, 0.1, 0.04];
    let (constants, gears) =
        ([12.0, 12.0, 9.0, 4.0, 4.0, 3.0], [121.0, -101.0, 100.5, 81.0, 80.0, 50.0]);
    let mut text = "format = 2\n[robot]\nname = \"six\"\n".to_owned();
    for k in 0..6 {
        let i = masses[k] * sizes[k] * sizes[k] / 3.0;
        text += &format!(
            "[[joint]]\nkind = \"revolute\"\naxis = [{}]\norigin_xyz_m = [{}]\nmass_kg = {}\n\
             com_m = [{}]\ninertia_kg_m2 = [{i}, 0, 0, {}, 0, {}]\narmature_kg_m2 = {}\n\
             drive = {{ kind = \"current\", torque_constant_Nm_per_A = {:?}, gear_ratio = {:?} }}\n\
             encoder = {{ counts_per_rev = 4096, side = \"motor\" }}\n\
             friction = {{ alpha0_V = {}, alpha2_V_s_per_rad = 0.5 }}\n",
            axes[k],
            origins[k],
            masses[k],
            centres[k],
            0.9 * i,
            0.7 * i,
            rotors[k],
            constants[k],
            gears[k],
            0.4 + 0.05 * k as f64,
        );
    }
    parse(&text)
}

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
