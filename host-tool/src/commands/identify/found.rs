//! The whole procedure for those who go on with the model, on a robot of any kind.

use std::path::Path;

use diagnosis::ModelFile;
use files::{ArmFile, Dataset, RobotFile};
use identification::procedure::{self, model_file};
use recordings::{ArmCampaign, Campaign};

use crate::failure::Failure;

/// What the procedure found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The model.
    pub model: ModelFile,
    /// What else its user must know.
    pub remarks: Vec<String>,
}

/// Identifies the robot of a file by a data set; `progress` hears what is under way.
///
/// # Errors
/// Files that cannot be used, or experiments that do not determine a model.
pub fn found(dataset: &Path, robot: &Path, progress: &dyn Fn(&str)) -> Result<Found, Failure> {
    progress("reading the logs");
    if ArmFile::is_at(robot) {
        return of_arm(dataset, ArmFile::read(robot)?, progress);
    }
    let campaign = Campaign::read(&Dataset::read(dataset)?, RobotFile::read(robot)?)?;
    let (model, mut remarks) = match campaign.known.joints.len() {
        1 => {
            let found = procedure::identify_one_joint(&campaign, progress)?;
            (found.model_file(&campaign.robot_file), found.missing)
        }
        _ => {
            let found = procedure::identify(&campaign, progress)?;
            (model_file(&found, &campaign.robot_file), found.missing)
        }
    };
    remarks.extend(campaign.notes);
    Ok(Found { model: ModelFile::Robot(Box::new(model)), remarks })
}

/// The same on an arm of any kind.
fn of_arm(dataset: &Path, arm: ArmFile, progress: &dyn Fn(&str)) -> Result<Found, Failure> {
    let is_of_servos = servo::is_servo_arm(&arm);
    let (campaign, notes) = ArmCampaign::read_with_notes(&Dataset::read(dataset)?, arm)?;
    progress("fitting the arm");
    let (model, mut remarks) = if is_of_servos {
        let found = servo::Identified::of(&campaign, &servo::Settings::default())?;
        (found.model, found.summary.remarks)
    } else {
        let settings = identification::arm::Settings::default();
        let found = identification::arm::identify(&campaign, &settings)?;
        (found.model, found.remarks)
    };
    remarks.extend(notes);
    Ok(Found { model: ModelFile::Arm(Box::new(model)), remarks })
}
