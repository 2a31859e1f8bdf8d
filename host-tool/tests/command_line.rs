//! `rrr` from outside: what it prints, and how it ends.

use std::path::Path;

use assert_cmd::Command;
use files::RobotFile;
use model::Posture;
use model::reference_robot::reference_robot;

mod common;
use common::directory;

const STATES: &str = "t_s,q1_rad,q2_rad,q3_rad,qd1_rad_per_s,qd2_rad_per_s,qd3_rad_per_s,\
    qdd1_rad_per_s2,qdd2_rad_per_s2,qdd3_rad_per_s2\n\
    0,0.1,-1.2,0.3,1.5,-2.5,3.5,10,-20,30\n\
    0.001,0,0,0,0,0,0,0,0,0\n";

fn rrr(directory: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("rrr").unwrap().current_dir(directory).args(arguments).assert()
}

fn inverse_dynamics(directory: &Path) -> assert_cmd::assert::Assert {
    rrr(directory, &["inverse-dynamics", "--model", "model.toml", "states.csv", "--out", "out.csv"])
}

/// A directory with the reference robot and two states.
fn with_reference_robot() -> tempfile::TempDir {
    let directory = directory();
    RobotFile::from_robot(&reference_robot()).write(directory.path().join("model.toml")).unwrap();
    std::fs::write(directory.path().join("states.csv"), STATES).unwrap();
    directory
}

fn stderr(assert: &assert_cmd::assert::Assert) -> String {
    String::from_utf8(assert.get_output().stderr.clone()).unwrap()
}

/// Asserts exit status 2, one line of error, one of hint, and no output file.
fn assert_refused(directory: &Path, parts: &[&str]) {
    let assert = inverse_dynamics(directory).code(2).stdout("");
    let text = stderr(&assert);
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 2, "{text}");
    assert!(lines[0].starts_with("error: ") && lines[1].starts_with("hint: "), "{text}");
    for part in parts {
        assert!(lines[0].contains(part), "no `{part}` in: {text}");
    }
    assert!(!directory.join("out.csv").exists());
}

#[test]
fn help_names_the_commands() {
    let assert = rrr(Path::new("."), &["--help"]).success();
    let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    assert!(text.contains("inverse-dynamics"), "{text}");
    rrr(Path::new("."), &["inverse-dynamics", "--help"]).success();
}

#[test]
fn wrong_arguments_end_with_status_2() {
    rrr(Path::new("."), &[]).code(2);
    rrr(Path::new("."), &["dance"]).code(2);
    rrr(Path::new("."), &["inverse-dynamics"]).code(2);
}

#[test]
fn torques_and_voltages_are_exact() {
    let directory = with_reference_robot();
    inverse_dynamics(directory.path()).success().stderr("");
    let text = std::fs::read_to_string(directory.path().join("out.csv")).unwrap();
    let lines: Vec<_> = text.lines().collect();
    let rigid = "tau1_Nm,tau2_Nm,tau3_Nm,u1_V,u2_V,u3_V";
    let whole = "friction1_V,friction2_V,friction3_V,needed1_V,needed2_V,needed3_V";
    assert_eq!(lines[0], format!("{rigid},{whole}"));
    assert_eq!(lines.len(), 3);
    let robot = reference_robot::<f64>();
    let torque_nm = Posture::new(-1.2, 0.3).inverse_dynamics(
        &robot.base,
        &robot.geometry,
        &[1.5, -2.5, 3.5],
        &[10.0, -20.0, 30.0],
    );
    let rigid_v = robot.torque_to_voltage(&torque_nm);
    let velocity = [1.5, -2.5, 3.5];
    let friction_v = [0, 1, 2].map(|i| robot.friction[i].sliding(velocity[i]));
    let needed_v = [0, 1, 2].map(|i| rigid_v[i] + friction_v[i]);
    let expected = [torque_nm, rigid_v, friction_v, needed_v].concat();
    let found: Vec<f64> = lines[1].split(',').map(|field| field.parse().unwrap()).collect();
    assert_eq!(found, expected);
}

