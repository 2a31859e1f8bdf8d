//! `rrr simulate` of an arm of any kind: under a PD loop, in this process.

use files::{ArmFile, Dataset, Entry};
use rig::Plant;
use rig::effects::{Catalogue, Effect};
use servo::is_servo_arm;
use simulation::arm_recording::{ArmPlan, gap_plans};
use simulation::record_arm;

use super::arm_simulation::ArmSimulation;
use super::simulate_servos;
use crate::failure::Failure;
use crate::options::effects;
use crate::output_files::create_directory;
use crate::say;
use crate::terminal::answer::answer;
use serde_json::json;

/// The only data set of an arm.
const DATASET: &str = "gap";
/// Rate of an arm whose file tells none [Hz].
const USUAL_HZ: f64 = 500.0;

/// Runs the command.
///
/// # Errors
/// An unknown name, a model that cannot be used, or a directory that cannot be written.
pub fn run(arguments: &ArmSimulation) -> Result<(), Failure> {
    refuse_what_boards_take(arguments)?;
    let arm = ArmFile::read(arguments.model)?;
    if is_servo_arm(&arm) {
        return simulate_servos::run(arguments, &arm);
    }
    let plant = Plant::of_arm(&arm)?;
    all_effects(arguments, &arm)?;
    let rate_hz = arm.sample_period_s.map_or(USUAL_HZ, |period_s| 1.0 / period_s);
    let plans = gap_plans(rate_hz, u64::from(arguments.seed));
    let names: Vec<String> = plans.iter().map(file_name).collect();
    Dataset::check_room(arguments.out, &names)?;
    create_directory(arguments.out)?;
    let mut entries = Vec::new();
    for plan in &plans {
        let log = record_arm(&arm, &plant, all_effects(arguments, &arm)?, &plan.motion);
        log.write(arguments.out.join(file_name(plan)), &arm)?;
        let (experiment, role) = (plan.experiment, plan.role);
        entries.push(Entry { file: file_name(plan), experiment, role, joint: None });
    }
    let directory = arguments.out.to_owned();
    let dataset = Dataset { directory, encoder_counts_per_rev: None, entries };
    dataset.write_simulated(arguments.out)?;
    say!("{} logs in {}", plans.len(), arguments.out.display());
    answer(&json!({ "dataset": arguments.out, "logs": names }))
}

fn file_name(plan: &ArmPlan) -> String {
    format!("{}.csv", plan.name)
}

/// The effects of the model file and those of the command line.
fn all_effects(arguments: &ArmSimulation, arm: &ArmFile) -> Result<Vec<Box<dyn Effect>>, Failure> {
    let catalogue = Catalogue::of_arm(arm.joints.len());
    let mut all = effects::of_file_in(&catalogue, &arm.effects, arguments.model)?;
    all.extend(effects::of_options_in(&catalogue, arguments.effects)?);
    Ok(all)
}

/// What only the board of the three-joint robot can do.
fn refuse_what_boards_take(arguments: &ArmSimulation) -> Result<(), Failure> {
    if arguments.dataset != DATASET {
        let message = format!("--dataset {}: no data set of an arm of format 2", arguments.dataset);
        return Err(Failure::new(message, format!("take --dataset {DATASET}")));
    }
    match arguments.of_board {
        None => Ok(()),
        Some(name) => {
            let message = format!("{name} is for the robot of three joints and its board");
            Err(Failure::new(
                message,
                "leave it out: an arm of format 2 is simulated without a board",
            ))
        }
    }
}
