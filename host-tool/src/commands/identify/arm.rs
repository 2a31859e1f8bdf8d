//! `rrr identify` on an arm of any kind.

use files::{ArmFile, ArmJoint, Dataset};
use identification::arm::{IdentifiedArm, LogLeft, Settings, identify};
use recordings::ArmCampaign;

use super::whole::Whole;
use crate::failure::Failure;
use crate::terminal::progress::Steps;

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
    notes.iter().for_each(|note| println!("  note: {note}"));
    println!("\nModel: {}\nFigures: {}", arguments.out.display(), summary.display());
    Ok(())
}

fn print_table(found: &IdentifiedArm, joints: &[ArmJoint]) {
    let which = if found.is_held_out { "held out" } else { "fitted to" };
    println!(
        "What the model leaves of the command on the logs {which} (rms, part of the command):\n"
    );
    for log in &found.left {
        println!("  {}", log.file);
        print_log(log, joints);
    }
    match found.condition_number {
        Some(number) => println!("\n  condition number {number:.0}"),
        None => println!("\n  the logs alone leave some base parameters open"),
    }
    for remark in &found.remarks {
        println!("  note: {remark}");
    }
}

fn print_log(log: &LogLeft, joints: &[ArmJoint]) {
    for (number, (left, joint)) in (1..).zip(log.joints.iter().zip(joints)) {
        let name = joint.name.as_deref().unwrap_or_default();
        match left {
            Some(left) => println!(
                "    joint {number} {name:16} {:10.4} {:2} ({:5.2} %)",
                left.rms,
                joint.command_unit(),
                100.0 * left.share
            ),
            None => println!("    joint {number} {name:16} stands"),
        }
    }
}
