//! Torque constants that are in doubt, in words.

use super::words::joint_words;
use crate::logs::subject::Subject;

/// Which torque constants are in doubt, by how much they were taken to be off, and what would tell them; none where none is.
pub fn words(subject: &Subject) -> Option<String> {
    let in_doubt = subject.in_doubt();
    let (definition, ..) = in_doubt.first()?;
    let of_joint = |(_, joint, values): &(_, u8, Vec<f64>)| {
        format!("{} by {:+.1} %", joint_words(subject.outer_joint(*joint)), 100.0 * values[0])
    };
    let joints: Vec<String> = in_doubt.iter().map(of_joint).collect();
    Some(format!(
        "torque constants are told against each other: all of them by one factor are all masses by that. Some are in doubt, and \
         were taken to be off by what is likeliest ({}), as in the amended model; to tell them, record {}, and diagnose with \
         the model as given",
        joints.join(", "),
        subject.experiment(definition)
    ))
}
