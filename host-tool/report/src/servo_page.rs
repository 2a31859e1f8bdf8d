//! `report.html` of an arm of position servos: motion as it was and as models make it.

use diagnosis::report::words::{effect_words, joint_words};
use diagnosis::{Alternative, ParameterChange, Report};
use servo::Outcome;
use servo::report_words::{cause_words, sentence};

use super::{Chart, Page, Series, Stroke};

/// The page of a diagnosis.
pub fn servo_page(outcome: &Outcome, report: &Report) -> Page {
    let mut page = Page::new("Where arm and model differ", &sentence(report));
    page.list(&report.causes.iter().map(cause_words).collect::<Vec<_>>());
    page.paragraph(
        "The arm is simulated from its recorded goals, without feedback, over whole logs; what counts \
         is the distance of measured and simulated positions on logs that chose nothing.",
    );
    page.table(
        &["Joint", "as given [mrad]", "refitted [mrad]", "with effects [mrad]", "encoder [mrad]"],
        &rows(report),
    );
    if let Some((joint, log)) = shown(outcome, report) {
        page.heading(&format!("The joint that gains most: joint {}", joint + 1));
        page.charts(&charts(outcome, joint, log));
    }
    page.heading("What the refit moved");
    page.table(&["Parameter", "given", "found", "share"], &changes(report));
    if !report.alternatives.is_empty() {
        page.heading("Not named").list(&alternatives(report));
    }
    page.heading("Where the gap lies");
    page.list(&report.gap_shares.iter().map(|place| place.detail.clone()).collect::<Vec<_>>());
    page.heading("Remarks").list(&report.remarks);
    page
}

fn rows(report: &Report) -> Vec<Vec<String>> {
    let gap = &report.gap;
    let mrad = |rad: &[f64], joint: usize| format!("{:.2}", 1e3 * rad[joint]);
    let all = [&gap.as_given_rad, &gap.refitted_rad, &gap.with_effects_rad, &gap.noise_floor_rad];
    let row = |joint: usize| {
        let figures = all.iter().map(|rad| mrad(rad, joint));
        [(joint + 1).to_string()].into_iter().chain(figures).collect()
    };
    (0..gap.refitted_rad.len()).map(row).collect()
}

fn changes(report: &Report) -> Vec<Vec<String>> {
    let row = |change: &ParameterChange| {
        let share = format!("{:.0} %", 100.0 * change.share);
        let number = |value: f64| format!("{value:.4}");
        vec![change.parameter.clone(), number(change.given), number(change.found), share]
    };
    report.parameters_changed.iter().map(row).collect()
}

fn alternatives(report: &Report) -> Vec<String> {
    let sentence = |other: &Alternative| {
        let (effect, joint) = (effect_words(&other.effect), joint_words(other.joint));
        let why = other.why.as_deref().unwrap_or_default();
        format!("{effect}, {joint}: {why}")
    };
    report.alternatives.iter().map(sentence).collect()
}

/// The joint that effects help most, and the confirming log on which they do; without effects the
/// joint that the refit helps most.
fn shown(outcome: &Outcome, report: &Report) -> Option<(usize, usize)> {
    let gap = &report.gap;
    let fall =
        |before: &[f64], after: &[f64], joint: usize| before[joint].powi(2) - after[joint].powi(2);
    let best = |before: &[f64], after: &[f64]| {
        let joints = 0..before.len();
        joints.max_by(|a, b| fall(before, after, *a).total_cmp(&fall(before, after, *b)))
    };
    let by_effects = best(&gap.refitted_rad, &gap.with_effects_rad)?;
    let joint = match fall(&gap.refitted_rad, &gap.with_effects_rad, by_effects) > 0.0 {
        true => by_effects,
        false => best(&gap.as_given_rad, &gap.refitted_rad)?,
    };
    let gain = |log: &usize| squares(outcome, joint, *log, 1) - squares(outcome, joint, *log, 2);
    let log = (0..outcome.motions.len()).max_by(|a, b| gain(a).total_cmp(&gain(b)))?;
    Some((joint, log))
}

/// Mean square of a stage on a confirming log [rad^2].
fn squares(outcome: &Outcome, joint: usize, log: usize, stage: usize) -> f64 {
    let motion = &outcome.motions[log];
    let measured = &outcome.prepared.logs[motion.log].record.joints[joint].position;
    let found = measured.iter().zip(&motion.stages[stage][joint]).map(|(q, s)| (q - s).powi(2));
    found.sum::<f64>() / measured.len() as f64
}

/// Position and error over the ten seconds in which effects help most.
fn charts(outcome: &Outcome, joint: usize, log: usize) -> Vec<Chart> {
    let motion = &outcome.motions[log];
    let record = &outcome.prepared.logs[motion.log].record;
    let (time, track) = (&record.time_s, &record.joints[joint]);
    let rows = window(outcome, joint, log);
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        rows.clone().map(|row| (time[row], values[row])).collect()
    };
    let errors = |stage: usize| -> Vec<(f64, f64)> {
        let of = |row| (time[row], 1e3 * (track.position[row] - motion.stages[stage][joint][row]));
        rows.clone().map(of).collect()
    };
    let names = ["as given", "refitted", "with effects"];
    let mut position = Chart::new(record.file.clone(), "time [s]", "position [rad]")
        .with(Series::line("goal", 3, points(&track.goal)).stroke(Stroke::Dashed))
        .with(Series::line("measured", 0, points(&track.position)).stroke(Stroke::Broad));
    let mut left = Chart::new("measured less simulated", "time [s]", "position [mrad]");
    for (stage, (name, colour)) in names.into_iter().zip([4, 1, 2]).enumerate() {
        let line = Series::line(name, colour, points(&motion.stages[stage][joint]));
        position = position.with(line);
        left = left.with(Series::line(name, colour, errors(stage)));
    }
    vec![position, left]
}

/// Rows of ten seconds in which the squares fall most from refitted to with effects.
fn window(outcome: &Outcome, joint: usize, log: usize) -> std::ops::Range<usize> {
    const SECONDS: f64 = 10.0;
    let motion = &outcome.motions[log];
    let record = &outcome.prepared.logs[motion.log].record;
    let measured = &record.joints[joint].position;
    let fall = |row: usize| {
        let square = |stage: usize| (measured[row] - motion.stages[stage][joint][row]).powi(2);
        square(1) - square(2)
    };
    let end = |from: usize| record.time_s.partition_point(|t| *t < record.time_s[from] + SECONDS);
    let starts = (0..record.len()).step_by(50).map(|from| from..end(from));
    let gain = |rows: &std::ops::Range<usize>| rows.clone().map(fall).sum::<f64>();
    starts.max_by(|a, b| gain(a).total_cmp(&gain(b))).unwrap_or(0..record.len())
}
