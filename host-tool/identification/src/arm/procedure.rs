//! The whole way from logs to a model.

use files::arm_file::ArmFriction;
use files::{ArmFile, FileError, Role};
use model::chain::SerialChain;
use model::mechanism::Mechanism;
use nalgebra::DMatrix;
use recordings::{ArmCampaign, ArmRecording};

use super::base::{base_parameters, condition_number};
use super::condensed::Condensed;
use super::drives::torque_constants;
use super::error::ArmError;
use super::fit::{Fit, fit};
use super::judge::{LogLeft, judged};
use super::layout::Layout;
use super::logs::PreparedLog;
use super::model_file::model_file;
use super::motion::CommandTime;
use super::remarks::remarks;
use super::result::{Constant, IdentifiedArm, LogBand};
use super::rows::{Equations, JointRows};
use super::settings::Settings;
use super::unknowns::{COULOMB, OF_JOINT, Unknowns};
use super::weights::{Weighting, weighting};

/// The rows of the logs fitted to, with their weights.
struct Regression {
    time: CommandTime,
    condensed: Condensed,
    weighting: Weighting,
    counts: Vec<usize>,
}

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
    let [held, sampled] = [CommandTime::Held, CommandTime::Sampled]
        .map(|time| Fitted::of(arm, &logs, &equations, time, settings));
    let Fitted { regression, moves, rows, found } =
        better_of_both(held?, sampled?, &logs, &equations, settings);
    let layout = Layout { joints: arm.joints.len() };
    let (basis, base) = base_parameters(&with_links(&chain, &found, layout), &found);
    let judged_on = if held_out.is_empty() { &logs } else { &held_out };
    let mut result = IdentifiedArm {
        model: model_file(arm, &found, &moves),
        command_time: regression.time,
        left: left(judged_on, &equations, regression.time, &found, settings),
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

/// What is found where commands act at a given time.
struct Fitted {
    regression: Regression,
    moves: Vec<bool>,
    rows: DMatrix<f64>,
    found: Fit,
}

impl Fitted {
    fn of(
        arm: &ArmFile,
        logs: &[PreparedLog],
        equations: &Equations,
        time: CommandTime,
        settings: &Settings,
    ) -> Result<Self, ArmError> {
        let regression = regression(logs, equations, time, settings);
        let moves: Vec<bool> =
            regression.counts.iter().map(|count| *count >= settings.fewest_rows).collect();
        if !moves.contains(&true) {
            return Err(ArmError::NoMotion);
        }
        let rows = regression.condensed.weighted(&regression.weighting.weights);
        let found = fit(&rows, Unknowns::of(arm, &scales(logs), settings), settings)?;
        Ok(Self { regression, moves, rows, found })
    }

    /// Mean logarithm of what is left of each joint's command in each log.
    fn misfit(&self, logs: &[PreparedLog], equations: &Equations, settings: &Settings) -> f64 {
        let left = left(logs, equations, self.regression.time, &self.found, settings);
        let logarithms: Vec<f64> = (left.iter().flat_map(|log| &log.joints).flatten())
            .map(|joint| joint.share.max(f64::MIN_POSITIVE).ln())
            .collect();
        logarithms.iter().sum::<f64>() / logarithms.len().max(1) as f64
    }
}

/// Commands held or sampled, whichever leaves less by what is known of the arm: parameters that are free make up for
/// commands at the wrong time, the more so where friction leads velocity.
fn better_of_both(
    held: Fitted,
    sampled: Fitted,
    logs: &[PreparedLog],
    equations: &Equations,
    settings: &Settings,
) -> Fitted {
    let misfit = |fitted: &Fitted| fitted.misfit(logs, equations, settings);
    if misfit(&sampled) < misfit(&held) { sampled } else { held }
}

fn regression(
    logs: &[PreparedLog],
    equations: &Equations,
    time: CommandTime,
    settings: &Settings,
) -> Regression {
    let layout = Layout { joints: equations.constants.len() };
    let rows: Vec<JointRows> =
        logs.iter().flat_map(|log| log.rows(equations, time, settings)).collect();
    let condensed = Condensed::of(&rows, layout);
    let weighting = weighting(&rows, &condensed, layout, settings);
    let count = |joint| {
        let of_joint = rows.iter().filter(|rows| rows.joint == joint);
        of_joint.map(|rows| rows.command.len()).sum()
    };
    Regression { time, condensed, weighting, counts: (0..layout.joints).map(count).collect() }
}

fn scales(logs: &[PreparedLog]) -> Vec<[f64; 2]> {
    let larger = |a: Vec<[f64; 2]>, b: Vec<[f64; 2]>| {
        a.iter().zip(&b).map(|(a, b)| [a[0].max(b[0]), a[1].max(b[1])]).collect()
    };
    logs.iter().map(PreparedLog::scales).reduce(larger).unwrap_or_default()
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
