//! `rrr simulate` of an arm of position servos: from goals, in this process.

use files::{ArmFile, Dataset, EffectTable, Entry, Experiment};
use rig::effects::table_from_text;
use servo::simulated::{gap_recording, simulated};

use super::arm_simulation::ArmSimulation;
use crate::failure::Failure;
use crate::output_files::create_directory;
use crate::say;
use crate::terminal::answer::answer;
use serde_json::json;

/// Records the arm.
///
/// # Errors
/// Drives that are not known, effects that servos cannot have, or a directory that cannot be written.
pub fn run(arguments: &ArmSimulation, arm: &ArmFile) -> Result<(), Failure> {
    let texts = arguments.effects.iter();
    let hidden = texts.map(|text| table(text)).collect::<Result<Vec<EffectTable>, Failure>>()?;
    let campaign = simulated(arm, &hidden, &gap_recording(arm), u64::from(arguments.seed))?;
    let names: Vec<String> = campaign.recordings.iter().map(|log| log.file.clone()).collect();
    Dataset::check_room(arguments.out, &names)?;
    create_directory(arguments.out)?;
    let mut entries = Vec::new();
    for recording in campaign.recordings {
        recording.log.write(arguments.out.join(&recording.file), arm)?;
        let (experiment, role, file) = (Experiment::Task, recording.role, recording.file);
        entries.push(Entry { file, experiment, role, joint: None });
    }
    let (directory, count) = (arguments.out.to_owned(), entries.len());
    Dataset { directory, encoder_counts_per_rev: None, entries }.write_simulated(arguments.out)?;
    say!("{count} logs in {}", arguments.out.display());
    answer(&json!({ "dataset": arguments.out, "logs": names }))
}

fn table(text: &str) -> Result<EffectTable, Failure> {
    table_from_text(text).map_err(|error| {
        let hint = "write saturation:3:limit_V=1.5, say; docs/servo-arms.md lists those of servos";
        Failure::new(format!("--effect {text}: {error}"), hint)
    })
}
