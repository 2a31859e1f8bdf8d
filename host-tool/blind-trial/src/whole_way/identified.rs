//! A robot's campaign, and the model that comes of it.

use std::path::Path;

use files::RobotFile;
use identification::procedure::{Identified, identify, model_file};
use model::Robot;
use recordings::{Campaign, Trace};
use rig::Recipe;

use crate::case::Case;
use crate::error::TrialError;
use crate::logs;

/// A model as `rrr identify` writes it.
#[derive(Clone, Debug)]
pub(super) struct IdentifiedModel {
    /// The model.
    pub robot: Robot<f64>,
    /// Its file, with standard errors.
    pub file: RobotFile,
    /// What it leaves of the command on the logs held out, rms, worst log of each joint [V].
    pub held_out_v: [f64; 3],
    /// What identification has to remark.
    pub remarks: Vec<String>,
}

/// Records the experiments of `rrr simulate --dataset campaign` and identifies the robot; the logs
/// are written where `keep` says.
///
/// # Errors
/// The board refuses its block, or the logs do not determine a model.
pub(super) fn identified(case: &Case, keep: Option<&Path>) -> Result<IdentifiedModel, TrialError> {
    let Some(recipe) = Recipe::by_name("campaign") else {
        return Err(TrialError::NoRecipe("campaign"));
    };
    let rig = case.rig();
    let counts = f64::from(rig.encoder_counts_per_turn);
    let recorded = case.record_plans(recipe.plans(&rig, case.seed % NOISE_SEEDS))?;
    let file = manufacturers_data(case);
    if let Some(directory) = keep {
        logs::write_recorded(&recorded, counts, directory)?;
        file.write(directory.join("robot.toml"))?;
    }
    let traces = recorded.into_iter().map(|r| Trace::of_log(r.log, r.plan.entry("csv"), counts));
    let campaign = Campaign::new(file.clone(), Some(counts), traces.collect())?;
    let found = identify(&campaign, &|_| ())?;
    found
        .robot
        .checked()
        .map_err(|error| TrialError::NoModel { case: case.number, what: error.to_string() })?;
    Ok(IdentifiedModel {
        robot: found.robot,
        file: model_file(&found, &file),
        held_out_v: held_out_v(&found),
        remarks: found.missing,
    })
}

/// The campaign's noises are numbered from three times a seed.
const NOISE_SEEDS: u32 = 1_000_000;

/// What a robot is sold with: lengths, torque constants, encoder, converter.
fn manufacturers_data(case: &Case) -> RobotFile {
    let rig = case.rig();
    let mut file = RobotFile::from_robot(&case.robot);
    file.base = None;
    file.friction.clear();
    file.robot.encoder_counts_per_rev = Some(f64::from(rig.encoder_counts_per_turn));
    file.robot.sample_period_s = Some(rig.sample_period_s);
    file.robot.command_limit_v = Some(rig.command_limit_v);
    file.robot.command_bits = Some(16);
    file
}

fn held_out_v(found: &Identified) -> [f64; 3] {
    let of_log = |worst: [f64; 3], log: &identification::procedure::HeldOutLog| {
        let residuals = log.residuals();
        [0, 1, 2].map(|i| residuals.get(i).map_or(worst[i], |r| worst[i].max(r.rms_v)))
    };
    found.held_out.iter().fold([0.0; 3], of_log)
}
