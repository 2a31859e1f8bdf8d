//! The result as a page of Markdown, which the terminal shows as it is.

use std::fmt::Display;

use super::answer::Answer;
use super::case::Kind;
use super::outcome::Outcome;
use super::results::Results;
use super::score::{ConfusionRow, ParameterScore, Score, Share};
use super::{TrueCause, cause};

/// The head of a page: what was drawn, and by which digest its truth was sealed.
pub fn sealed_head(
    title: &str,
    cases: usize,
    first: impl Display,
    seed: impl Display,
    sha256: &str,
) -> String {
    let drawn = drawn_head(title, cases, first, seed);
    format!("{drawn}; SHA-256 of the truth, told before the first diagnosis: `{sha256}`.\n")
}

/// The same without the digest and the end of the sentence.
pub fn drawn_head(title: &str, cases: usize, first: impl Display, seed: impl Display) -> String {
    format!("# {title}\n\n{cases} cases from number {first} of seed {seed}")
}

/// The whole page.
pub fn page(results: &Results) -> String {
    let score = &results.score;
    [
        head(results),
        summary(score),
        confusion(&score.confusion),
        parameters(&score.parameters),
        calibration(score),
        closed(score),
        cases(&results.cases),
    ]
    .join("\n")
}

/// The page without the line for each case.
pub fn short(results: &Results) -> String {
    let score = &results.score;
    let parts = [
        summary(score),
        confusion(&score.confusion),
        parameters(&score.parameters),
        calibration(score),
        closed(score),
    ];
    parts.join("\n")
}

fn head(results: &Results) -> String {
    format!(
        "# Blind trial\n\n{} cases from number {} of seed {}; SHA-256 of the truth, told before \
         the first diagnosis: `{}`. {:.0} s a case.\n",
        results.cases.len(),
        results.first,
        results.seed,
        results.sha256,
        results.score.mean_seconds
    )
}

fn summary(score: &Score) -> String {
    let rows = [
        ("wholly right", score.right),
        ("one effect: first cause right, with its joint", score.singles.right),
        ("one effect: and nothing else named", score.singles.right_alone),
        ("one effect: effect right on any joint", score.singles.effect_right),
        ("one effect: wrong first, but the truth not ruled out", score.singles.not_ruled_out),
        ("one effect: \"none\"", score.singles.missed),
        ("one effect: \"unknown\"", score.singles.unknown),
        ("two effects: both named", score.pairs.both),
        ("two effects: both and no other", score.pairs.both_alone),
        ("two effects: one of them named", score.pairs.one),
        ("two effects: a wrong one named", score.pairs.wrong_name),
        ("nothing hidden: \"none\"", score.nothing.right),
        ("nothing hidden: false alarm", score.nothing.false_alarms),
        ("nothing hidden: \"unknown\"", score.nothing.unknown),
        ("foreign effect: \"unknown\"", score.foreign.unknown),
        ("foreign effect: wrong name", score.foreign.wrong_name),
        ("foreign effect: \"none\"", score.foreign.missed),
        ("joint of the first cause right, one effect", score.joints.named),
        ("joint of the largest place right, one cause", score.joints.largest_place),
        ("diagnosis failed", score.failed),
    ];
    let rows = rows.iter().filter(|(_, share)| share.of > 0);
    let rows = rows.map(|(what, share)| [(*what).to_owned(), counted(*share), percent(*share)]);
    table("Answers", &["what", "cases", "share, 95 % interval"], rows)
}

pub(crate) fn counted(share: Share) -> String {
    format!("{} of {}", share.count, share.of)
}

pub(crate) fn percent(share: Share) -> String {
    match (share.part(), share.interval()) {
        (Some(part), Some([from, to])) => {
            format!("{:.0} % ({:.0} to {:.0})", 100.0 * part, 100.0 * from, 100.0 * to)
        }
        _ => String::new(),
    }
}

fn confusion(rows: &[ConfusionRow]) -> String {
    let cells = rows.iter().map(|row| {
        let mut answers: Vec<(&String, &usize)> = row.answers.iter().collect();
        answers.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        let answers: Vec<String> =
            answers.into_iter().map(|(answer, count)| format!("{answer} {count}")).collect();
        let truth = if row.foreign { format!("foreign: {}", row.truth) } else { row.truth.clone() };
        [truth, counted(Share { count: row.right, of: row.cases }), answers.join(", ")]
    });
    table("What was named first", &["truth, pairs left out", "right", "answers"], cells)
}

fn parameters(scores: &[ParameterScore]) -> String {
    let cells = scores.iter().map(|score| {
        let median = score.median_error.map_or(String::new(), |error| match score.in_rad {
            true => format!("{error:.3} rad"),
            false => format!("{:.1} %", 100.0 * error),
        });
        [score.effect.clone(), score.parameter.clone(), median, counted(score.small)]
    });
    let header = ["effect rightly named", "parameter", "median error", "within 10 % or 0.1 rad"];
    table("Parameters", &header, cells)
}

