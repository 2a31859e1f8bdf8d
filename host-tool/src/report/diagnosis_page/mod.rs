//! `report.html` of `rrr diagnose`: what the gap is, what causes it, and what is left.

use super::Page;
use crate::diagnosis::{Diagnosis, sentence};

/// The page of a diagnosis.
pub fn diagnosis_page(diagnosis: &Diagnosis) -> Page {
    Page::new("Where robot and model differ", &sentence(diagnosis))
}
