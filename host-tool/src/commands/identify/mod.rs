//! `rrr identify`: the model of an unknown robot from its recorded experiments.

mod arm;
mod found;
mod servos;
mod steps;
mod whole;

use clap::Args;

pub use found::{Found, found};
pub use steps::Step;
pub use whole::Whole;

use crate::failure::Failure;
use crate::provenance::provenance;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Steps;
use files::{ArmFile, Dataset, RobotFile};
use identification::procedure::{self, Identified, model_file};
use recordings::Campaign;
use report::identification_page::identification_page;
use report::identification_summary::Summary;
use report::one_joint_page::{one_joint_page, one_joint_rows};
use serde_json::json;

/// Arguments of `rrr identify`: those of the whole procedure, or a step.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
    /// One step alone.
    #[command(subcommand)]
    pub step: Option<Step>,
    /// The whole procedure.
    #[command(flatten)]
    pub whole: Option<Whole>,
}

/// Runs the command.
///
/// # Errors
/// Files that cannot be used, or experiments that do not determine a model.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    match (&arguments.step, &arguments.whole) {
        (Some(step), _) => step.run(),
        (None, Some(whole)) => run_whole(whole),
        (None, None) => Err(Failure::new("no data set is named", "see `rrr identify --help`")),
    }
}

/// Runs the whole procedure.
///
/// # Errors
/// Files that cannot be used, or experiments that do not determine a model.
pub fn run_whole(arguments: &Whole) -> Result<(), Failure> {
    let steps = Steps::new();
    steps.at("reading the logs");
    if ArmFile::is_at(&arguments.robot) {
        return arm::run(arguments, &steps);
    }
    let robot_file = RobotFile::read(&arguments.robot)?;
    let campaign = Campaign::read(&Dataset::read(&arguments.dataset)?, robot_file)?;
    if campaign.known.joints.len() == 1 {
        return of_one_joint(arguments, &campaign, &steps);
    }
    let identified = procedure::identify(&campaign, &|step| steps.at(step))?;
    steps.at("writing the report");
    let page = arguments.beside("identification.html")?;
    let out = arguments.model_path(is_possible(&identified));
    model_file(&identified, &campaign.robot_file).write(&out)?;
    let summary = Summary::of(&identified);
    arguments.write_summary(&summary)?;
    let mut html = identification_page(&campaign, &identified);
    html.provenance(&provenance(&arguments.robot, &arguments.dataset)).write(&page)?;
    steps.finish();
    print_table(&identified);
    campaign.notes.iter().for_each(|note| say!("  note: {note}"));
    say!("\nModel: {}\nFigures: {}", out.display(), page.display());
    answer(&json!({ "model": out, "possible": out == arguments.out, "summary": summary }))?;
    arguments.passed(&out, &identified.missing)
}

/// Whether a robot can have the parameters.
fn is_possible(identified: &Identified) -> bool {
    identified.robot.checked().is_ok()
}

/// The same on a rig of one joint.
fn of_one_joint(arguments: &Whole, campaign: &Campaign, steps: &Steps) -> Result<(), Failure> {
    let identified = procedure::identify_one_joint(campaign, &|step| steps.at(step))?;
    let page = arguments.beside("identification.html")?;
    identified.model_file(&campaign.robot_file).write(&arguments.out)?;
    arguments.write_summary(&identified.motion)?;
    let mut html = one_joint_page(&identified);
    html.provenance(&provenance(&arguments.robot, &arguments.dataset)).write(&page)?;
    steps.finish();
    for row in one_joint_rows(&identified) {
        say!("  {:28} {:>26}", row[0], row[1]);
    }
    for remark in &identified.missing {
        say!("  note: {remark}");
    }
    say!("\nModel: {}\nFigures: {}", arguments.out.display(), page.display());
    answer(&json!({ "model": arguments.out, "summary": identified.motion }))
}

fn print_table(identified: &Identified) {
    say!("What the model leaves of the command on the logs held out:\n");
    say!("  log                          joint 1            joint 2            joint 3");
    for held in &identified.held_out {
        let shares: Vec<String> = held
            .residuals()
            .iter()
            .map(|r| format!("{:5.1} mV ({:4.2} %)", 1e3 * r.rms_v, 100.0 * r.share))
            .collect();
        say!("  {:26} {}", held.file, shares.join("  "));
    }
    say!("");
    for law in &identified.laws {
        say!("  {}", law.sentence());
    }
    for remark in &identified.missing {
        say!("  note: {remark}");
    }
}
