//! Results that do not pass, exit statuses, and answers for programs.

use std::path::Path;

use crate::rrr::{assert_tells, refused, rrr, said, with_model, write};

const STATES: &str = "q1_rad,q2_rad,q3_rad,qd1_rad_per_s,qd2_rad_per_s,qd3_rad_per_s,\
    qdd1_rad_per_s2,qdd2_rad_per_s2,qdd3_rad_per_s2";

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// A folder `logs` with the task of the reference robot, simulated.
fn with_task() -> tempfile::TempDir {
    let directory = with_model();
    said(directory.path(), &words("simulate --model model.toml --dataset task --out logs"));
    directory
}

/// The model with some text exchanged, as `wrong.toml`.
fn with_wrong_model(directory: &Path) {
    let model = std::fs::read_to_string(directory.join("model.toml")).unwrap();
    let wrong = model.replacen("[12.0, 6.3, 3.0]", "[0.5, 0.3, 0.1]", 1);
    assert_ne!(model, wrong);
    write(directory, "wrong.toml", &wrong);
}

#[test]
fn validate_of_a_model_that_explains_nothing_ends_with_status_1_and_says_so() {
    let directory = with_task();
    let at = directory.path();
    said(at, &words("validate logs --model model.toml --out out"));
    with_wrong_model(at);
    let run = rrr(at, &words("validate logs --model wrong.toml --out out"));
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(1), "{text}");
    assert_tells(
        &text,
        &["not passed: wrong.toml: the model leaves", "% of it; 50 % and 20 mV are allowed"],
    );
    assert_tells(&text, &["hint: `rrr diagnose`"]);
    let page = std::fs::read_to_string(at.join("out/validation.html")).unwrap();
    assert!(!page.contains("explains all but"), "{page}");
    assert_tells(&page, &["explains nothing of the command of joint"]);
}

#[test]
fn the_limits_of_validate_are_options() {
    let directory = with_task();
    let line = "validate logs --model model.toml --out out --largest-share 0 --smallest-left-mv 0";
    assert_eq!(rrr(directory.path(), &words(line)).status.code(), Some(1));
    with_wrong_model(directory.path());
    let line = "validate logs --model wrong.toml --out out --largest-share 10000";
    assert_eq!(rrr(directory.path(), &words(line)).status.code(), Some(0));
}

#[test]
fn exit_statuses_are_one_table_in_the_help_and_in_the_documentation() {
    use host_tool::failure::status::{STATUSES, help, markdown};
    let text = said(Path::new("."), &["help"]);
    assert!(text.contains(&help().trim_end().replace("\n\n", "\n")), "{text}");
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/files.md");
    let page = std::fs::read_to_string(page).unwrap();
    assert!(page.contains(&markdown()), "docs/files.md needs this table:\n{}", markdown());
    assert_eq!(STATUSES.map(|(status, _)| status), [0, 1, 2, 130]);
}

/// The one JSON object that a command answers with.
fn answer(directory: &Path, line: &str) -> serde_json::Value {
    let text = said(directory, &words(&format!("{line} --json")));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{line}: {error}: {text}"))
}

#[test]
fn every_command_with_results_answers_with_one_json_object() {
    let directory = with_task();
    let at = directory.path();
    let held = answer(at, "validate logs --model model.toml --out out");
    assert_eq!(held["passed"], true);
    assert!(held["logs"][0]["joints"][2]["share"].as_f64().unwrap() < 0.1, "{held}");
    let simulated = answer(at, "simulate --model model.toml --dataset task --out more");
    assert_eq!(simulated["logs"][0], "task.csv.gz");
    let designed =
        answer(at, "design-excitation --model model.toml --out motion.toml --seconds 0.2");
    assert!(designed["condition_number"].is_number(), "{designed}");
    let diagnosed = answer(at, "diagnose logs --model model.toml --out diagnosis");
    let report = std::fs::read_to_string(at.join("diagnosis/report.json")).unwrap();
    assert_eq!(diagnosed, serde_json::from_str::<serde_json::Value>(&report).unwrap());
    write(at, "others/run.csv", "time_ms,pos_1_deg,torque_cmd_1\n0,10,0.1\n2,200,0.2\n4,30,0.1\n");
    let imported = answer(at, "import others");
    assert!(imported["guessed"][0].as_str().unwrap().starts_with("t_s"), "{imported}");
    let exported = answer(at, "export-block model.toml --out block.bin");
    assert!(exported["bytes"].is_number(), "{exported}");
    write(at, "states.csv", &format!("{STATES}\n{}\n", ["0"; 9].join(",")));
    let moved = answer(at, "inverse-dynamics --model model.toml states.csv --out torques.csv");
    assert_eq!(moved["samples"], 1);
    let completed = answer(at, "completions bash");
    assert!(completed["script"].as_str().unwrap().contains("rrr"), "{completed}");
}

#[test]
fn a_command_line_that_cannot_be_used_is_answered_in_json_too() {
    for line in ["validate --json", "no-such-command --json", "simulate --json --noise-v nan"] {
        let run = rrr(Path::new("."), &words(line));
        let failure: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
        assert_eq!((run.status.code(), &failure["status"]), (Some(2), &2.into()), "{line}");
        assert!(!failure["error"].as_str().unwrap().starts_with("error"), "{failure}");
        assert!(String::from_utf8(run.stderr).unwrap().starts_with("error: "), "{line}");
    }
    assert!(said(Path::new("."), &words("validate --help --json")).contains("Usage"));
}

#[test]
fn a_failure_is_json_too() {
    let directory = with_model();
    let run = rrr(directory.path(), &words("validate none --model model.toml --out out --json"));
    let failure: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!((run.status.code(), &failure["status"]), (Some(2), &2.into()));
    assert!(failure["error"].as_str().unwrap().contains("none/dataset.toml"), "{failure}");
    assert!(failure["hint"].is_string());
    refused(directory.path(), &words("validate none --model model.toml --out out"));
}

#[test]
fn identify_does_not_write_a_model_that_it_calls_impossible() {
    let directory = with_model();
    let at = directory.path();
    let line = "simulate --model model.toml --dataset excitation --out logs --format csv";
    said(at, &words(line));
    // Every command with the other sign: inertias come out negative.
    let log = at.join("logs/excitation.csv");
    let mut recorded = files::Log::read(&log).unwrap();
    recorded.joints.iter_mut().flat_map(|joint| &mut joint.command_v).for_each(|u| *u = -*u);
    recorded.write(&log).unwrap();
    let run = rrr(at, &words("identify logs --robot model.toml --out found/model.toml --json"));
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(1), "{text}");
    assert_tells(
        &text,
        &["not passed: no robot has these parameters: ", "found/model.toml is not written"],
    );
    assert!(!at.join("found/model.toml").exists());
    assert!(at.join("found/model.impossible.toml").exists());
    let found: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(found["possible"], false);
}
