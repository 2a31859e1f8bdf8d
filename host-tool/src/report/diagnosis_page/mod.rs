//! `report.html` of `rrr diagnose`: what the gap is, what causes it, and what is left.

mod commands;
mod maps;
mod over_axis;
mod spectra;
mod stages;
pub mod tables;
#[cfg(test)]
mod tests;
mod waterfall;

use super::Page;
use crate::diagnosis::{Diagnosis, Verdict, sentence};
use stages::Stages;
use tables::{CAUSES, cause_rows};

/// The page of a diagnosis.
pub fn diagnosis_page(diagnosis: &Diagnosis) -> Page {
    let report = &diagnosis.report;
    let stages = Stages::of(diagnosis);
    let mut page = Page::new("Where robot and model differ", &sentence(diagnosis));
    if !report.causes.is_empty() {
        page.words(&CAUSES, &cause_rows(&report.causes));
    }
    page.heading("What is left of the command, step by step");
    page.paragraph(waterfall::CAPTION);
    page.pictures(&[waterfall::waterfall(diagnosis).to_svg()]);
    pictures(&mut page, diagnosis, &stages);
    tables::add(&mut page, diagnosis);
    page
}

/// The pictures, joint by joint; what is unknown begins with what is seen of it.
fn pictures(page: &mut Page, diagnosis: &Diagnosis, stages: &Stages) {
    let over_axes = over_axis::charts(diagnosis, stages);
    if diagnosis.report.verdict == Verdict::Unknown {
        page.heading("What is left, over what it varies with most").charts(&over_axes);
    }
    page.heading("What is left, over position and velocity");
    page.paragraph(&format!("{} on the left, {} on the right.", stages.names.0, stages.names.1));
    page.pictures(&maps::maps(stages));
    page.heading("What is left, by order per turn and by frequency");
    page.charts(&spectra::charts(stages));
    if diagnosis.report.verdict != Verdict::Unknown && !over_axes.is_empty() {
        page.heading("What is left, over what it varies with most").charts(&over_axes);
    }
    page.heading("Command").charts(&commands::charts(diagnosis, stages));
}