#[test]
fn a_pendulum_uses_the_columns_of_its_joint() {
    let directory = directory();
    let model = "format = 1\n[robot]\ntorque_constant_Nm_per_V = [2.0]\n[pendulum]\njoint = 3\n\
        inertia_kg_m2 = 0.5\ngravity_torque_Nm = 2.0\n";
    std::fs::write(directory.path().join("model.toml"), model).unwrap();
    let states = "q3_rad,qd3_rad_per_s,qdd3_rad_per_s2\n0.25,9,4\n0,0,0\n";
    std::fs::write(directory.path().join("states.csv"), states).unwrap();
    inverse_dynamics(directory.path()).success();
    let text = std::fs::read_to_string(directory.path().join("out.csv")).unwrap();
    let torque_nm = 0.5 * 4.0 + 2.0 * model::Real::sin_cos(0.25_f64).0;
    assert_eq!(text, format!("tau3_Nm,u3_V\n{torque_nm},{}\n0,0\n", torque_nm / 2.0));
}

#[test]
fn what_the_torques_leave_out_is_said() {
    let directory = with_reference_robot();
    let path = directory.path().join("model.toml");
    let mut text = std::fs::read_to_string(&path).unwrap();
    text += "[[effect]]\neffect = \"payload\"\njoint = 0\nparameters = { mass_kg = 1.0 }\n";
    std::fs::write(&path, text.replace("zz3r = ", "zz3r = -")).unwrap();
    let text = stderr(&inverse_dynamics(directory.path()).success());
    assert!(text.contains("warning: no rigid robot has these base parameters: zz3r"), "{text}");
    assert!(text.contains("note: effects of the model are left out"), "{text}");
}

#[test]
fn missing_files_are_named() {
    let directory = directory();
    assert_refused(directory.path(), &["model.toml: there is no such file"]);
    let directory = with_reference_robot();
    std::fs::remove_file(directory.path().join("states.csv")).unwrap();
    assert_refused(directory.path(), &["states.csv: there is no such file"]);
}

#[test]
fn bad_states_are_named_with_line_and_column() {
    let directory = with_reference_robot();
    let says = |from: &str, to: &str, parts: &[&str]| {
        std::fs::write(directory.path().join("states.csv"), STATES.replace(from, to)).unwrap();
        assert_refused(directory.path(), parts);
    };
    says("qd2_rad_per_s", "speed", &["states.csv", "column qd2_rad_per_s is missing"]);
    says("3.5", "fast", &["states.csv, line 2, column qd3_rad_per_s: `fast` is not a number"]);
    says("0.001,0", "0.001", &["states.csv, line 3", "has 9 fields"]);
    says(STATES, "", &["states.csv: is empty"]);
    says(STATES, STATES.lines().next().unwrap(), &["states.csv: holds no samples"]);
}

#[test]
fn bad_models_are_named_with_their_line() {
    let directory = with_reference_robot();
    let path = directory.path().join("model.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let says = |from: &str, to: &str, parts: &[&str]| {
        std::fs::write(&path, text.replace(from, to)).unwrap();
        assert_refused(directory.path(), parts);
    };
    says("zz1r", "note", &["model.toml, line 12", "zz1r in [base] is missing"]);
    says("zz1r", "zz9r", &["model.toml, line 13", "zz9r is not known in [base]; known are zz1r"]);
    says("6.3,", "0,", &["model.toml, line 10", "torque_constant_Nm_per_V of joint 2 is 0"]);
    says("format = 1", "format = 7", &["model.toml, line 1", "format 7"]);
}

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let directory = with_reference_robot();
    let arguments =
        ["inverse-dynamics", "--model", "model.toml", "states.csv", "--out", "none/out.csv"];
    let text = stderr(&rrr(directory.path(), &arguments).code(2));
    assert!(text.starts_with("error: none/out.csv: cannot be written"), "{text}");
}

#[cfg(unix)]
#[test]
fn a_pipe_takes_the_output_too() {
    let directory = with_reference_robot();
    let arguments =
        ["inverse-dynamics", "--model", "model.toml", "states.csv", "--out", "/dev/stdout"];
    let assert = rrr(directory.path(), &arguments).success();
    assert!(assert.get_output().stdout.starts_with(b"tau1_Nm,"));
}

#[cfg(unix)]
#[test]
fn a_link_stays_one_when_its_file_is_written() {
    let directory = with_reference_robot();
    let [link, target] = ["link.csv", "target.csv"].map(|name| directory.path().join(name));
    std::fs::write(&target, "before").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    let arguments =
        ["inverse-dynamics", "--model", "model.toml", "states.csv", "--out", "link.csv"];
    rrr(directory.path(), &arguments).success();
    assert!(link.symlink_metadata().unwrap().is_symlink());
    assert!(std::fs::read(&target).unwrap().starts_with(b"tau1_Nm,"));
}