fn calibration(score: &Score) -> String {
    let cells = score.calibration.bins.iter().map(|bin| {
        let range = format!("{} to {}", bin.from, bin.to);
        [range, format!("{:.2}", bin.stated), counted(bin.right), percent(bin.right)]
    });
    let text = table("Confidence", &["stated", "mean", "right", "share, 95 % interval"], cells);
    match score.calibration.brier {
        Some(brier) => format!("{text}\nBrier score {brier:.3}; 0 is perfect.\n"),
        None => text,
    }
}

fn closed(score: &Score) -> String {
    let shrinkage = &score.shrinkage;
    let (Some(median), Some(mean), Some(whole)) =
        (shrinkage.median, shrinkage.mean, shrinkage.median_shrinkage)
    else {
        return String::new();
    };
    let floor = match shrinkage.by_noise_floor {
        true => "the noise floor that the diagnosis reports",
        false => "what it leaves of the same robot without the effects",
    };
    format!(
        "## Gap closed\n\nOf what lies above {floor}, on the logs held out of {} cases: median \
         {:.0} %, mean {:.0} %. Median shrinkage {whole:.2}.\n",
        shrinkage.cases,
        100.0 * median,
        100.0 * mean
    )
}

fn cases(outcomes: &[Outcome]) -> String {
    let cells = outcomes.iter().map(|outcome| {
        let right = if outcome.is_right() { "yes" } else { "no" };
        [
            outcome.case.to_string(),
            truth(outcome),
            answer(&outcome.answer),
            right.to_owned(),
            format!("{:.0}", outcome.seconds),
        ]
    });
    table("Cases", &["case", "truth", "answer (confidence)", "right", "seconds"], cells)
}

/// The truth of a case with its parameters.
fn truth(outcome: &Outcome) -> String {
    let words: Vec<String> = outcome.truth.iter().map(with_parameters).collect();
    match outcome.kind {
        Kind::None => "none".into(),
        Kind::Foreign => format!("foreign: {}", words.join("; ")),
        _ => words.join("; "),
    }
}

pub(crate) fn with_parameters(cause: &TrueCause) -> String {
    let values =
        cause.parameters.iter().map(|(name, value)| format!("{name} {}", short_value(value)));
    format!("{} ({})", cause.words(), values.collect::<Vec<_>>().join(", "))
}

fn short_value(value: &diagnosis::Value) -> String {
    use diagnosis::Value;
    let number = |x: &f64| format!("{}", (x * 1e4).round() / 1e4);
    match value {
        Value::Number(x) => number(x),
        Value::Vector(values) => values.iter().map(number).collect::<Vec<_>>().join(" "),
    }
}

/// An answer in words: its verdict, or its causes with their confidence.
pub fn answer(answer: &Answer) -> String {
    let causes = answer.named().iter().map(|named| {
        format!("{} ({:.2})", cause::words(&named.effect, named.joint), named.confidence)
    });
    let causes = causes.collect::<Vec<_>>().join(", ");
    match answer {
        Answer::Failed(why) => format!("failed: {why}"),
        Answer::Report(_) if causes.is_empty() => answer.label().to_owned(),
        Answer::Report(_) => causes,
    }
}

/// A table under a heading; nothing where it has no rows.
pub(crate) fn table<const N: usize>(
    heading: &str,
    header: &[&str; N],
    rows: impl Iterator<Item = [String; N]>,
) -> String {
    let rows: Vec<[String; N]> = rows.collect();
    if rows.is_empty() {
        return String::new();
    }
    let cells = |row: &[String; N]| row.each_ref().map(|cell| cell.replace(['|', '\n'], " "));
    let rows: Vec<[String; N]> = rows.iter().map(cells).collect();
    let width = |k: usize| {
        let widths = rows.iter().map(|row| row[k].chars().count());
        widths.chain([header[k].chars().count()]).max().unwrap_or_default()
    };
    let line = |cells: &dyn Fn(usize) -> String| {
        let padded: Vec<String> =
            (0..N).map(|k| format!("{:width$}", cells(k), width = width(k))).collect();
        format!("| {} |\n", padded.join(" | "))
    };
    let mut text = format!("## {heading}\n\n");
    text += &line(&|k| header[k].to_owned());
    text += &line(&|k| "-".repeat(width(k)));
    for row in &rows {
        text += &line(&|k| row[k].clone());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_below_one_another() {
        let rows = [["a".to_owned(), "long cell".to_owned()], ["b|c".to_owned(), "x".to_owned()]];
        let text = table("Heading", &["first", "second"], rows.into_iter());
        let widths: Vec<usize> = text.lines().skip(2).map(str::len).collect();
        assert!(widths.windows(2).all(|pair| pair[0] == pair[1]), "{text}");
        assert!(text.contains("| b c "), "{text}");
    }

    #[test]
    fn a_table_without_rows_is_nothing() {
        assert_eq!(table("Heading", &["first"], std::iter::empty()), "");
    }
}
