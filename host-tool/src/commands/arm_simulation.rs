//! What is to be simulated of an arm of format 2.

use std::path::Path;

/// What is to be simulated.
#[derive(Clone, Copy, Debug)]
pub struct ArmSimulation<'a> {
    /// The arm's file.
    pub model: &'a Path,
    /// What to record.
    pub dataset: &'a str,
    /// Directory for dataset.toml and the logs.
    pub out: &'a Path,
    /// Effects that the model does not have.
    pub effects: &'a [String],
    /// Seed of all noises.
    pub seed: u32,
    /// An option that is for the three-joint robot and its board, if one was given.
    pub of_board: Option<&'a str>,
}
