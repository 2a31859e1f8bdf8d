//! What else a reader must know.

use diagnosis::Untestable;

use crate::outcome::Outcome;
use crate::prepared::Prepared;

/// Sentences.
pub fn remarks(outcome: &Outcome) -> Vec<String> {
    let prepared = &outcome.prepared;
    let mut found = of_prepared(prepared);
    for (pooled, causes) in &outcome.pooled {
        let numbers: Vec<String> =
            pooled.with.joints.iter().map(|joint| (joint + 1).to_string()).collect();
        let named: Vec<String> = causes
            .iter()
            .filter(|cause| cause.is_named)
            .map(|cause| format!("{} ({:.0} %)", cause.joint + 1, 100.0 * cause.taken.shrinkage))
            .collect();
        if let Some(first) = causes.first() {
            found.push(format!(
                "joints {} are servos of one type: with one Coulomb level in common, friction of {:.2} V/Nm by \
                 the motor's torque takes {:.0} % of the squares of the train logs; what is left of \
                 confirming logs shrinks on joints {}. Refitted joint by joint, Coulomb levels hide it",
                numbers.join(", "),
                first.servo.motor_load_friction,
                100.0 * pooled.gain.part,
                if named.is_empty() { "none".to_owned() } else { named.join(", ") }
            ));
        }
    }
    found
}

/// Contacts, clipped goals, and what was held out.
pub fn of_prepared(prepared: &Prepared) -> Vec<String> {
    let mut found = contacts(prepared);
    found.extend(prepared.clips.iter().map(|clip| {
        format!(
            "goal_clip: {}: joint {} stops at {:.4} while its goals go on; they were clipped before the \
             drive, so the log says nothing there and is cut",
            clip.file, clip.joint, clip.at
        )
    }));
    if !prepared.is_held_out {
        found.push("no log is held out: the last 30 % of each confirm".to_owned());
    }
    found
}

/// Contacts, one sentence a log.
fn contacts(prepared: &Prepared) -> Vec<String> {
    let contacts = &prepared.contacts;
    let mut files: Vec<&str> = contacts.iter().map(|contact| contact.file.as_str()).collect();
    files.dedup();
    let of = |file: &str| {
        let of_file: Vec<_> = contacts.iter().filter(|contact| contact.file == file).collect();
        let seconds: Vec<String> = of_file
            .iter()
            .map(|contact| format!("{:.1} to {:.1} s", contact.seconds[0], contact.seconds[1]))
            .collect();
        format!(
            "contact: {file}: the arm pushes against something, joint {} furthest from where it would be: \
             {}; these seconds are cut out of fit and figures",
            of_file[0].joint,
            seconds.join(", ")
        )
    };
    files.into_iter().map(of).collect()
}

/// Joints that hardly move show nothing.
pub fn untestable(outcome: &Outcome) -> Vec<Untestable> {
    /// Less than this is no motion [rad; m].
    const LEAST_RANGE: f64 = 0.05;
    let train = outcome.prepared.train();
    let range = |joint: usize| {
        let positions = || train.iter().flat_map(|log| log.record.joints[joint].position.iter());
        let high = positions().copied().fold(f64::NEG_INFINITY, f64::max);
        high - positions().copied().fold(f64::INFINITY, f64::min)
    };
    let still = (0..outcome.models.len()).filter(|joint| range(*joint) < LEAST_RANGE);
    still
        .map(|joint| Untestable {
            effect: "saturation".to_owned(),
            joint: joint as u8 + 1,
            why: format!(
                "joint {} hardly moves in the train logs: nothing of it can be told",
                joint + 1
            ),
        })
        .collect()
}
