//! `rrr identify` on an arm of any kind.

use files::{ArmFile, ArmJoint, Dataset};
use identification::arm::{IdentifiedArm, LogLeft, Settings, identify};
use recordings::ArmCampaign;

use super::whole::Whole;
use crate::failure::Failure;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Steps;
use serde_json::json;

/// Runs the whole procedure.
///
/// # Errors
/// Files that cannot be used, or logs that do not determine a model.
pub fn run(arguments: &Whole, steps: &Steps) -> Result<(), Failure> {
    let arm = ArmFile::read(&arguments.robot)?;
    if servo::is_servo_arm(&arm) {
        return super::servos::run(arguments, arm, steps);
    }
    let dataset = Dataset::read(&arguments.dataset)?;
    let (campaign, notes) = ArmCampaign::read_with_notes(&dataset, arm)?;
    steps.at("fitting links, rotors and friction");
    let found = identify(&campaign, &Settings::default())?;
    let summary = arguments.beside("identification.json")?;
    found.model.write(&arguments.out)?;
    arguments.write_summary(&found)?;
    steps.finish();
    print_table(&found, &campaign.arm.joints);
    notes.iter().for_each(|note| say!("  note: {note}"));
    say!("\nModel: {}\nFigures: {}", arguments.out.display(), summary.display());
    answer(&json!({ "model": arguments.out, "summary": found }))
}

fn print_table(found: &IdentifiedArm, joints: &[ArmJoint]) {
    let which = if found.is_held_out { "held out" } else { "fitted to" };
    say!("What the model leaves of the command on the logs {which} (rms, part of the command):\n");
    for log in &found.left {
        say!("  {}", log.file);
        print_log(log, joints);
    }
    match found.condition_number {
        Some(number) => say!("\n  condition number {number:.0}"),
        None => say!("\n  the logs alone leave some base parameters open"),
    }
    for remark in &found.remarks {
        say!("  note: {remark}");
    }
}

fn print_log(log: &LogLeft, joints: &[ArmJoint]) {
    for (number, (left, joint)) in (1..).zip(log.joints.iter().zip(joints)) {
        let name = joint.name.as_deref().unwrap_or_default();
        match left {
            Some(left) => say!(
                "    joint {number} {name:16} {:10.4} {:2} ({:5.2} %)",
                left.rms,
                joint.command_unit(),
                100.0 * left.share
            ),
            None => say!("    joint {number} {name:16} stands"),
        }
    }
}
