//! The voltages that a motion needs.

use model::reference_robot::reference_robot;

use crate::rrr::{said, with_model, write};
use test_support::PIVOT;

fn column(text: &str, name: &str) -> f64 {
    let mut lines = text.lines();
    let index = lines.next().unwrap().split(',').position(|column| column == name);
    let index = index.unwrap_or_else(|| panic!("no {name} in {text}"));
    lines.next().unwrap().split(',').nth(index).unwrap().parse().unwrap()
}

const LINE: [&str; 6] =
    ["inverse-dynamics", "--model", "model.toml", "states.csv", "--out", "out.csv"];

#[test]
fn the_voltages_that_a_motion_needs_include_friction() {
    let directory = with_model();
    let states = "q1_rad,q2_rad,q3_rad,qd1_rad_per_s,qd2_rad_per_s,qd3_rad_per_s,\
        qdd1_rad_per_s2,qdd2_rad_per_s2,qdd3_rad_per_s2\n0.1,-1.2,0.3,1.5,-2.5,0,10,-20,30\n";
    write(directory.path(), "states.csv", states);
    said(directory.path(), &LINE);
    let text = std::fs::read_to_string(directory.path().join("out.csv")).unwrap();
    let robot = reference_robot::<f64>();
    for (joint, velocity) in [(1, 1.5), (2, -2.5), (3, 0.0)] {
        let friction = robot.friction[joint - 1].sliding(velocity);
        assert_eq!(column(&text, &format!("friction{joint}_V")), friction);
        let rigid = column(&text, &format!("u{joint}_V"));
        assert_eq!(column(&text, &format!("needed{joint}_V")), rigid + friction);
    }
}

#[test]
fn an_arm_that_takes_torques_is_told_the_same_in_newton_metres() {
    let directory = tempfile::tempdir().unwrap();
    write(directory.path(), "model.toml", PIVOT);
    write(directory.path(), "states.csv", "q1_rad,qd1_rad_per_s,qdd1_rad_per_s2\n0,2,0\n");
    said(directory.path(), &LINE);
    let text = std::fs::read_to_string(directory.path().join("out.csv")).unwrap();
    assert_eq!(column(&text, "friction1_Nm"), 0.05 + 2.0 * 0.02);
    assert_eq!(column(&text, "needed1_Nm"), column(&text, "tau1_Nm") + 0.09);
}

#[test]
fn its_help_says_which_terms_are_in_which_column() {
    let directory = tempfile::tempdir().unwrap();
    let help = said(directory.path(), &["inverse-dynamics", "--help"]);
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in
        ["u1_V.. (u1_A..) = tau / k_t, of the rigid body", "friction1_V..", "needed1_V.., the sum"]
    {
        assert!(help.contains(part), "{help}");
    }
}
