//! The result of a trial of the whole way as a page of Markdown.

use super::results::{WholeWayResults, WholeWayRow};
use super::run::WholeWayOutcome;
use crate::diverse;
use crate::markdown::{counted, percent, table, with_parameters};

/// The whole page.
pub fn page(results: &WholeWayResults) -> String {
    let head = format!(
        "# Blind trial, the whole way\n\n{} robots from number {} of seed {}: recorded, identified, \
         changed, recorded again, diagnosed with the identified model.\n",
        results.robots.len(),
        results.first,
        results.seed,
    );
    let parts = [
        head,
        answers(results),
        rows("By law of friction", &results.by_law),
        rows("By change", &results.by_change),
        robots(&results.robots),
    ];
    parts.join("\n")
}

/// An answer in a line: the change, and what was said.
pub fn answer(outcome: &WholeWayOutcome) -> String {
    let truth = outcome.outcome.truth.first().map_or_else(|| "none".into(), with_parameters);
    format!("{truth} -> {}", diverse::answer(&outcome.outcome))
}

fn answers(results: &WholeWayResults) -> String {
    let rows = [
        ("the change is named first, with its joint", results.named_first),
        ("the change is named", results.named),
        ("a wrong name", results.wrong_name),
        ("identification, change or diagnosis failed", results.failed),
    ];
    let rows = rows.into_iter().map(|(what, share)| [what.into(), counted(share), percent(share)]);
    table("Answers", &["what", "robots", "share, 95 % interval"], rows)
}

fn rows(heading: &str, rows: &[WholeWayRow]) -> String {
    let cells = rows
        .iter()
        .map(|row| [row.what.clone(), counted(row.named_first), counted(row.wrong_name)]);
    table(heading, &["what", "change named first", "a wrong name"], cells)
}

fn robots(robots: &[WholeWayOutcome]) -> String {
    let cells = robots.iter().map(|robot| {
        let outcome = &robot.outcome;
        let right = match (outcome.is_first_right(), outcome.has_wrong_name()) {
            (true, false) => "yes",
            (true, true) => "yes, and a wrong name",
            (false, true) => "wrong name",
            (false, false) => "",
        };
        [
            outcome.case.to_string(),
            outcome.reality.friction[0].law.name().to_owned(),
            robot.held_out_v.map(|v| format!("{:.1}", 1e3 * v)).join(", "),
            robot.visibility.map_or(String::new(), |v| format!("{:.1}", v.raw)),
            outcome.truth.first().map_or_else(|| "none".into(), with_parameters),
            diverse::answer(outcome),
            right.to_owned(),
            format!("{:.0}", outcome.processor_seconds),
        ]
    });
    let header = [
        "robot",
        "friction",
        "model leaves, joint 1 to 3 [mV]",
        "change shows, times what the model leaves",
        "change",
        "answer (probability)",
        "right",
        "seconds",
    ];
    table("Robots", &header, cells)
}
