//! `report.html` of `rrr diagnose`: what the gap is, what causes it, and what is left.

mod commands;
mod figure;
mod maps;
mod over_axis;
mod remainder;
mod shares;
mod spectra;
mod stages;
pub mod tables;
mod units;
mod waterfall;

pub use figure::figure;

use super::{Chart, Page};
use diagnosis::sentence;
use diagnosis::{DataParts, Diagnosis, Verdict};
use stages::Stages;
use tables::{CAUSES, PARAMETERS, REMAINDER, cause_rows, parameter_rows, remainder_rows};
use units::in_own_units;

/// The page of a diagnosis.
pub fn diagnosis_page(diagnosis: &Diagnosis) -> Page {
    let report = &diagnosis.report;
    let stages = Stages::of(diagnosis);
    let mut page = Page::new("Where robot and model differ", &sentence(diagnosis));
    if let Some(bars) = shares::causes(diagnosis) {
        page.paragraph(shares::CAPTION).pictures(&[bars.to_svg()]);
        page.words(&CAUSES, &cause_rows(diagnosis));
    }
    page.paragraph(&data_words(&report.data));
    section(
        &mut page,
        "What is left of the command, step by step",
        waterfall::CAPTION,
        &[waterfall::waterfall(diagnosis).map_or_else(String::new, |bars| bars.to_svg())],
    );
    remaining(&mut page, diagnosis);
    refit(&mut page, diagnosis);
    pictures(&mut page, diagnosis, &stages);
    tables::add(&mut page, diagnosis);
    page
}

/// What no cause explains, as curves and as a table.
fn remaining(page: &mut Page, diagnosis: &Diagnosis) {
    let entries = &diagnosis.report.remainder;
    if entries.is_empty() {
        return;
    }
    page.heading("What no cause explains").paragraph(remainder::CAPTION);
    page.pictures(&drawn(diagnosis, remainder::charts(entries)));
    page.words(&REMAINDER, &remainder_rows(diagnosis));
}

/// What the refit moved, as bars and as a table.
fn refit(page: &mut Page, diagnosis: &Diagnosis) {
    if let Some(bars) = shares::parameters(diagnosis) {
        page.heading("What the refit moved").paragraph(shares::REFIT_CAPTION);
        page.pictures(&[bars.to_svg()]).words(&PARAMETERS, &parameter_rows(diagnosis));
    }
}

/// Which logs served for what.
fn data_words(data: &DataParts) -> String {
    let files = |files: &[String]| if files.is_empty() { "none".into() } else { files.join(", ") };
    let fitted = files(&data.fit);
    let chosen = match data.select == data.fit {
        true => format!("Fitted to, and chosen by pieces left out of: {fitted}."),
        false => format!("Fitted to: {fitted}. Chosen by: {}.", files(&data.select)),
    };
    format!("{chosen} Confirmed on: {}.", files(&data.confirm))
}

/// The pictures, joint by joint; what is unknown begins with what is seen of it.
fn pictures(page: &mut Page, diagnosis: &Diagnosis, stages: &Stages) {
    let over_axes = drawn(diagnosis, over_axis::charts(diagnosis, stages));
    let unknown = diagnosis.report.verdict == Verdict::Unknown;
    let (first, second) =
        if unknown { (&over_axes[..], &[][..]) } else { (&[][..], &over_axes[..]) };
    section(page, OVER_AXES, "", first);
    let sides = format!(
        "Left: {}; right: {}. The same colour is the same value; grey is where no log goes.",
        stages.names.0, stages.names.1
    );
    section(
        page,
        "What is left, over position and velocity",
        &sides,
        &maps::maps(diagnosis, stages),
    );
    let spectra = drawn(diagnosis, spectra::charts(stages));
    section(page, "What is left, by order per turn and by frequency", "", &spectra);
    section(page, OVER_AXES, "", second);
    section(page, "Command", "", &drawn(diagnosis, commands::charts(diagnosis, stages)));
}

const OVER_AXES: &str = "What is left, over what it varies with most";

fn drawn(diagnosis: &Diagnosis, charts: Vec<Chart>) -> Vec<String> {
    charts.into_iter().map(|chart| in_own_units(diagnosis, chart).to_svg()).collect()
}

/// A heading, a sentence and pictures; nothing where there are no pictures.
fn section(page: &mut Page, heading: &str, sentence: &str, pictures: &[String]) {
    if pictures.iter().all(String::is_empty) {
        return;
    }
    page.heading(heading);
    if !sentence.is_empty() {
        page.paragraph(sentence);
    }
    page.pictures(pictures);
}
