//! `rrr blind-trial --diverse`, end to end.
#![allow(missing_docs)]

use assert_cmd::Command;

#[test]
fn two_diverse_cases_are_drawn_diagnosed_and_scored() {
    let directory = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.args(["blind-trial", "--diverse", "--cases", "2", "--seed", "4"]);
    command.args(["--duration-scale", "0.3"]).arg("--out").arg(directory.path());
    let output = command.assert().success().get_output().stdout.clone();
    let said = String::from_utf8(output).unwrap();
    let read = |name: &str| std::fs::read_to_string(directory.path().join(name)).unwrap();
    let seal = read("seal.txt");
    assert!(said.contains(seal.split_whitespace().next().unwrap()), "{said}");
    let cases: Vec<serde_json::Value> = read("diverse-trial.jsonl")
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(cases.len(), 2);
    for case in &cases {
        assert!(case["reality"]["clutter"].as_array().unwrap().len() >= 3, "{case}");
        assert!(case["failure"].is_null(), "{case}");
        assert!(case["processor_seconds"].as_f64().unwrap() > 0.0, "{case}");
    }
    let score: serde_json::Value = serde_json::from_str(&read("diverse-trial.json")).unwrap();
    assert_eq!(score["score"]["answers"]["wrong_name"]["of"], 2);
    assert!(read("diverse-trial.md").contains("## By law of friction"));
    assert!(!directory.path().join("case-001").exists(), "logs are taken away");
    let (lines, page) = (read("diverse-trial.jsonl"), read("diverse-trial.md"));
    let first = lines.lines().next().unwrap();
    // As if it had been stopped in the second case, and that known already.
    let second = lines.lines().nth(1).unwrap();
    let stopped = format!("{first}\n{second}\n{}", &second[..second.len() / 2]);
    std::fs::write(directory.path().join("diverse-trial.jsonl"), stopped).unwrap();
    let mut resumed = Command::cargo_bin("rrr").unwrap();
    resumed.args(["blind-trial", "--diverse", "--resume", "--cases", "2", "--seed", "4"]);
    resumed.args(["--duration-scale", "0.3"]).arg("--out").arg(directory.path());
    let again = resumed.assert().success().get_output().stdout.clone();
    assert!(!String::from_utf8(again).unwrap().contains("case 001:"), "it is not diagnosed again");
    assert_eq!(read("diverse-trial.jsonl"), lines);
    let resumed = read("diverse-trial.md");
    assert!(resumed.contains("an earlier run") && !page.contains("an earlier run"), "{resumed}");
    assert_eq!(without_seal(&resumed), without_seal(&page));
}

/// A page without the hash of the truth: each run seals it with a random number of its own.
fn without_seal(page: &str) -> Vec<&str> {
    page.lines().filter(|line| !line.contains("SHA-256")).collect()
}

#[test]
fn what_the_diverse_trial_does_not_take_is_named() {
    let mut command = Command::cargo_bin("rrr").unwrap();
    let assert = command.args(["blind-trial", "--diverse", "--only", "cogging"]).assert().code(2);
    let said = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert!(said.contains("--only"), "{said}");
}

/// The causes that are named in a case of a seed.
fn claims(seed: &str, case: &str) -> serde_json::Value {
    let directory = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.args(["blind-trial", "--diverse", "--first", case, "--cases", "1", "--seed", seed]);
    command.args(["--duration-scale", "0.5", "--out"]).arg(directory.path()).assert().success();
    let lines = std::fs::read_to_string(directory.path().join("diverse-trial.jsonl")).unwrap();
    let case: serde_json::Value = serde_json::from_str(lines.lines().next().unwrap()).unwrap();
    case["claims"].clone()
}

/// What they tell of an effect on a joint: the value of a parameter.
fn value(claims: &serde_json::Value, place: (&str, u64), parameter: &str) -> f64 {
    claim(claims, place)["parameters"][parameter].as_f64().unwrap()
}

/// All that they tell of an effect on a joint.
fn claim<'a>(claims: &'a serde_json::Value, (effect, joint): (&str, u64)) -> &'a serde_json::Value {
    let is_it = |claim: &&serde_json::Value| claim["effect"] == effect && claim["joint"] == joint;
    let found = claims.as_array().unwrap().iter().find(is_it);
    found.unwrap_or_else(|| panic!("no {effect} of joint {joint} in {claims}"))
}

/// The same of a case of a seed.
fn told(seed: &str, case: &str, place: (&str, u64), parameter: &str) -> f64 {
    value(&claims(seed, case), place, parameter)
}

