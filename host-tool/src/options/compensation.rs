//! What the board compensates for, of the effects that a model file holds.

use std::path::Path;

use crate::failure::Failure;
use crate::terminal::output::print_line;
use files::RobotFile;
use rig::Rig;
use rig::compensation::Compensations;
use rig::effects::{Catalogue, EffectError};

/// The rig with compensations of the effects in `file`, which was read from `path`; prints what
/// becomes of its tables, and what cannot be compensated.
///
/// # Errors
/// A table that is no effect of the catalogue.
pub fn compensated(rig: Rig, file: &RobotFile, path: &Path) -> Result<Rig, Failure> {
    let (compensations, left_out) = Compensations::of(&file.effects, &Catalogue::standard())
        .map_err(|error| bad_effect(path, &error))?;
    compensations.tables.iter().try_for_each(print_line)?;
    left_out.iter().try_for_each(print_line)?;
    Ok(rig.with_compensations(compensations))
}

/// The failure for an `[[effect]]` table of a model file that cannot be used.
pub fn bad_effect(path: &Path, error: &EffectError) -> Failure {
    let message = format!("{}: [[effect]]: {error}", path.display());
    Failure::new(message, "correct the table; docs/effects.md lists the catalogue")
}
