//! Pages of synthetic diagnoses; they are left in target/diagnosis-pages to be looked at.

use std::f64::consts::TAU;
use std::path::PathBuf;

use diagnosis::synthetic::{At, cogging, diagnosis, more_viscous, payload, slow_friction};
use diagnosis::{Alternative, Diagnosis, Verdict};
use host_tool::commands::diagnose::{in_words, write};

/// Writes all files, and gives the page and the report.
fn written(name: &str, diagnosis: &Diagnosis) -> (String, serde_json::Value) {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../target/diagnosis-pages");
    let directory = root.join(name);
    write(diagnosis, &directory, &Default::default()).unwrap();
    let read = |file: &str| std::fs::read_to_string(directory.join(file)).unwrap();
    assert!(read("model.toml").contains("[base]"));
    (read("report.html"), serde_json::from_str(&read("report.json")).unwrap())
}

#[test]
fn a_named_cause_is_said_and_drawn() {
    let hidden = |at: &At| 0.11 * (8.0 * at.q + 0.9).sin();
    let diagnosis = diagnosis(Verdict::Effect, vec![cogging()], hidden);
    let (page, report) = written("effect", &diagnosis);
    let sentence = "Joint 3: cogging, 8 per turn, 0.11 V: 95 % of its gap [93 to 96], sure (97 %).";
    assert!(page.contains(sentence) && in_words(&diagnosis).starts_with(sentence));
    assert!(page.contains("Rivals, and why they lost") && !page.contains("NaN"));
    let figure = report::diagnosis_page::figure(&diagnosis);
    assert!(figure.matches("<svg").count() >= 3 && figure.contains("per revolution"));
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    assert_eq!((&report["verdict"], &report["format"]), (&"effect".into(), &2.into()));
    assert_eq!(report["where"][0]["axis"], "position");
    assert_eq!(report["causes"][0]["parameters"]["harmonic"], 8.0);
}

/// Two causes, a remainder and a model that was refitted.
fn partial() -> Diagnosis {
    let hidden = |at: &At| 0.11 * (8.0 * at.q + 0.9).sin();
    let mut partial = diagnosis(Verdict::Partial, vec![payload(), cogging()], hidden);
    let report = &mut partial.report;
    report.parameters_changed = vec![more_viscous()];
    report.remainder = vec![slow_friction()];
    report.gap.with_effects_v[1] = 0.016;
    report.alternatives.push(Alternative {
        effect: "torque_ripple".into(),
        joint: 3,
        probability: 0.02,
        confidence: 0.02,
        instead_of: Some(1),
        share: 0.3,
        why: None,
    });
    report.alternatives.push(Alternative {
        effect: "dead_zone".into(),
        joint: 1,
        probability: 0.6,
        confidence: 0.6,
        instead_of: None,
        share: 0.2,
        why: Some("its share may be nothing".into()),
    });
    partial
}

#[test]
fn what_is_named_in_part_is_drawn_with_its_remainder() {
    let diagnosis = partial();
    let (page, report) = written("partial", &diagnosis);
    assert!(in_words(&diagnosis).contains("The rest, 4 %: joint 2 over velocity"), "the rest");
    for words in [
        "Joint 2 over velocity, friction below 0.02 rad/s: 4 %",
        "velocity [rad/s]",
        "joint 2, viscous friction",
        "+18 %",
        "94 % of the gap, sure (98 %)",
        "its share may be nothing",
        "with tables",
        "Confirmed on: excitation-2.csv.",
    ] {
        assert!(page.contains(words), "no `{words}`");
    }
    assert!(!page.contains("NaN"));
    assert_eq!(report["verdict"], "partial");
}

/// The contract's keys of format 2, as pointers into a report with an entry of each list.
#[test]
fn a_written_report_has_all_keys_of_its_format() {
    let (_, report) = written("keys", &partial());
    for key in [
        "/causes/0/effect",
        "/causes/0/joint",
        "/causes/0/parameters/mass_kg",
        "/causes/0/parameter_intervals/mass_kg/1",
        "/causes/0/probability",
        "/causes/0/confidence",
        "/causes/0/share",
        "/causes/0/share_interval/1",
        "/causes/0/shrinkage",
        "/causes/0/shrinkage_interval/1",
        "/alternatives/0/effect",
        "/alternatives/0/joint",
        "/alternatives/0/probability",
        "/alternatives/0/instead_of",
        "/alternatives/0/share",
        "/parameters_changed/0/parameter",
        "/parameters_changed/0/given",
        "/parameters_changed/0/found",
        "/parameters_changed/0/interval/1",
        "/parameters_changed/0/share",
        "/remainder/0/joint",
        "/remainder/0/axis",
        "/remainder/0/rms_V",
        "/remainder/0/share",
        "/remainder/0/detail",
        "/remainder/0/curve/x/0",
        "/remainder/0/curve/y_V/0",
        "/remainder/0/curve/deviation_V/0",
        "/remainder/0/nearest",
        "/where/0/joint",
        "/where/0/axis",
        "/where/0/share",
        "/where/0/detail",
        "/gap/as_given_V/2",
        "/gap/refitted_V/2",
        "/gap/with_effects_V/2",
        "/gap/with_tables_V/2",
        "/gap/noise_floor_V/2",
        "/gap/refitted_rad/2",
        "/gap/with_effects_rad/2",
        "/data/fit/0",
        "/data/select/0",
        "/data/confirm/0",
        "/untestable/0/effect",
        "/untestable/0/joint",
        "/untestable/0/why",
    ] {
        assert!(report.pointer(key).is_some_and(|value| !value.is_null()), "no `{key}`");
    }
    assert_eq!(report["format"], 2);
}

#[test]
fn without_a_gap_the_page_says_so() {
    let diagnosis = diagnosis(Verdict::None, vec![], |_| 0.0);
    let (page, report) = written("none", &diagnosis);
    assert!(page.contains("No gap above the noise"), "{}", in_words(&diagnosis));
    assert_eq!(report["where"].as_array().map(Vec::len), Some(0));
}

#[test]
fn what_is_unknown_is_described() {
    let hum = |at: &At| 0.05 * (TAU * 50.0 * at.t).sin();
    let (page, _) = written("hum", &diagnosis(Verdict::Unknown, vec![], hum));
    assert!(page.contains("it varies with frequency: a line at 50.0 Hz"));
    let stick = |at: &At| 0.03 * at.qd.abs() + 0.04 * (-(at.qd / 0.3).powi(2)).exp();
    let (page, _) = written("unknown", &diagnosis(Verdict::Unknown, vec![], stick));
    assert!(page.contains("that nothing in the catalogue explains"));
}

#[test]
fn a_diagnosis_without_logs_is_no_trouble() {
    let mut empty = diagnosis(Verdict::Unknown, vec![], |_| 0.0);
    empty.logs.clear();
    empty.waterfall.clear();
    empty.rivals.clear();
    written("empty", &empty);
}