/// Friction by Maxwell slip, and small effects everywhere. Drag on joint 3 takes eight tenths of the rms
/// that one log has left there, while another, which looks white at twice its noise, loses a twentieth.
#[test]
fn a_small_effect_beside_friction_of_another_law_is_named() {
    let parameter = "coefficient_V_s2_per_rad2";
    let coefficient = told("57231", "4", ("quadratic_drag", 3), parameter);
    assert!((coefficient / 2.04e-3 - 1.0).abs() < 0.1, "{coefficient}");
}

/// Regularised friction, and small effects everywhere. Without its torque constant one log of joint 1 is left with
/// ten times its noise, and by that weighs next to nothing.
#[test]
fn what_one_log_alone_shows_is_named() {
    let error = told("61283", "30", ("torque_constant", 1), "relative_error");
    assert!((error / -0.187 - 1.0).abs() < 0.1, "{error}");
}

/// A soft constraint, a coarse encoder, and small effects everywhere. Once drag and an offset are in, all logs are left within
/// 1.5 times their noise, 31 mV, and a cogging of 19 mV lasts below that.
#[test]
fn what_lasts_below_the_noise_is_named_beside_larger_causes() {
    let amplitude_v = told("38119", "24", ("cogging", 1), "amplitude_V");
    assert!((amplitude_v / 0.0194 - 1.0).abs() < 0.1, "{amplitude_v}");
}

/// A cable of 4.7 mV/rad that does little of what goes with it on the logs held out.
#[test]
fn what_hardly_acts_is_named_where_nearly_surely_much_goes_with_it() {
    let stiffness = told("14139", "22", ("cable_spring", 2), "stiffness_V_per_rad");
    assert!((stiffness / 4.69e-3 - 1.0).abs() < 0.1, "{stiffness}");
}

/// Play without which parameters of other joints are bent, and what acts there is not found.
#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn play_that_other_causes_need_beside_them_is_named_with_them() {
    let claims = claims("14139", "9");
    let gap_rad = value(&claims, ("backlash", 2), "gap_rad");
    assert!((gap_rad / 5.0e-5 - 1.0).abs() < 0.2, "{gap_rad}");
    let amplitude = value(&claims, ("position_friction", 1), "relative_amplitude");
    assert!((amplitude / 0.306 - 1.0).abs() < 0.05, "{amplitude}");
}

/// Dahl friction, and small effects everywhere. A delay that is sure beside friction of joint 2 by its position stays
/// where that is too small to be named: without it the model was not at its best, and the delay fell.
#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn a_cause_does_not_fall_with_a_small_effect_of_another_joint() {
    let delay_s = told("83117", "21", ("delay", 1), "delay_s");
    assert!((delay_s / 1.62e-3 - 1.0).abs() < 0.1, "{delay_s}");
}

/// Dahl friction that warms, and a model that is a tenth off. With the causes found held parameters leave as little as free
/// ones do, but they are further off than a doubt of 2.5 % allows.
#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn a_cable_is_named_though_the_model_is_further_off_than_its_doubt() {
    let stiffness = told("94483", "32", ("cable_spring", 1), "stiffness_V_per_rad");
    assert!((stiffness / 0.395 - 1.0).abs() < 0.15, "{stiffness}");
}

/// LuGre friction, and small effects everywhere. Without the driven noise the other logs say of the delay what they like;
/// whether it is one or a lag no log tells.
#[test]
#[ignore = "a minute; `cargo xtask test --long`"]
fn a_delay_that_one_log_alone_tells_is_named_with_one_half() {
    let claims = claims("94483", "13");
    let delay = claim(&claims, ("delay", 3));
    let delay_s = delay["parameters"]["delay_s"].as_f64().unwrap();
    assert!((delay_s / 1.26e-3 - 1.0).abs() < 0.1, "{delay_s}");
    let probability = delay["probability"].as_f64().unwrap();
    assert!((0.5..0.7).contains(&probability), "{probability}");
}

/// Dahl friction. What encoder steps push through the spring on a calm joint is as large as what it does there.
#[test]
#[ignore = "a minute; `cargo xtask test --long`"]
fn a_stiff_spring_is_named_beside_calm_logs() {
    let stiffness = told("43468", "65", ("joint_elasticity", 1), "stiffness_Nm_per_rad");
    assert!((stiffness / 91_900.0 - 1.0).abs() < 0.1, "{stiffness}");
}

/// A limit that only the train excitation reaches, without which the logs held out have a gap.
#[test]
#[ignore = "a minute; `cargo xtask test --long`"]
fn a_limit_that_one_log_alone_reaches_is_named() {
    let limit_v = told("43468", "13", ("saturation", 1), "limit_V");
    assert!((limit_v / 4.332 - 1.0).abs() < 0.02, "{limit_v}");
}
