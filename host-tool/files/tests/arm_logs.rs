//! Logs of arms of any kind.

use files::{ArmFile, ArmLog, FileError};

const ARM: &str = r#"format = 2
[robot]
[[joint]]
kind = "prismatic"
axis = [1, 0, 0]
[joint.drive]
kind = "current"
gear_ratio = -100
[joint.encoder]
counts_per_rev = 4096
side = "motor"
[[joint]]
kind = "revolute"
axis = [0, 0, 1]
[joint.drive]
kind = "position-servo"
"#;

const LOG: &str = "t_s,q1_count,u1_A,qref1_m,q2_rad,qref2_rad,qd2_rad_per_s,tau2_Nm,tau2_raw\n\
                   0,4096,0.5,0.01,0.1,0.2,1.5,-3,7\n0.02,-8192,0.6,0.02,0.15,0.25,1.6,-4,8\n";

fn read(model: &str, log: &str) -> Result<ArmLog, FileError> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("log.csv");
    std::fs::write(&path, log).unwrap();
    ArmLog::read(path, &ArmFile::parse("model.toml", model.into())?)
}

#[test]
fn columns_are_those_of_joint_and_drive() {
    let log = read(ARM, LOG).unwrap();
    assert_eq!((log.len(), log.time_s[1]), (2, 0.02));
    let [slide, servo] = log.joints.as_slice() else { panic!() };
    let turn_m = -std::f64::consts::TAU / 100.0;
    assert!(
        (slide.position[0] - turn_m).abs() < 1e-15
            && (slide.position[1] + 2.0 * turn_m).abs() < 1e-15
    );
    assert_eq!((&slide.command, &slide.reference), (&vec![0.5, 0.6], &Some(vec![0.01, 0.02])));
    assert_eq!((&slide.velocity, &slide.torque), (&None, &None));
    // A servo's command is its goal.
    assert_eq!((&servo.position, &servo.command), (&vec![0.1, 0.15], &vec![0.2, 0.25]));
    assert_eq!((&servo.reference, &servo.velocity), (&None, &Some(vec![1.5, 1.6])));
    assert_eq!(servo.torque, Some(vec![-3.0, -4.0]));
}

#[test]
fn what_is_wrong_is_named() {
    let cases = [
        ("q2_rad", "q2_m", "the column q2_rad (or q2_count) is missing"),
        (
            "u1_A",
            "u1_V",
            "log.csv, column u1_V: the command of joint 1 is in u1_V, but its drive in the model takes u1_A",
        ),
        ("u1_A", "v1_A", "the column u1_A is missing"),
        (
            "qref2_rad",
            "u2_V",
            "column u2_V: the command of joint 2 is in u2_V, but its drive in the model takes qref2_rad",
        ),
        ("tau2_raw", "q2_count", "joint 2 has its position both in counts and in radians"),
        ("t_s,", "t,", "the column t_s is missing"),
        ("\n0.02,", "\n0,", "line 3, column t_s: time goes from 0 s to 0 s"),
        ("0.15", "nan", "line 3, column q2_rad: `nan` is not a finite number"),
        ("4096", "4096.5", "line 2, column q1_count"),
        (
            "\n0,4096,0.5,0.01,0.1,0.2,1.5,-3,7\n0.02,-8192,0.6,0.02,0.15,0.25,1.6,-4,8\n",
            "\n",
            "holds no samples",
        ),
    ];
    for (part, by, expected) in cases {
        assert!(LOG.contains(part), "{part}");
        let message = read(ARM, &LOG.replacen(part, by, 1)).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
    let without = ARM.replace("[joint.encoder]\ncounts_per_rev = 4096\nside = \"motor\"\n", "");
    let message = read(&without, LOG).unwrap_err().to_string();
    assert!(message.contains("q1_count is in counts, but [joint.encoder] of joint 1"), "{message}");
}

#[test]
fn a_measured_log_is_read() {
    let Some(directory) = test_support::data("real/so101") else { return };
    let arm = ArmFile::read(directory.join("model.toml")).unwrap();
    let log = ArmLog::read(directory.join("chirp_sweep.csv.gz"), &arm).unwrap();
    assert!(log.len() > 100 && log.joints.len() == 6);
    for (joint, model) in log.joints.iter().zip(&arm.joints) {
        let [lower, upper] = model.limits.unwrap();
        assert!(joint.position.iter().all(|q| (lower - 0.1..upper + 0.1).contains(q)));
        assert!(joint.velocity.is_some() && joint.torque.is_none());
    }
}
