//! `report.html` of `rrr diagnose`: what the gap is, what causes it, and what is left.

mod commands;
mod figure;
mod maps;
mod over_axis;
mod spectra;
mod stages;
pub mod tables;
mod waterfall;

pub use figure::figure;

use super::{Chart, Page};
use diagnosis::sentence;
use diagnosis::{Diagnosis, Verdict};
use stages::Stages;
use tables::{CAUSES, cause_rows};

/// The page of a diagnosis.
pub fn diagnosis_page(diagnosis: &Diagnosis) -> Page {
    let report = &diagnosis.report;
    let stages = Stages::of(diagnosis);
    let mut page = Page::new("Where robot and model differ", &sentence(diagnosis));
    if !report.causes.is_empty() {
        page.words(&CAUSES, &cause_rows(diagnosis));
    }
    section(
        &mut page,
        "What is left of the command, step by step",
        waterfall::CAPTION,
        &[waterfall::waterfall(diagnosis).map_or_else(String::new, |bars| bars.to_svg())],
    );
    pictures(&mut page, diagnosis, &stages);
    tables::add(&mut page, diagnosis);
    page
}

/// The pictures, joint by joint; what is unknown begins with what is seen of it.
fn pictures(page: &mut Page, diagnosis: &Diagnosis, stages: &Stages) {
    let over_axes = drawn(&over_axis::charts(diagnosis, stages));
    let unknown = diagnosis.report.verdict == Verdict::Unknown;
    let (first, second) =
        if unknown { (&over_axes[..], &[][..]) } else { (&[][..], &over_axes[..]) };
    section(page, OVER_AXES, "", first);
    let sides = format!(
        "Left: {}; right: {}. The same colour is the same voltage; grey is where no log goes.",
        stages.names.0, stages.names.1
    );
    section(page, "What is left, over position and velocity", &sides, &maps::maps(stages));
    let spectra = drawn(&spectra::charts(stages));
    section(page, "What is left, by order per turn and by frequency", "", &spectra);
    section(page, OVER_AXES, "", second);
    section(page, "Command", "", &drawn(&commands::charts(diagnosis, stages)));
}

const OVER_AXES: &str = "What is left, over what it varies with most";

fn drawn(charts: &[Chart]) -> Vec<String> {
    charts.iter().map(Chart::to_svg).collect()
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
