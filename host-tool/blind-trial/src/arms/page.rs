//! The result of a trial as a page of Markdown.

use serde::Serialize;

use super::draw::ArmTrialSettings;
use super::outcome::ArmOutcome;
use super::score::ArmScore;
use crate::claim::answer_in_words;
use crate::diverse::KNOWABLE;
use crate::markdown::{counted, percent, sealed_head, table, with_parameters};

/// The result of a trial.
#[derive(Clone, Debug, Serialize)]
pub struct ArmResults {
    /// Version of this layout.
    pub format: u32,
    /// The kind of arm.
    pub arm: &'static str,
    /// The seed.
    pub seed: u32,
    /// Number of the first case.
    pub first: u32,
    /// SHA-256 of the truth.
    pub sha256: String,
    /// Counts.
    pub score: ArmScore,
    /// Truth and answer of each case.
    pub cases: Vec<ArmOutcome>,
}

impl ArmResults {
    /// Scores the outcomes.
    pub fn new(settings: &ArmTrialSettings, sha256: &str, cases: Vec<ArmOutcome>) -> Self {
        Self {
            format: 1,
            arm: settings.arm.name(),
            seed: settings.seed,
            first: settings.first,
            sha256: sha256.to_owned(),
            score: ArmScore::of(&cases),
            cases,
        }
    }
}

/// The whole page.
pub fn page(results: &ArmResults) -> String {
    let ArmResults { arm, cases: all, first, seed, sha256, .. } = results;
    let title = format!("Blind trial of another arm: {arm}");
    let head = sealed_head(&title, all.len(), first, seed, sha256);
    [head, short(results), cases(&results.cases)].join("\n")
}

/// The counts.
pub fn short(results: &ArmResults) -> String {
    let ArmScore { knowable_first, beyond_knowable, wrong_name, clean_none, failed } =
        results.score;
    let rows = [
        (format!("oracle above {KNOWABLE}: named first, on its joint"), knowable_first),
        (format!("not above {KNOWABLE}: named first all the same"), beyond_knowable),
        ("a wrong name, of all cases".to_owned(), wrong_name),
        ("nothing hidden: \"none\"".to_owned(), clean_none),
        ("diagnosis failed".to_owned(), failed),
    ];
    let rows = rows.into_iter().filter(|(_, share)| share.of > 0);
    let rows = rows.map(|(what, share)| [what, counted(share), percent(share)]);
    table("Answers", &["what", "cases", "share, 95 % interval"], rows)
}

fn cases(outcomes: &[ArmOutcome]) -> String {
    let cells = outcomes.iter().map(|outcome| {
        let truth = outcome.truth.as_ref().map_or("nothing".to_owned(), with_parameters);
        let oracle = outcome.oracle.map_or(String::new(), |oracle| format!("{oracle:.2}"));
        let seconds = format!("{:.0}", outcome.seconds);
        [outcome.case.to_string(), truth, oracle, answer(outcome), judged(outcome), seconds]
    });
    table("Cases", &["case", "truth", "oracle", "answer (probability)", "right", "seconds"], cells)
}

fn judged(outcome: &ArmOutcome) -> String {
    let is_right = match outcome.truth {
        None => outcome.is_none(),
        Some(_) => outcome.is_first_right(),
    };
    let word = match (outcome.has_wrong_name(), is_right) {
        (true, _) => "wrong name",
        (false, true) => "yes",
        (false, false) => "",
    };
    word.to_owned()
}

/// An answer in words: its verdict, and its causes with their probabilities.
pub fn answer(outcome: &ArmOutcome) -> String {
    answer_in_words(outcome.failure.as_deref(), &outcome.verdict, &outcome.claims)
}
