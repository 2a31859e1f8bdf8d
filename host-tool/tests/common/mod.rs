//! What the tests share.
#![allow(dead_code)] // Each test file uses a part of it.

use files::{JointLog, Log, Position, RobotFile};
use model::Robot;
use model::reference_robot::reference_robot;
use recordings::campaign::Known;

#[cfg(unix)]
pub mod simulated_board;

/// An empty directory that vanishes with the value.
pub fn directory() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

/// A directory with the reference robot's model file, `model.toml`.
pub fn with_model() -> tempfile::TempDir {
    let directory = directory();
    RobotFile::from_robot(&reference_robot()).write(directory.path().join("model.toml")).unwrap();
    directory
}

/// What is known beforehand of a simulated rig: the numbers of its manufacturer.
pub fn known(robot: &Robot<f64>) -> Known {
    Known {
        geometry: Some(robot.geometry),
        gravity_m_s2: robot.geometry.gravity_m_s2,
        torque_constant_nm_per_v: robot.torque_constant_nm_per_v.to_vec(),
        joints: vec![1, 2, 3],
        encoder_step_rad: std::f64::consts::TAU / 655_360.0,
        command_limit_v: 10.0,
        command_step_v: 20.0 / 65_536.0,
    }
}

/// A log of three joints in counts, on the millisecond grid.
pub fn log_in_counts(rows: usize) -> Log {
    let joint = |joint: u8| JointLog {
        joint,
        position: Position::Count((0..rows as i64).map(|i| 1000 * i64::from(joint) - i).collect()),
        command_v: (0..rows).map(|i| (i % 7) as f64 * 0.125 - 0.25).collect(),
        reference_rad: Some((0..rows).map(|i| i as f64 / 8.0 - 1.5).collect()),
    };
    Log {
        time_s: (0..rows).map(|i| i as f64 / 1000.0).collect(),
        joints: (1..=3).map(joint).collect(),
    }
}

/// A log of joint 3 in radians, unevenly sampled, without a reference.
pub fn log_in_radians() -> Log {
    let joint = JointLog {
        joint: 3,
        position: Position::Radian(vec![-0.00145723659, 0.25, 0.5]),
        command_v: vec![-0.004396, 0.0, 1.0],
        reference_rad: None,
    };
    Log { time_s: vec![0.0, 0.003334, 0.01], joints: vec![joint] }
}
