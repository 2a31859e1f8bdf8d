//! The whole way from logs to a model.

use files::arm_file::{ArmFriction, BaseError};
use files::{FileError, Role};
use recordings::{ArmCampaign, ArmRecording};

use super::base::{BaseParameter, base_parameters, condition_number};
use super::drives::torque_constants;
use super::error::ArmError;
use super::fit::Fit;
use super::fitted::{Fitted, likelier, with_links};
use super::friction_terms::{FrictionTerms, JointTerms, Term};
use super::judge::{LogLeft, judged};
use super::layout::Layout;
use super::logs::PreparedLog;
use super::model_file::model_file;
use super::motion::CommandTime;
use super::remarks::remarks;
use super::result::{Estimate, FoundTerms, IdentifiedArm, LogBand};
use super::rows::Equations;
use super::settings::Settings;

/// Identifies an arm from the `train` logs of a campaign and judges it on those held out.
///
/// # Errors
/// A drive that cannot be used, logs that are too short or without motion.
pub fn identify(campaign: &ArmCampaign, settings: &Settings) -> Result<IdentifiedArm, ArmError> {
    let arm = &campaign.arm;
    let constants = torque_constants(arm)?;
    let chain = arm.chain_of_what_is_known().map_err(numerical)?;
    let friction: Vec<ArmFriction> =
        arm.joints.iter().map(|joint| joint.friction.unwrap_or_default()).collect();
    let equations = Equations { chain: &chain, constants: &constants, friction: &friction };
    let logs = prepared(campaign, Role::Train, settings)?;
    let held_out = prepared(campaign, Role::Holdout, settings)?;
    if logs.is_empty() {
        return Err(ArmError::NoLog);
    }
    let Fitted { time, moves, terms, rows, found, .. } = likelier(arm, &logs, equations, settings)?;
    let (basis, base) = base_parameters(&with_links(&chain, &found), &found);
    let judged_on = if held_out.is_empty() { &logs } else { &held_out };
    let mut result = IdentifiedArm {
        model: model_file(arm, &found, &moves, &terms),
        command_time: time,
        left: left(judged_on, &equations, time, &terms, &found, settings),
        is_held_out: !held_out.is_empty(),
        condition_number: condition_number(&rows, &basis, &found, &moves),
        base,
        friction_terms: friction_terms(&found, &terms),
        bands: logs.iter().map(band).collect(),
        remarks: Vec::new(),
    };
    result.model.base_errors = base_errors(&result.base);
    result.remarks = remarks(arm, &found, &moves, &result);
    Ok(result)
}

fn numerical(error: FileError) -> ArmError {
    ArmError::Numerical(error.to_string())
}

fn prepared(
    campaign: &ArmCampaign,
    role: Role,
    settings: &Settings,
) -> Result<Vec<PreparedLog>, ArmError> {
    let of = |recording: &ArmRecording| PreparedLog::of(recording, &campaign.arm.joints, settings);
    campaign.of_role(role).map(of).collect()
}

fn left(
    logs: &[PreparedLog],
    equations: &Equations,
    time: CommandTime,
    terms: &FrictionTerms,
    fit: &Fit,
    settings: &Settings,
) -> Vec<LogLeft> {
    let layout = Layout { joints: equations.constants.len() };
    let numbers = fit.numbers();
    let of_log = |log: &PreparedLog| {
        let stretches = log.rows(equations, time, settings);
        let rows: Vec<_> = stretches.iter().flat_map(|stretch| stretch.with(terms)).collect();
        judged(&log.file, &rows, &numbers, layout)
    };
    logs.iter().map(of_log).collect()
}

fn base_errors(base: &[BaseParameter]) -> Vec<BaseError> {
    let of = |base: &BaseParameter| BaseError {
        name: base.name.clone(),
        standard_error: base.standard_error,
    };
    base.iter().map(of).collect()
}

fn friction_terms(fit: &Fit, terms: &FrictionTerms) -> Vec<FoundTerms> {
    let of_joint = |(joint, terms): (usize, &JointTerms)| {
        let found = |term: Term| terms.open[term as usize].then(|| own(fit, joint, term.number()));
        let [stribeck_peak, load_friction, quadratic_drag, constant] = Term::ALL.map(found);
        let stribeck_velocity = stribeck_peak.map(|_| terms.stribeck_velocity);
        FoundTerms { stribeck_peak, stribeck_velocity, load_friction, quadratic_drag, constant }
    };
    terms.joints.iter().enumerate().map(of_joint).collect()
}

/// One of a joint's own numbers.
fn own(fit: &Fit, joint: usize, which: usize) -> Estimate {
    let [value, standard_error] = fit.own(joint, which);
    Estimate { value, standard_error }
}

fn band(log: &PreparedLog) -> LogBand {
    LogBand { file: log.file.clone(), cutoff_hz: log.band.second_hz }
}
