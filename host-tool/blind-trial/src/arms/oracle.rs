//! What somebody could know of a case who knows the arm: the true arm is refitted to the logs without
//! and with what is hidden in it.

use diagnosis::Criteria;
use diagnosis::fit::fitted_model::FittedModel;
use diagnosis::fit::preparation::prepared;
use diagnosis::logs::subject::Subject;
use diagnosis::logs::usable::Usable;
use diagnosis::trial::hypothesis::Hypothesis;
use files::ArmFile;
use recordings::{ArmCampaign, Trace};
use rig::effects::{Catalogue, Search};
use servo::Settings;
use servo::prepared::Prepared;

use super::case::ArmCase;
use crate::error::TrialError;

/// Orders that are tried of a harmonic, each a hypothesis of its own.
const ORDERS: f64 = 24.0;

/// The probability that the true cause is named, 0 to 1, by one who chooses among all effects on all
/// joints; none where nothing is hidden, or where the logs cannot be fitted to.
pub fn oracle(case: &ArmCase, campaign: &ArmCampaign) -> Option<f64> {
    case.cause.as_ref()?;
    let gain = match case.arm.is_of_servos() {
        true => gain_of_servos(case, campaign),
        false => gain_of_commands(case, campaign),
    };
    let choice = hypotheses(case.truth.joints.len()).ln();
    Some(1.0 / (1.0 + (choice - gain.ok()??).exp()))
}

/// Log-likelihood that commands gain.
fn gain_of_commands(case: &ArmCase, campaign: &ArmCampaign) -> Result<Option<f64>, TrialError> {
    let (criteria, whole) = (Criteria::default(), case.whole_truth());
    let traces: Vec<Trace> = campaign.recordings.iter().map(|log| log.trace(&case.truth)).collect();
    let catalogue = Catalogue::of_arm(case.truth.joints.len());
    let subject = |arm: &ArmFile| Subject::of_arm(arm, &traces, &catalogue, &criteria);
    let (without, with) = (subject(&case.truth)?, subject(&whole)?);
    let fitted = |subject: &Subject| -> Result<FittedModel, TrialError> {
        let stretches = Usable::of(&traces, subject)?.stretches;
        Ok(prepared(subject, stretches, None)?.1)
    };
    let (poor, rich) = (fitted(&without)?, fitted(&with)?);
    // On the same rows, and from the same parameters: a fit that went further gains, too.
    let refitted = |subject: &Subject, start: Hypothesis| {
        let fitted = FittedModel::fitted(&poor.evidence, subject, start, criteria.fit.refit_steps)?;
        Some(fitted.settled(subject))
    };
    let start = rich.linear.hypothesis;
    let effects = poor.linear.hypothesis.effects.clone();
    let near = refitted(&without, Hypothesis { effects, ..start.clone() });
    let rich = refitted(&with, start);
    let poor = near.into_iter().fold(poor.clone(), FittedModel::better_of);
    Ok(rich.map(|rich| rich.gain_over(&poor)))
}

/// Log-likelihood that positions gain.
fn gain_of_servos(case: &ArmCase, campaign: &ArmCampaign) -> Result<Option<f64>, TrialError> {
    let settings = Settings::default();
    let fitted = |arm: ArmFile| Prepared::of(&ArmCampaign { arm, ..campaign.clone() }, &settings);
    let (poor, rich) = (fitted(case.truth.clone())?, fitted(case.whole_truth())?);
    let rows_in_one = (settings.correlation_s / poor.period_s).max(1.0);
    let joints = poor.bases.iter().zip(&rich.bases).map(|(poor, rich)| {
        let ([without, rows], [with, _]) = (mean(poor), mean(rich));
        0.5 * rows / rows_in_one * (without / with).ln()
    });
    Ok(Some(joints.sum()))
}

/// Mean square of what is left of a joint [rad^2], and of how many rows.
fn mean(base: &servo::base::Base) -> [f64; 2] {
    let (sum, rows) = base.fitted.squares();
    let rows = rows.max(1) as f64;
    [(sum / rows).max(f64::MIN_POSITIVE), rows]
}

/// Among how many one chooses.
fn hypotheses(joints: usize) -> f64 {
    let of = |definition: &rig::effects::Definition| {
        let places = if definition.whole_robot { 1.0 } else { joints as f64 };
        match definition.search {
            Search::Harmonics(_) => places * ORDERS,
            Search::From(_) => places,
        }
    };
    Catalogue::of_arm(joints).iter().map(of).sum()
}
