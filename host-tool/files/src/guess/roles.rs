//! What a name says that a column is.

use super::words::has;
use crate::quantity::Role;

const TIME: &[&str] =
    &["t", "time", "timestamp", "stamp", "zeit", "seconds", "sec", "secs", "temps"];
const REFERENCE: &[&str] = &[
    "ref",
    "qref",
    "reference",
    "des",
    "desired",
    "target",
    "goal",
    "setpoint",
    "sp",
    "soll",
    "action",
];
const VELOCITY: &[&str] =
    &["vel", "velocity", "velocities", "speed", "qd", "dq", "qdot", "omega", "dtheta", "rpm"];
const ACCELERATION: &[&str] = &["acc", "acceleration", "qdd", "ddq", "accel"];
const COMMAND: &[&str] =
    &["u", "cmd", "command", "commands", "commanded", "pwm", "duty", "input", "data"];
const DRIVE: &[&str] = &[
    "tau",
    "torque",
    "torques",
    "effort",
    "efforts",
    "current",
    "currents",
    "load",
    "moment",
    "voltage",
    "volt",
    "volts",
    "force",
    "drehmoment",
    "strom",
    "spannung",
];
const POSITION: &[&str] = &[
    "q",
    "pos",
    "position",
    "positions",
    "angle",
    "angles",
    "theta",
    "phi",
    "state",
    "encoder",
    "enc",
    "count",
    "counts",
    "ticks",
    "qpos",
    "winkel",
    "actual",
    "deg",
];

/// The role that a name's words tell of.
pub(super) fn role(words: &[String]) -> Option<Role> {
    let is = |list| has(words, list);
    if is(ACCELERATION) || is(&["temperature", "temp", "error", "err"]) {
        None
    } else if is(VELOCITY) {
        (!is(REFERENCE) && !is(COMMAND)).then_some(Role::Velocity)
    } else if is(DRIVE) {
        let is_command =
            is(COMMAND) || is(REFERENCE) || is(&["voltage", "volt", "volts", "spannung"]);
        Some(if is_command { Role::Command } else { Role::Torque })
    } else if is(REFERENCE) || (is(COMMAND) && is(POSITION)) {
        Some(Role::Reference)
    } else if is(COMMAND) {
        Some(Role::Command)
    } else if is(POSITION) {
        Some(Role::Position)
    } else {
        is(TIME).then_some(Role::Time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guess::words::words;

    #[test]
    fn common_names_are_told() {
        let cases = [
            ("timestamp", Some(Role::Time)),
            ("header.stamp", Some(Role::Time)),
            ("joint_1_pos", Some(Role::Position)),
            ("observation.state[3]", Some(Role::Position)),
            ("action[3]", Some(Role::Reference)),
            ("position[elbow]", Some(Role::Position)),
            ("velocity[elbow]", Some(Role::Velocity)),
            ("effort[elbow]", Some(Role::Torque)),
            ("tau_cmd_2", Some(Role::Command)),
            ("motor_voltage_1", Some(Role::Command)),
            ("pos_cmd_1", Some(Role::Reference)),
            ("qdd1", None),
            ("frame_index", None),
        ];
        for (name, expected) in cases {
            assert_eq!(role(&words(name)), expected, "{name}");
        }
    }
}
