//! The recorded motions of an arm of any kind.

use files::arm_log::ArmJointLog;
use files::mapping::told;
use files::{ArmFile, ArmJoint, ArmLog, Dataset, Experiment, FileError, Role};

use crate::campaign::{JointTrace, Trace};
use crate::smoothed::typical_period_s;

/// An arm and its logs.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmCampaign {
    /// What is known of the arm.
    pub arm: ArmFile,
    /// The logs, in the order of `dataset.toml`.
    pub recordings: Vec<ArmRecording>,
}

impl ArmRecording {
    /// As a trace: positions as angles, commands as voltages, whatever their units; commands end at
    /// the drives' limits, which is all that drives pass on.
    pub fn trace(&self, arm: &ArmFile) -> Trace {
        let joints = (1..).zip(self.log.joints.iter().zip(&arm.joints));
        let of_joint = |(number, (log, joint)): (u8, (&ArmJointLog, &ArmJoint))| JointTrace {
            number,
            q_rad: log.position.clone(),
            command_v: limited(&log.command, joint),
            reference_rad: log.reference.clone(),
        };
        Trace {
            file: self.file.clone(),
            experiment: Experiment::Task,
            role: self.role,
            joint: None,
            period_s: typical_period_s(&self.log.time_s),
            time_s: self.log.time_s.clone(),
            joints: joints.map(of_joint).collect(),
        }
    }
}

fn limited(command: &[f64], joint: &ArmJoint) -> Vec<f64> {
    let limit = joint.drive.as_ref().and_then(|drive| drive.limit).unwrap_or(f64::INFINITY);
    command.iter().map(|u| u.clamp(-limit, limit)).collect()
}

/// A log with its place in the data set.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmRecording {
    /// File name, for messages.
    pub file: String,
    /// What the log is for.
    pub role: Role,
    /// The log, in the units of joints and drives.
    pub log: ArmLog,
}

impl ArmCampaign {
    /// Reads all logs of a data set.
    ///
    /// # Errors
    /// The first log in the list's order that cannot be used; names file, line and column.
    pub fn read(dataset: &Dataset, arm: ArmFile) -> Result<Self, FileError> {
        Ok(Self::read_with_notes(dataset, arm)?.0)
    }

    /// The same, with what was done to logs of foreign files that their user should know.
    ///
    /// # Errors
    /// As of [`ArmCampaign::read`].
    pub fn read_with_notes(
        dataset: &Dataset,
        arm: ArmFile,
    ) -> Result<(Self, Vec<String>), FileError> {
        let (mut recordings, mut notes) = (Vec::new(), Vec::new());
        let mapping = dataset.mapping()?;
        for (place, entry) in dataset.entries.iter().enumerate() {
            let view = mapping.view(place);
            let (log, of_log) = ArmLog::read_mapped(&dataset.directory, &entry.file, &view, &arm)?;
            let file = view.label(&entry.file);
            notes.push((file.clone(), of_log));
            recordings.push(ArmRecording { file, role: entry.role, log });
        }
        let of_logs = notes.iter().map(|(file, notes)| (file.as_str(), notes.as_slice()));
        Ok((Self { arm, recordings }, told(of_logs)))
    }

    /// The logs of a role.
    pub fn of_role(&self, role: Role) -> impl Iterator<Item = &ArmRecording> {
        self.recordings.iter().filter(move |recording| recording.role == role)
    }
}
