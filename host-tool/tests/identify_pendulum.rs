//! The real pendulum: what its logs say against what its makers published.

mod common;

use files::{Dataset, RobotFile, Role};
use identification::one_joint::pendulum::{self, OneJoint};
use recordings::{Campaign, Trace};

/// By the makers, from the identification log.
const PUBLISHED_INERTIA: f64 = 0.06259;
const PUBLISHED_GRAVITY: f64 = 0.1022 * 9.81;
/// By the parts list: 0.546 kg at 0.5 m and a rod of 0.13 kg.
const PARTS_INERTIA: f64 = 0.147;
const PARTS_GRAVITY: f64 = 0.305 * 9.81;

fn identified() -> Option<OneJoint> {
    let directory = test_support::data("dfki-pendulum")?;
    let dataset = Dataset::read(&directory).unwrap();
    let robot = RobotFile::read(directory.join("robot.toml")).unwrap();
    let campaign = Campaign::read(&dataset, robot).unwrap();
    let train: Vec<&Trace> =
        campaign.traces.iter().filter(|trace| trace.role == Role::Train).collect();
    Some(pendulum::identify(&train, 3, &campaign.known).unwrap())
}

#[test]
fn the_logs_side_with_the_parts_list() {
    let Some(found) = identified() else { return };
    eprintln!("{found:#?}");
    assert!(found.inertia_kg_m2.covers(PARTS_INERTIA));
    assert!(found.gravity_torque_nm.covers(PARTS_GRAVITY));
    assert!(!found.inertia_kg_m2.covers(PUBLISHED_INERTIA));
    assert!(!found.gravity_torque_nm.covers(PUBLISHED_GRAVITY));
    // No error of the torque's scale reaches l / J: 20.3 by the parts, 16.0 as published.
    assert!(found.swing_frequency_squared_per_s2.covers(PARTS_GRAVITY / PARTS_INERTIA));
    assert!(!found.swing_frequency_squared_per_s2.covers(PUBLISHED_GRAVITY / PUBLISHED_INERTIA));
}

#[test]
fn friction_agrees_with_the_makers_within_its_errors() {
    let Some(found) = identified() else { return };
    assert!(found.alpha0_v.covers(0.1839));
    assert!(found.offset_v.covers(-0.07586));
    assert!(found.alpha2_v_s_per_rad.interval[1] > 0.03);
}

#[test]
fn logs_that_an_outside_force_moved_are_left_out() {
    let Some(found) = identified() else { return };
    assert_eq!(found.used, ["identification.csv.gz"]);
    let left_out: Vec<&str> = found.left_out.iter().map(|(file, _)| file.as_str()).collect();
    assert_eq!(left_out, ["gravity-compensation.csv.gz", "torque-limited.csv.gz"]);
    assert!(found.left_out.iter().all(|(_, why)| why.contains("outside force")));
}
