//! The whole way from logs to a model.

use files::arm_file::ArmFriction;
use files::{FileError, Role};
use model::chain::SerialChain;
use model::mechanism::Mechanism;
use recordings::{ArmCampaign, ArmRecording};

use super::base::{base_parameters, condition_number};
use super::drives::torque_constants;
use super::error::ArmError;
use super::fit::Fit;
use super::fitted::{Fitted, likelier};
use super::judge::{LogLeft, judged};
use super::layout::Layout;
use super::logs::PreparedLog;
use super::model_file::model_file;
use super::motion::CommandTime;
use super::remarks::remarks;
use super::result::{Constant, IdentifiedArm, LogBand};
use super::rows::Equations;
use super::settings::Settings;
use super::unknowns::{COULOMB, OF_JOINT};

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
    let Fitted { time, moves, rows, found, .. } = likelier(arm, &logs, &equations, settings)?;
    let layout = Layout { joints: arm.joints.len() };
    let (basis, base) = base_parameters(&with_links(&chain, &found, layout), &found);
    let judged_on = if held_out.is_empty() { &logs } else { &held_out };
    let mut result = IdentifiedArm {
        model: model_file(arm, &found, &moves),
        command_time: time,
        left: left(judged_on, &equations, time, &found, settings),
        is_held_out: !held_out.is_empty(),
        condition_number: condition_number(&rows, &basis, layout, &moves),
        base,
        constants: constants_beside(&found),
        bands: logs.iter().map(band).collect(),
        remarks: Vec::new(),
    };
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

fn with_links(chain: &SerialChain<f64>, fit: &Fit, layout: Layout) -> SerialChain<f64> {
    let mut found = *chain;
    found.set_parameters(&fit.numbers()[..layout.links()]);
    found
}

fn left(
    logs: &[PreparedLog],
    equations: &Equations,
    time: CommandTime,
    fit: &Fit,
    settings: &Settings,
) -> Vec<LogLeft> {
    let layout = Layout { joints: equations.constants.len() };
    let numbers = fit.numbers();
    let of_log = |log: &PreparedLog| {
        judged(&log.file, &log.rows(equations, time, settings), &numbers, layout)
    };
    logs.iter().map(of_log).collect()
}

fn constants_beside(fit: &Fit) -> Vec<Constant> {
    let at = |index| OF_JOINT * index + COULOMB + 2;
    let of_joint = |index: usize| Constant {
        value: fit.values[at(index)],
        standard_error: fit.covariance[(at(index), at(index))].sqrt(),
    };
    (0..fit.unknowns.joints.len()).map(of_joint).collect()
}

fn band(log: &PreparedLog) -> LogBand {
    LogBand { file: log.file.clone(), cutoff_hz: log.band.second_hz }
}
