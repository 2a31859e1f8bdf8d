//! `rrr identify` on an arm of position servos: rotors, friction, gravity's scale, timing.

use files::{ArmFile, Dataset};
use recordings::ArmCampaign;
use servo::{Identified, Settings};

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
pub fn run(arguments: &Whole, arm: ArmFile, steps: &Steps) -> Result<(), Failure> {
    let dataset = Dataset::read(&arguments.dataset)?;
    let (campaign, notes) = ArmCampaign::read_with_notes(&dataset, arm)?;
    steps.at("simulating from the goals, refitting joint by joint");
    let found = Identified::of(&campaign, &Settings::default())?;
    let summary = arguments.beside("identification.json")?;
    found.model.write(&arguments.out)?;
    arguments.write_summary(&found.summary)?;
    steps.finish();
    say!("What the model leaves of positions, simulated from the goals (rms, mrad):\n");
    for joint in &found.summary.joints {
        say!(
            "  joint {}  as given {:7.2}  refitted {:7.2}",
            joint.joint,
            1e3 * joint.as_given_rad,
            1e3 * joint.refitted_rad
        );
    }
    for remark in &found.summary.remarks {
        say!("  note: {remark}");
    }
    notes.iter().for_each(|note| say!("  note: {note}"));
    say!("\nModel: {}\nFigures: {}", arguments.out.display(), summary.display());
    answer(&json!({ "model": arguments.out, "summary": found.summary }))
}
