//! The result of a diverse trial as a page of Markdown.

use super::outcome::DiverseOutcome;
use super::results::DiverseResults;
use super::score::{Answers, DiverseScore, KNOWABLE, Reliability, Row};
use crate::claim::answer_in_words;
use crate::markdown::{counted, drawn_head, percent, sealed_head, table, with_parameters};

/// Length of a full bar [characters].
const BAR: f64 = 30.0;

/// What is said of answers of an earlier run, before which the hash of the truth as drawn then was told.
fn resumed(sha256: &str) -> String {
    format!(
        ", with answers of an earlier run; SHA-256 of the truth as drawn again for this page: `{sha256}`.\n"
    )
}

const TITLE: &str = "Blind trial, diverse realities";

/// What is said of answers to searches that were told the truth.
const NOT_BLIND: &str =
    "\n**Not blind:** searches were told the true causes first (`--suspect-truth`).\n";

/// The whole page.
pub fn page(results: &DiverseResults) -> String {
    let DiverseResults { cases: all, first, seed, sha256, .. } = results;
    let mut head = match results.resumed {
        true => drawn_head(TITLE, all.len(), first, seed) + &resumed(sha256),
        false => sealed_head(TITLE, all.len(), first, seed, sha256),
    };
    if all.iter().any(|case| case.suspects_truth) {
        head += NOT_BLIND;
    }
    [head, short(results), cases(&results.cases)].join("\n")
}

/// The page without the line for each case.
pub fn short(results: &DiverseResults) -> String {
    let score = &results.score;
    let parts = [
        answers(score),
        rows("By law of friction", &score.by_friction),
        rows("By largest cause", &score.by_cause),
        rows("By share of the largest cause", &score.by_share),
        reliability(&score.reliability),
        risk(&score.reliability),
        times(score),
    ];
    parts.join("\n")
}

fn answers(score: &DiverseScore) -> String {
    let Answers {
        wrong_name,
        wrong_claims,
        knowable_first,
        knowable_named,
        confirmable_first,
        measurable_first,
        dominated_first,
        knowable_pairs,
        beyond_knowable,
        nothing_right,
        nameless_right,
        failed,
    } = score.answers;
    let oracle = format!("oracle above {KNOWABLE}");
    let rows = [
        ("a wrong name, of all cases".to_owned(), wrong_name),
        ("wrong names, of all names".to_owned(), wrong_claims),
        (format!("{oracle}: largest cause first"), knowable_first),
        (format!("{oracle}: largest cause named"), knowable_named),
        (
            format!("{oracle}, a tenth or more of the gap of the logs held out: first"),
            confirmable_first,
        ),
        (
            format!(
                "{oracle}, a tenth or more of that gap by the report's own measure, in the catalogue: first"
            ),
            measurable_first,
        ),
        ("one cause, more than half of the gap: first".to_owned(), dominated_first),
        (format!("two causes, both {oracle}: both named"), knowable_pairs),
        (format!("not {oracle}: largest cause named all the same"), beyond_knowable),
        ("nothing but small effects: no wrong name".to_owned(), nothing_right),
        ("a cause without a name: no wrong name".to_owned(), nameless_right),
        ("intervals of shares hold".to_owned(), score.intervals.shares),
        ("intervals of parameters hold".to_owned(), score.intervals.parameters),
        ("diagnosis failed".to_owned(), failed),
    ];
    let rows = rows.into_iter().filter(|(_, share)| share.of > 0);
    let rows = rows.map(|(what, share)| [what, counted(share), percent(share)]);
    table("Answers", &["what", "cases", "share, 95 % interval"], rows)
}

fn rows(heading: &str, rows: &[Row]) -> String {
    let cells = rows.iter().map(|row| {
        let verdicts: Vec<String> =
            row.verdicts.iter().map(|(verdict, count)| format!("{verdict} {count}")).collect();
        let [first, wrong] = [row.knowable_first, row.wrong_name].map(counted);
        [row.what.clone(), first, wrong, verdicts.join(", ")]
    });
    let header = ["what", "knowable: largest cause first", "a wrong name", "verdicts"];
    table(heading, &header, cells)
}

fn reliability(reliability: &Reliability) -> String {
    let cells = reliability.bins.iter().map(|bin| {
        let range = format!("{:.1} to {:.1}", bin.from, bin.to);
        let length = (BAR * bin.right.part().unwrap_or_default()).round() as usize;
        let [stated, bar] = [format!("{:.2}", bin.stated), "#".repeat(length)];
        [range, stated, counted(bin.right), percent(bin.right), bar]
    });
    let header = ["stated", "mean", "right", "share, 95 % interval", "bar"];
    let text = table("Probabilities", &header, cells);
    match (reliability.error, reliability.brier) {
        (Some(error), Some(brier)) => format!(
            "{text}\nExpected calibration error {error:.3}, Brier score {brier:.3}; 0 is perfect.\n"
        ),
        _ => text,
    }
}

fn risk(reliability: &Reliability) -> String {
    let cells = reliability.risk.iter().map(|risk| {
        let coverage = format!("{:.0} %", 100.0 * risk.coverage);
        [coverage, format!("{:.2}", risk.least), counted(risk.wrong), percent(risk.wrong)]
    });
    let header = ["surest names", "down to", "wrong", "share, 95 % interval"];
    table("Risk against coverage", &header, cells)
}

fn times(score: &DiverseScore) -> String {
    let times = &score.times;
    format!(
        "A case takes {:.1} s, {:.1} s of processor time, {:.1} s at most.\n",
        times.mean_seconds, times.mean_processor_seconds, times.most_processor_seconds
    )
}

fn cases(outcomes: &[DiverseOutcome]) -> String {
    let cells = outcomes.iter().map(|outcome| {
        let right = if outcome.has_wrong_name() {
            "wrong name"
        } else if outcome.truth.is_empty() || outcome.is_first_right() {
            "yes"
        } else {
            ""
        };
        [
            outcome.case.to_string(),
            outcome.reality.friction[0].law.name().to_owned(),
            truth(outcome),
            answer(outcome),
            right.to_owned(),
            format!("{:.0}", outcome.processor_seconds),
        ]
    });
    let header =
        ["case", "friction", "truth: share, oracle", "answer (probability)", "right", "seconds"];
    table("Cases", &header, cells)
}

/// The causes with their shares and what could be known of them.
fn truth(outcome: &DiverseOutcome) -> String {
    let words = outcome.truth.iter().zip(&outcome.known).map(|(truth, known)| {
        let share = known.share.map_or("-".to_owned(), |share| format!("{:.0} %", 100.0 * share));
        format!("{}: {share}, {:.2}", with_parameters(truth), known.oracle)
    });
    let words: Vec<String> = words.collect();
    if words.is_empty() { "none".into() } else { words.join("; ") }
}

/// An answer in words: its verdict, and its causes with their probabilities.
pub fn answer(outcome: &DiverseOutcome) -> String {
    answer_in_words(outcome.failure.as_deref(), &outcome.verdict, &outcome.claims)
}
