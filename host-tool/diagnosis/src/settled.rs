//! A search by what is known of an arm, and again by what its causes tell of that: by a wider doubt about the model, and
//! with friction that differs from log to log.

use crate::constants::{OpenConstants, open_constants};
use crate::criteria::Doubt;
use crate::fit::command_instants::by_instants;
use crate::fit::warmth::gains_by_warmth;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::search::found::KnownCauses;
use crate::searched::{Free, Searched};
use recordings::StepError;

/// What a search ends with that asks for nothing more.
pub struct Settled {
    /// What is known of the arm by then.
    pub subject: Subject,
    /// What was found.
    pub searched: Searched,
    /// By what part of a sample period commands act before their rows.
    pub early_part: f64,
    /// The doubt about the model, where it is wider than was given.
    pub doubt: Option<Doubt>,
}

/// Searches stretches of logs. Friction that differs from log to log is opened, too, where the model that a search ends with
/// gains by it: causes hide it before they are known. All is then sought anew, for a doubt about friction, or causes, may
/// have stood for it; and once more where torque constants were found that are told against each other only.
///
/// # Errors
/// Logs that leave no rows.
pub fn settled(
    subject: &Subject,
    stretches: &[Stretch],
    progress: &dyn Fn(&str),
) -> Result<Settled, StepError> {
    let found = warmth_open(subject, stretches, progress)?;
    Ok(constants_told(found, stretches, progress))
}

/// Searches with friction that differs from log to log open, where the model that a first search ends with gains by it.
fn warmth_open(
    subject: &Subject,
    stretches: &[Stretch],
    progress: &dyn Fn(&str),
) -> Result<Settled, StepError> {
    let found = by_likeliest_doubt(subject.clone(), stretches.to_vec(), progress)?;
    let Settled { subject: by_then, searched, .. } = &found;
    let is_open = subject.warms || searched.fault.is_some();
    if is_open || !gains_by_warmth(by_then, &searched.selection.last.by_all_rows()) {
        return Ok(found);
    }
    progress("opening friction in each log");
    let warming = Subject { warms: true, ..subject.clone() };
    Ok(by_likeliest_doubt(warming, stretches.to_vec(), progress).unwrap_or(found))
}

/// The same with how well torque constants are known that were found. Where one of them is not told, what is found by a search
/// with those in doubt where they are likeliest, unless that explains less.
fn constants_told(found: Settled, stretches: &[Stretch], progress: &dyn Fn(&str)) -> Settled {
    let last = found.searched.selection.last.by_all_rows();
    let Some(open) = open_constants(&found.subject, &last) else { return found };
    if open.ask_for_search {
        progress("searching beside torque constants that are in doubt");
        let least = -found.subject.criteria.prior.least_gain;
        let explains = |beside: &Settled| {
            beside.searched.selection.last.by_all_rows().gain_over(&last) > least
        };
        let beside = beside_constants(&found, &open, stretches, progress);
        if let Some(beside) = beside.filter(explains) {
            return beside;
        }
    }
    Settled { subject: open.told_to(found.subject), ..found }
}

/// A search by a model that has torque constants in doubt where they are likeliest; none where nothing can be fitted so.
fn beside_constants(
    found: &Settled,
    open: &OpenConstants,
    stretches: &[Stretch],
    progress: &dyn Fn(&str),
) -> Option<Settled> {
    let Settled { subject, searched, early_part, doubt } = found;
    let by_then = open.taken_for_known(subject);
    let known = open.left_out_of(subject, searched.selection.known(subject));
    let near = open.known_in(subject, &searched.selection.refitted.linear.hypothesis);
    let mut stretches = stretches.to_vec();
    if *early_part > 0.0 {
        stretches = by_instants(stretches, *early_part);
    }
    let searched = Searched::of(&by_then, stretches, Some(&near), known, false, progress).ok()?;
    Some(Settled { subject: by_then, searched, early_part: *early_part, doubt: *doubt })
}

/// Searches by the doubt given, and by a wider one where the causes found, or a search with free parameters, ask for it.
fn by_likeliest_doubt(
    mut subject: Subject,
    mut stretches: Vec<Stretch>,
    progress: &dyn Fn(&str),
) -> Result<Settled, StepError> {
    let suspected = KnownCauses::suspected_of(&subject);
    let first = Searched::of(&subject, stretches.clone(), None, suspected, true, progress)?;
    let mut early_part = first.early_part;
    if early_part > 0.0 {
        stretches = by_instants(stretches, early_part);
    }
    let mut wider = None;
    let searched = match first.with_free_parameters(&subject, &stretches, progress) {
        Some(Free::Doubt(doubt, known)) => {
            wider = Some(doubt);
            subject.doubt(doubt);
            let near = Some(&first.selection.refitted.linear.hypothesis);
            let known = known.behind_suspected(&subject);
            Searched::of(&subject, stretches, near, known, early_part == 0.0, progress)?
        }
        Some(Free::Causes(found)) => *found,
        None => first,
    };
    early_part = early_part.max(searched.early_part);
    Ok(Settled { subject, searched, early_part, doubt: wider })
}
