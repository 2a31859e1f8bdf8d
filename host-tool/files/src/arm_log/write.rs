//! Logs of arms to comma-separated numbers.

use std::io::Write;
use std::path::Path;

use super::ArmLog;
use super::columns::Columns;
use crate::arm_file::{ArmFile, ArmJoint};
use crate::error::{FileError, Problem};
use crate::replace::replace_file;

impl ArmLog {
    /// Writes times, positions and commands as `.csv`, whole or not at all; positions in counts where
    /// the arm's file tells of an encoder.
    ///
    /// # Errors
    /// The path cannot be written.
    pub fn write(&self, path: impl AsRef<Path>, arm: &ArmFile) -> Result<(), FileError> {
        replace_file(path.as_ref(), |out| {
            out.write_all(self.text(arm).as_bytes()).map_err(Problem::Unwritable)
        })
    }

    fn text(&self, arm: &ArmFile) -> String {
        let columns = (1..).zip(&arm.joints).map(|(number, joint)| header(number, joint));
        let mut text = format!("t_s{}\n", columns.collect::<String>());
        for (k, time_s) in self.time_s.iter().enumerate() {
            text += &format!("{time_s:.6}");
            for (log, joint) in self.joints.iter().zip(&arm.joints) {
                text += &match joint.count_step() {
                    Some(step) => format!(",{}", (log.position[k] / step).round() as i64),
                    None => format!(",{}", log.position[k]),
                };
                text += &format!(",{:.7}", log.command[k]);
            }
            text.push('\n');
        }
        text
    }
}

fn header(number: usize, joint: &ArmJoint) -> String {
    let Columns { position, count, command, .. } = Columns::of(number, joint);
    format!(",{},{command}", if joint.count_step().is_some() { count } else { position })
}
