//! Commands that take arms of any kind.
#![allow(missing_docs)]

mod common;

use std::path::Path;

use assert_cmd::Command;
use common::directory;

/// A slide with a current drive that leans by nothing, and a torque-driven arm on it.
const ARM: &str = "format = 2
[robot]
gravity_m_s2 = [0.0, -9.81, 0.0]
[[joint]]
kind = \"prismatic\"
axis = [1.0, 0.0, 0.0]
mass_kg = 2.0
com_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [0.1, 0.0, 0.0, 0.1, 0.0, 0.1]
armature_kg = 0.5
[joint.drive]
kind = \"current\"
torque_constant_N_per_A = 4.0
[[joint]]
name = \"arm\"
kind = \"revolute\"
axis = [0.0, 0.0, 1.0]
mass_kg = 1.0
com_m = [0.5, 0.0, 0.0]
inertia_kg_m2 = [0.0, 0.0, 0.0, 0.1, 0.0, 0.1]
[joint.drive]
kind = \"torque\"
";

const STATES: &str = "q1_m,q2_rad,qd1_m_per_s,qd2_rad_per_s,qdd1_m_per_s2,qdd2_rad_per_s2\n\
                      0.3,0,1,2,3,0\n0.1,0,0,0,0,1\n";

fn run(place: &Path, model: &str, states: &str) -> assert_cmd::assert::Assert {
    std::fs::write(place.join("model.toml"), model).unwrap();
    std::fs::write(place.join("states.csv"), states).unwrap();
    let files = ["--model", "model.toml", "states.csv", "--out", "out.csv"];
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.current_dir(place).arg("inverse-dynamics").args(files).assert()
}

fn assert_refused(model: &str, states: &str, parts: &[&str]) {
    let place = directory();
    let assert = run(place.path(), model, states).code(2).stdout("");
    let text = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert_eq!(text.lines().count(), 2, "{text}");
    for part in parts {
        assert!(text.contains(part), "no `{part}` in: {text}");
    }
    assert!(!place.path().join("out.csv").exists());
}

#[test]
fn inverse_dynamics_has_the_units_of_the_joints() {
    let place = directory();
    run(place.path(), ARM, STATES).success().stderr("");
    let text = std::fs::read_to_string(place.path().join("out.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "tau1_N,tau2_Nm,u1_A");
    let row = |line: &str| -> Vec<f64> { line.split(',').map(|x| x.parse().unwrap()).collect() };
    // 3.5 kg at 3 m/s^2, less 0.5 kg m at (2 rad/s)^2 outwards; the arm weighs 1 kg at 0.5 m.
    for (line, expected) in [
        (lines[1], [3.5 * 3.0 - 2.0, 0.5 * 9.81, (3.5 * 3.0 - 2.0) / 4.0]),
        (lines[2], [0.0, 0.5 * 9.81 + 0.1 + 0.25, 0.0]),
    ] {
        for (found, expected) in row(line).into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{line}");
        }
    }
}

/// Friction that grows with the load, and with the square of the velocity, is what the drive must put out, too.
#[test]
fn inverse_dynamics_has_effects_of_friction() {
    let place = directory();
    let effects = "friction = { alpha0_V = 0.1, alpha2_V_s_per_rad = 0.05 }
[[effect]]
effect = \"load_friction\"
joint = 2
parameters = { coefficient_V_per_Nm = 0.02 }
[[effect]]
effect = \"quadratic_drag\"
joint = 2
parameters = { coefficient_V_s2_per_rad2 = -0.01 }
";
    let model =
        ARM.replace("[joint.drive]\nkind = \"torque\"\n", "drive = { kind = \"torque\" }\n");
    run(place.path(), &(model + effects), STATES).success().stderr("");
    let text = std::fs::read_to_string(place.path().join("out.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "tau1_N,tau2_Nm,u1_A,friction2_Nm,needed2_Nm");
    let weight = 0.5 * 9.81;
    let friction = 0.1 + 0.05 * 2.0 + 0.02 * weight - 0.01 * 4.0;
    let row: Vec<f64> = lines[1].split(',').map(|x| x.parse().unwrap()).collect();
    assert!((row[3] - friction).abs() < 1e-12, "{}", lines[1]);
    assert!((row[4] - weight - friction).abs() < 1e-12, "{}", lines[1]);
    assert!(lines[2].split(',').nth(3) == Some("0"), "{}", lines[2]);
}

#[test]
fn inverse_dynamics_names_what_is_wrong_with_an_arm() {
    let states = STATES.replace("q1_m,", "q1_rad,");
    assert_refused(ARM, &states, &["states.csv: the column q1_m is missing"]);
    let model = ARM.replace("mass_kg = 1.0\n", "");
    assert_refused(&model, STATES, &["model.toml, line 14", "mass_kg of joint 2 (arm) is missing"]);
    let model = ARM.replace("armature_kg", "armature_kg_m2");
    assert_refused(&model, STATES, &["model.toml, line 10: armature_kg_m2 is not known"]);
}

/// The servo arm that was measured: gravity and inertia alone are of the size that its drives have.
#[test]
fn inverse_dynamics_of_a_measured_arm() {
    let Some(model) = test_support::data("real/so101/model.toml") else { return };
    let model = std::fs::read_to_string(model).unwrap();
    let names = |name: &str, unit: &str| -> String {
        (1..=6).map(|joint| format!("{name}{joint}_{unit},")).collect()
    };
    let header = [names("q", "rad"), names("qd", "rad_per_s"), names("qdd", "rad_per_s2")].concat();
    let states = format!("{}\n{}\n", header.trim_end_matches(','), ["0"; 18].join(","));
    let place = directory();
    run(place.path(), &model, &states).success().stderr("");
    let text = std::fs::read_to_string(place.path().join("out.csv")).unwrap();
    assert!(text.starts_with("tau1_Nm,tau2_Nm,tau3_Nm,tau4_Nm,tau5_Nm,tau6_Nm\n"), "{text}");
    let torques = text.lines().nth(1).unwrap().split(',');
    assert!(torques.map(|x| x.parse::<f64>().unwrap()).all(|torque_nm| torque_nm.abs() < 1.0));
}

/// Commands that know the three-joint robot alone say so.
#[test]
fn other_commands_refuse_an_arm_of_any_kind() {
    let place = directory();
    std::fs::write(place.path().join("model.toml"), ARM).unwrap();
    std::fs::write(place.path().join("dataset.toml"), "format = 1\n").unwrap();
    let refusal = |arguments: &[&str]| {
        let mut command = Command::cargo_bin("rrr").unwrap();
        let assert = command.current_dir(place.path()).args(arguments).assert().code(2);
        String::from_utf8(assert.get_output().stderr.clone()).unwrap()
    };
    let text = refusal(&["validate", ".", "--model", "model.toml", "--out", "out"]);
    assert!(text.contains("format 2 is not known here") && text.contains("any kind"), "{text}");
    let simulate = ["simulate", "--model", "model.toml", "--out", "out", "--dataset"];
    let text = refusal(&[&simulate[..], &["task"]].concat());
    assert!(text.contains("--dataset task") && text.contains("take --dataset gap"), "{text}");
    let text = refusal(&[&simulate[..], &["gap", "--mode", "pd"]].concat());
    assert!(text.contains("--mode is for the robot of three joints"), "{text}");
}
