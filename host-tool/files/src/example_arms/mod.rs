//! Arms to try things on, of several kinds of joints and drives.

use super::ArmFile;

/// One rotary joint about a horizontal axis, commanded by voltage.
pub fn rotary_joint() -> ArmFile {
    parsed(include_str!("rotary_joint.toml"))
}

/// One sliding joint without gravity, commanded by force.
pub fn linear_axis() -> ArmFile {
    parsed(include_str!("linear_axis.toml"))
}

/// A pendulum of two links, commanded by voltages.
pub fn two_link_pendulum() -> ArmFile {
    parsed(include_str!("two_link_pendulum.toml"))
}

/// An arm of six joints with gears, commanded by currents, encoders on the motors.
pub fn six_axes() -> ArmFile {
    parsed(include_str!("six_axes.toml"))
}

/// Two upright turning joints, a slide and a turning hand, geared, commanded by currents, encoders on the motors of those
/// that turn.
pub fn scara() -> ArmFile {
    parsed(include_str!("scara.toml"))
}

/// Three slides, commanded by a voltage, a force and a current.
pub fn gantry() -> ArmFile {
    parsed(include_str!("gantry.toml"))
}

fn parsed(text: &str) -> ArmFile {
    let bytes = text.as_bytes().to_vec();
    ArmFile::parse("arm.toml", bytes).expect("the project's own files are right")
}
