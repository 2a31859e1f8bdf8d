//! Arms of any kind: what their files hold, and what is said of bad ones.

use files::arm_file::{DriveKind, EncoderSide};
use files::{ArmFile, FileError, RobotFile};
use model::mechanism::{JointKind, Mechanism};

/// An arm with all that the format has: a current-driven slide and a position servo.
const ARM: &str = r#"format = 2
[robot]
name = "crane"
gravity_m_s2 = [0.0, 0.0, -9.81]
sample_period_s = 0.02

[[joint]]
name = "slide"
kind = "prismatic"
origin_xyz_m = [0.0, 0.0, 0.5]
origin_rpy_rad = [0.0, 0.1, 0.0]
axis = [1, 0, 0]
mass_kg = 12
com_m = [0.0, 0.0, 0.1]
inertia_kg_m2 = [0.1, 0.0, 0.0, 0.1, 0.0, 0.1]
armature_kg = 3.0
limits_m = [0.0, 0.8]
[joint.drive]
kind = "current"
torque_constant_N_per_A = 40.0
gear_ratio = -314.2
limit_A = 5.0
[joint.encoder]
counts_per_rev = 8192
side = "motor"
[joint.friction]
alpha0_V = 0.4
alpha2_V_s_per_m = 2.0
[joint.standard_error]
mass_kg = 0.1
com_m = 0.01
alpha0_V = 0.02

[[joint]]
name = "elbow"
kind = "revolute"
origin_xyz_m = [0.1, 0.0, 0.0]
origin_rpy_rad = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 2.0]
mass_kg = 0.1
com_m = [0.05, 0.0, 0.0]
inertia_kg_m2 = [1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-4]
limits_rad = [-1.7, 1.7]
[joint.drive]
kind = "position-servo"
torque_constant_Nm_per_V = 0.5
stiffness_V_per_rad = 30.0
damping_V_s_per_rad = 0.1
limit_V = 12.0
[joint.encoder]
counts_per_rev = 4096
[joint.friction]
alpha0_V = 0.1
alpha1_V = 0.02
stribeck_velocity_rad_per_s = 0.1
alpha2_V_s_per_rad = 1.2
sigma0_V_per_rad = 100.0
sigma1_V_s_per_rad = 0.5

[[effect]]
effect = "saturation"
joint = 2
parameters = { limit_V = 6.0 }
"#;

fn parse(text: &str) -> Result<ArmFile, FileError> {
    ArmFile::parse("model.toml", text.as_bytes().to_vec())
}

/// What is said of the arm with one of its lines changed.
fn refused(line: &str, by: &str) -> String {
    assert!(ARM.contains(line), "{line}");
    let error = parse(&ARM.replacen(line, by, 1)).unwrap_err();
    format!("{error}; {}", error.hint())
}

fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
}

#[test]
fn all_that_the_format_has_is_read() {
    let arm = parse(ARM).unwrap();
    assert_eq!((arm.name.as_deref(), arm.sample_period_s), (Some("crane"), Some(0.02)));
    let [slide, elbow] = arm.joints.as_slice() else { panic!("{:?}", arm.joints) };
    assert_eq!(
        (slide.kind, slide.armature, slide.limits),
        (JointKind::Prismatic, Some(3.0), Some([0.0, 0.8]))
    );
    let drive = slide.drive.as_ref().unwrap();
    assert_eq!(
        (drive.kind, drive.gear_ratio, drive.limit),
        (DriveKind::Current, -314.2, Some(5.0))
    );
    assert_eq!(drive.torque_constant, Some(40.0));
    let encoder = slide.encoder.unwrap();
    assert_eq!(encoder.side, EncoderSide::Motor);
    let step_m = slide.count_step().unwrap();
    assert!((step_m + std::f64::consts::TAU / (8192.0 * 314.2)).abs() < 1e-18);
    assert_eq!(slide.friction.unwrap().alpha2, Some(2.0));
    assert_eq!(slide.standard_error("com_m"), Some([0.01; 3].as_slice()));
    assert_eq!(slide.standard_error("inertia_kg_m2"), None);
    let servo = elbow.drive.as_ref().unwrap();
    assert_eq!(
        (servo.kind, servo.stiffness, servo.damping),
        (DriveKind::PositionServo, Some(30.0), Some(0.1))
    );
    assert_eq!(elbow.friction.unwrap().sigma1, Some(0.5));
    assert_eq!(arm.effects[0].number("limit_V"), Some(6.0));
}

