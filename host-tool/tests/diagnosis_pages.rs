//! Pages of synthetic diagnoses; they are left in target/diagnosis-pages to be looked at.

use std::f64::consts::TAU;
use std::path::PathBuf;

use diagnosis::Diagnosis;
use diagnosis::Verdict;
use diagnosis::synthetic::{At, cogging, diagnosis};
use host_tool::commands::diagnose::{in_words, write};

/// Writes all files, and gives the page and the report.
fn written(name: &str, diagnosis: &Diagnosis) -> (String, serde_json::Value) {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../target/diagnosis-pages");
    let directory = root.join(name);
    write(diagnosis, &directory).unwrap();
    let read = |file: &str| std::fs::read_to_string(directory.join(file)).unwrap();
    assert!(read("model.toml").contains("[base]"));
    (read("report.html"), serde_json::from_str(&read("report.json")).unwrap())
}

#[test]
fn a_named_cause_is_said_and_drawn() {
    let hidden = |at: &At| 0.11 * (8.0 * at.q + 0.9).sin();
    let diagnosis = diagnosis(Verdict::Effect, vec![cogging()], hidden);
    let (page, report) = written("effect", &diagnosis);
    let sentence = "Joint 3: cogging, 8 per turn, 0.11 V, explains 95 % of the gap.";
    assert!(page.contains(sentence) && in_words(&diagnosis).starts_with(sentence));
    assert!(page.contains("Rivals, and why they lost") && !page.contains("NaN"));
    let figure = report::diagnosis_page::figure(&diagnosis);
    assert!(figure.matches("<svg").count() >= 3 && figure.contains("per revolution"));
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    assert_eq!(report["verdict"], "effect");
    assert_eq!(report["where"][0]["axis"], "position");
    assert_eq!(report["causes"][0]["parameters"]["harmonic"], 8.0);
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
