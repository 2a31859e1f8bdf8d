//! A rig that has joint 3 alone: the encoders of the others count nothing.
#![cfg(unix)]
#![allow(missing_docs)]

#[allow(dead_code)]
#[path = "common/simulated_board.rs"]
mod simulated_board;

use files::{Dataset, Log, Position, RobotFile};
use model::reference_robot::reference_robot;
use simulated_board::{assert_tells, refused, rrr, said};
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

#[test]
fn joint_3_alone_is_homed_run_and_recorded() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    RobotFile::from_robot(&reference_robot()).write(at.join("model.toml")).unwrap();
    let mut settings = BoardSettings::new(reference_robot());
    settings.arm.incremental_encoders = true;
    settings.arm.dead_encoders = [true, true, false];
    let board = SimulatedBoard::start(settings).unwrap();
    // Somebody turns joint 3 within the first second.
    std::thread::sleep(std::time::Duration::from_millis(1100));
    let text = said(at, &board, "home --at 0,-1.5708,0");
    assert_tells(&text, &["joint 1: the encoder has not", "joint 3 is at 0 rad"]);
    assert_tells(&said(at, &board, "connect"), &["unknown for joint 1, 2: "]);

    said(at, &board, "upload model.toml --mode pd");
    let why = refused(rrr(at, &board.port(), "run hold --out all").assert());
    assert_tells(&why, &["joint 1: its encoder has not moved", "--joints"]);

    said(at, &board, "upload model.toml --mode pd --joints 3");
    let text = said(at, &board, "run hold --duration 1 --out one");
    assert_tells(&text, &["played to its end"]);
    let why = refused(rrr(at, &board.port(), "run presliding-noise --joint 1 --out one").assert());
    assert_tells(&why, &["presliding-noise-1 moves joint 1, which the rig does not have"]);
    let entry = Dataset::read(at.join("one")).unwrap().entries.remove(0);
    let log = Log::read(at.join("one").join(entry.file)).unwrap();
    assert_eq!(log.joints.iter().map(|joint| joint.joint).collect::<Vec<_>>(), [3]);
}

const PENDULUM: &str = "format = 1\n[robot]\ntorque_constant_Nm_per_V = [3.0]\n\
    gravity_m_s2 = 9.81\nencoder_counts_per_rev = 655360\n[pendulum]\njoint = 3\n\
    inertia_kg_m2 = 0.0709\ngravity_torque_Nm = 1.9688\n[[friction]]\njoint = 3\n\
    alpha0_V = 0.3\nalpha1_V = 0.05\nstribeck_velocity_rad_per_s = 0.003\n\
    alpha2_V_s_per_rad = 0.09\nsigma0_V_per_rad = 1170.0\nsigma1_V_s_per_rad = 3.7\n";

/// Rms of what joint 3 is away from its reference after the first second [rad].
fn tracking_error_rad(log: &Log) -> f64 {
    let joint = &log.joints[0];
    let Position::Count(counts) = &joint.position else { panic!("counts") };
    let reference = joint.reference_rad.as_ref().unwrap();
    let rad_per_count = std::f64::consts::TAU / 655_360.0;
    let errors = counts.iter().zip(reference).skip(1000);
    let squares: Vec<f64> =
        errors.map(|(count, r)| (*count as f64 * rad_per_count - r).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn the_model_of_a_pendulum_moves_it_accurately() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    std::fs::write(at.join("pendulum.toml"), PENDULUM).unwrap();
    let rig = RobotFile::read(at.join("pendulum.toml")).unwrap().as_third_joint(1e6).unwrap();
    let board = SimulatedBoard::start(BoardSettings::new(rig)).unwrap();
    let error_rad = |mode: &str| {
        said(at, &board, &format!("upload pendulum.toml --mode {mode}"));
        let line = format!("run task --duration 4 --approach-speed 3 --out {mode}");
        assert_tells(&said(at, &board, &line), &["played to its end"]);
        let entry = Dataset::read(at.join(mode)).unwrap().entries.remove(0);
        tracking_error_rad(&Log::read(at.join(mode).join(entry.file)).unwrap())
    };
    let [with, without] = ["pd-model", "pd"].map(error_rad);
    println!("{with} rad with the model, {without} without");
    assert!(with < 1e-4 && without > 20.0 * with, "{with} {without}");

    let other = PENDULUM.replace("joint = 3", "joint = 2");
    std::fs::write(at.join("other.toml"), other).unwrap();
    let why = refused(rrr(at, &board.port(), "upload other.toml").assert());
    assert_tells(&why, &["joint = 2 in [pendulum]", "output C"]);
}