#[test]
fn a_file_written_is_read_the_same() {
    let arm = parse(ARM).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.toml");
    arm.write(&path).unwrap();
    assert!(ArmFile::is_at(&path));
    let mut again = ArmFile::read(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    again.write(&path).unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    assert_eq!((&again.joints, &again.effects), (&arm.joints, &arm.effects));
    again.joints[0].link.mass_kg = None;
    again.write(&path).unwrap();
    // What was exact about an unknown mass is a contradiction.
    assert_says(
        &ArmFile::read(&path).unwrap_err().to_string(),
        &["mass_kg has a standard error, but no value"],
    );
}

/// How well sums of links' values are known.
#[test]
fn base_parameters_have_their_standard_errors() {
    let table = "\n[[base_parameter]]\nname = \"joint[2].mx_kg_m\"\nstandard_error = 1e-3\n";
    let arm = parse(&format!("{ARM}{table}")).unwrap();
    assert_eq!(arm.base_errors.len(), 1);
    assert_eq!(arm.base_errors[0].name, "joint[2].mx_kg_m");
    assert_eq!(arm.base_errors[0].standard_error, 1e-3);
    let again = parse(&arm.to_toml().unwrap()).unwrap();
    assert_eq!(again.base_errors, arm.base_errors);
    for (wrong, parts) in [
        ("standard_error = -1e-3", ["standard_error", "[[base_parameter]]"]),
        ("standard_error = \"small\"", ["standard_error", "number"]),
        ("value = 1e-3", ["standard_error", "[[base_parameter]]"]),
        ("standard_error = 1e-3\nvalue = 1.0", ["value", "standard_error"]),
    ] {
        let text = format!("{ARM}{}", table.replace("standard_error = 1e-3", wrong));
        assert_says(&parse(&text).unwrap_err().to_string(), &parts);
    }
}

#[test]
fn an_arm_is_a_chain() {
    let chain = parse(ARM).unwrap().chain().unwrap();
    let mut torque = [0.0; 2];
    chain.inverse_dynamics(&[0.0; 2], &[0.0; 2], &[1.0, 0.0], &mut torque);
    // The slide leans forwards: both masses and the rotor, less what they weigh along it.
    let expected = 12.1 + 3.0 - 12.1 * 9.81 * 0.1_f64.sin();
    assert!((torque[0] - expected).abs() < 1e-12, "{torque:?} {expected}");
}

#[test]
fn a_link_may_be_unknown() {
    let arm = parse(&ARM.replace("com_m = [0.05, 0.0, 0.0]\n", "")).unwrap();
    assert!(!arm.joints[1].is_link_known());
    assert_eq!(arm.chain_of_what_is_known().unwrap().joints().count(), 2);
    let error = arm.chain().unwrap_err();
    assert_says(
        &error.to_string(),
        &["model.toml, line 34", "com_m of joint 2 (elbow) is missing"],
    );
}

#[test]
fn an_inertia_of_no_body_is_remarked() {
    assert!(parse(ARM).unwrap().remarks().is_empty());
    let odd = ARM.replace("[1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-4]", "[1e-4, 0.0, 0.0, 1e-4, 0.0, 3e-4]");
    assert_says(&parse(&odd).unwrap().remarks()[0], &["joint 2 (elbow)"]);
}

#[test]
fn units_are_those_of_the_joint_and_the_command() {
    let message = refused("limits_m = [0.0, 0.8]", "limits_rad = [0.0, 0.8]");
    assert_says(&message, &["line 17: limits_rad is not known in [[joint]] 1", "limits_m"]);
    assert_says(&message, &["correct its name, with the unit"]);
    let message = refused("torque_constant_N_per_A", "torque_constant_Nm_per_V");
    assert_says(&message, &["line 20", "torque_constant_Nm_per_V", "drive of [[joint]] 1"]);
    // Friction keeps the names of format 1 where a file has them so.
    let renamed = ARM
        .replace("alpha2_V_s_per_m", "alpha2_A_s_per_m")
        .replace("alpha0_V = 0.4", "alpha0_A = 0.4");
    assert_eq!(parse(&renamed).unwrap().joints, parse(ARM).unwrap().joints);
    let as_before = ARM.replace("alpha2_V_s_per_m", "alpha2_V_s_per_rad");
    assert_eq!(parse(&as_before).unwrap().joints, parse(ARM).unwrap().joints);
}

#[test]
fn bad_values_are_named_with_line_and_cure() {
    let cases = [
        (
            "mass_kg = 12",
            "mass_kg = -12",
            "line 13: mass_kg in [[joint]] 1 is -12, but must be 0 or more",
        ),
        ("mass_kg = 12", "mass_kg = \"12\"", "line 13: mass_kg in [[joint]] 1 must be a number"),
        ("mass_kg = 12", "mass_kg = nan", "line 13: `joint.mass_kg = nan` is not a finite number"),
        (
            "axis = [1, 0, 0]",
            "axis = [0, 0, 0]",
            "line 12: axis is [0.0, 0.0, 0.0], but must have a direction",
        ),
        (
            "axis = [1, 0, 0]",
            "axis = [1, 0]",
            "line 12: axis in [[joint]] 1 must be a list of 3 numbers",
        ),
        (
            "kind = \"prismatic\"",
            "kind = \"linear\"",
            "line 9: kind is \"linear\", but must be one of \"revolute\", \"prismatic\"",
        ),
        ("kind = \"prismatic\"\n", "", "kind in [[joint]] 1 is missing"),
        (
            "limits_m = [0.0, 0.8]",
            "limits_m = [0.8, 0.0]",
            "line 17: limits_m is [0.8, 0], but must be [lower, upper]",
        ),
        (
            "gear_ratio = -314.2",
            "gear_ratio = 0",
            "line 21: gear_ratio in drive of [[joint]] 1 is 0, but must not be 0",
        ),
        (
            "counts_per_rev = 8192",
            "counts_per_rev = 0",
            "line 24: counts_per_rev in encoder of [[joint]] 1 is 0, but must be above 0",
        ),
        (
            "side = \"motor\"",
            "side = \"left\"",
            "line 25: side is \"left\", but must be one of \"joint\", \"motor\"",
        ),
        (
            "sample_period_s = 0.02",
            "sample_period_s = 0",
            "line 5: sample_period_s is 0, but must be above 0",
        ),
        (
            "sample_period_s",
            "sample_time_s",
            "line 5: sample_time_s is not known in [robot]; known are name",
        ),
        ("joint = 2\n", "joint = 3\n", "line 60: joint of the effect is 3, but must be 0 to 2"),
        (
            "com_m = 0.01",
            "com_m = [0.01, 0.02]",
            "the standard error of com_m has 2 numbers, but must have 1 or 3",
        ),
        (
            "alpha0_V = 0.02\n",
            "sigma0_V_per_m = 0.02\n",
            "sigma0_V_per_m has a standard error, but no value",
        ),
        ("[robot]", "[robots]", "[robot] is missing"),
        ("format = 2", "format = 3", "line 1: format 3 is not known here"),
    ];
    for (line, by, expected) in cases {
        assert_says(&refused(line, by), &["model.toml", expected]);
    }
}

#[test]
fn an_arm_has_a_joint_and_not_too_many() {
    let head = "format = 2\n[robot]\n";
    assert_says(
        &parse(head).unwrap_err().to_string(),
        &["there are 0 joints, but must be 1 to 10"],
    );
    let joint = "[[joint]]\nkind = \"revolute\"\naxis = [0, 0, 1]\n";
    let many = parse(&[head, &joint.repeat(11)].concat()).unwrap_err();
    assert_says(&many.to_string(), &["there are 11 joints"]);
    assert_eq!(parse(&[head, joint].concat()).unwrap().gravity_m_s2, [0.0, 0.0, -9.81]);
}

#[test]
fn the_formats_are_told_apart() {
    let error = RobotFile::parse("model.toml", ARM.as_bytes().to_vec()).unwrap_err();
    assert_says(&error.to_string(), &["format 2 is not known here", "arms of any kind"]);
    let error = parse(&ARM.replace("format = 2", "format = 1")).unwrap_err();
    assert_says(&error.to_string(), &["line 1: format 1 is not known here"]);
}

#[test]
fn a_measured_arm_is_read() {
    let Some(path) = test_support::data("real/so101/model.toml") else { return };
    let arm = ArmFile::read(path).unwrap();
    assert_eq!(arm.joints.len(), 6);
    assert!(
        arm.joints
            .iter()
            .all(|joint| joint.drive.as_ref().unwrap().kind == DriveKind::PositionServo)
    );
    assert_eq!(arm.remarks(), [""; 0]);
    let chain = arm.chain().unwrap();
    let mut torque = [0.0; 6];
    chain.gravity(&[0.0; 6], &mut torque);
    // The arm stretched out: the shoulder carries half a newton metre or so, the base nothing.
    assert!(torque[0].abs() < 1e-6 && (0.3..1.0).contains(&torque[1].abs()), "{torque:?}");
}
