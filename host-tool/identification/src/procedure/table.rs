//! The model file that the procedure writes.

use super::Identified;
use crate::Estimate;
use files::RobotFile;

/// The robot file with the identified model and its standard errors.
pub fn model_file(identified: &Identified, robot_file: &RobotFile) -> RobotFile {
    let robot = &identified.robot;
    let mut file = robot_file.clone().with_model(robot.base, &robot.friction);
    let refined = &identified.refined;
    file.base_extra.insert("standard_error".into(), errors(&refined.base_estimates).into());
    for (table, estimates) in file.friction.iter_mut().zip(&refined.friction_estimates) {
        table.extra.insert("standard_error".into(), errors(estimates).into());
    }
    file
}

fn errors(estimates: &[(&'static str, Estimate)]) -> toml::Table {
    let entry = |(name, estimate): &(&str, Estimate)| {
        ((*name).to_owned(), toml::Value::Float(estimate.standard_error))
    };
    estimates.iter().map(entry).collect()
}
