//! Robot and model files: what they hold, and what is said of bad ones.

use files::{EffectTable, FileError, FrictionTable, RobotFile};
use model::reference_robot::reference_robot;

mod common;
use common::directory;

const ROBOT: &str = "format = 1
[robot]
gravity_m_s2 = 9.81
d1_m = 0.56
d2_m = 0.169
a2_m = 0.2
d3_m = 0.09
a3_m = 0.415
torque_constant_Nm_per_V = [12.0, 6.3, 3.0]
encoder_counts_per_rev = 655360
sample_period_s = 0.001
command_limit_V = 10.0
command_bits = 16
";

const PENDULUM: &str = "format = 1
[robot]
gravity_m_s2 = 9.81
torque_constant_Nm_per_V = [1]

[pendulum]
joint = 3
inertia_kg_m2 = 0.0709
gravity_torque_Nm = 1.9688
inertia_standard_error_kg_m2 = 0.001

[[friction]]
joint = 3
alpha0_V = 0.3561
alpha1_V = -0.1736
stribeck_velocity_rad_per_s = 0.003
alpha2_V_s_per_rad = 0.1252
";

fn parse(text: &str) -> Result<RobotFile, FileError> {
    let directory = directory();
    let path = directory.path().join("model.toml");
    std::fs::write(&path, text).unwrap();
    RobotFile::read(path)
}

/// A file written and read again, and its text.
fn round_trip(file: &RobotFile) -> (RobotFile, String) {
    let directory = directory();
    let path = directory.path().join("model.toml");
    file.write(&path).unwrap();
    (RobotFile::read(&path).unwrap(), std::fs::read_to_string(&path).unwrap())
}

fn reference_text() -> String {
    round_trip(&RobotFile::from_robot(&reference_robot())).1
}

fn assert_says(error: &FileError, parts: &[&str]) {
    let message = error.to_string();
    for part in [&["model.toml"], parts].concat() {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
}

#[test]
fn the_reference_robot_survives() {
    let robot = reference_robot();
    assert_eq!(round_trip(&RobotFile::from_robot(&robot)).0.robot().unwrap(), robot);
}

#[test]
fn a_robot_file_has_no_model_yet() {
    let file = parse(ROBOT).unwrap();
    assert_eq!(file.robot.encoder_counts_per_rev, Some(655_360.0));
    assert_eq!(file.robot.command_bits, Some(16));
    assert!(!file.is_pendulum());
    assert_says(&file.robot().unwrap_err(), &["[base] is missing"]);
    assert_says(&file.pendulum().unwrap_err(), &["[pendulum] is missing"]);
    assert_says(&file.friction(2).unwrap_err(), &["[[friction]] of joint 2 is missing"]);
}

#[test]
fn a_robot_file_is_written_as_the_contract_shows_it() {
    let (_, text) = round_trip(&parse(ROBOT).unwrap());
    assert_eq!(text.replace("\n\n", "\n"), ROBOT);
}

#[test]
fn a_model_is_put_into_a_robot_file() {
    let robot = reference_robot();
    let file = parse(ROBOT).unwrap().with_model(robot.base, &robot.friction);
    let (read, text) = round_trip(&file);
    assert_eq!(read.robot().unwrap(), robot);
    let places = ["format = 1", "[robot]", "[base]", "[[friction]]\njoint = 1"];
    let places: Vec<_> = places.iter().map(|part| text.find(part).unwrap()).collect();
    assert!(places.is_sorted(), "{text}");
}

#[test]
fn a_pendulum_is_read_with_static_friction_alone() {
    let file = parse(PENDULUM).unwrap();
    assert!(file.is_pendulum());
    let pendulum = file.pendulum().unwrap();
    assert_eq!((pendulum.joint, pendulum.gravity_torque_nm), (3, 1.9688));
    assert_eq!(file.torque_constant(3).unwrap(), 1.0);
    assert!(file.torque_constant(1).is_err());
    assert_eq!(file.friction_table(3).unwrap().sigma0_v_per_rad, None);
    let error = file.friction(3).unwrap_err();
    assert_says(&error, &["line 12", "sigma0_V_per_rad of joint 3 is missing"]);
    let (read, _) = round_trip(&file);
    assert_eq!(read.pendulum.unwrap().extra, file.pendulum.unwrap().extra);
    assert_eq!(read.friction, file.friction);
}

#[test]
fn a_pendulum_is_put_into_its_robot_file() {
    let text = "format = 1\n[robot]\ntorque_constant_Nm_per_V = [1.0]\n[pendulum]\njoint = 3\n";
    let file = parse(text).unwrap();
    let missing = ["line 4", "inertia_kg_m2 in [pendulum] is missing"];
    assert_says(&file.pendulum().unwrap_err(), &missing);
    let whole = parse(PENDULUM).unwrap();
    let pendulum = whole.pendulum().unwrap();
    let file = file.with_pendulum(&pendulum, whole.friction[0].clone());
    assert_eq!(round_trip(&file).0.pendulum().unwrap(), pendulum);
}

#[test]
fn effects_are_carried_as_data() {
    let text = reference_text()
        + "
[[effect]]
effect = \"cogging\"
joint = 3
parameters = { amplitude_V = 0.11, harmonic = 8, phase_rad = 0.9 }
confidence = 0.97

[[effect]]
effect = \"tip_force\"
joint = 0
[effect.parameters]
force_N = [1, 0.0, -2.5]
";
    let file = parse(&text).unwrap();
    let [cogging, force] = file.effects.as_slice() else { panic!("{:?}", file.effects) };
    assert_eq!((cogging.effect.as_str(), cogging.joint), ("cogging", 3));
    assert_eq!(cogging.number("harmonic"), Some(8.0));
    assert_eq!(cogging.number("mass_kg"), None);
    assert_eq!(force.vector("force_N"), Some([1.0, 0.0, -2.5]));
    assert_eq!(cogging.extra["confidence"].as_float(), Some(0.97));
    let (read, _) = round_trip(&file);
    assert_eq!(read.effects, file.effects);
}

#[test]
fn effects_are_added() {
    let mut file = RobotFile::from_robot(&reference_robot());
    let parameters = toml::Table::from_iter([("mass_kg".to_owned(), toml::Value::from(0.5))]);
    let effect = EffectTable { effect: "payload".into(), parameters, ..EffectTable::default() };
    file.effects.push(effect.clone());
    assert_eq!(round_trip(&file).0.effects, [effect]);
}

#[test]
fn notes_and_standard_errors_are_kept() {
    let text = "note = \"rig 7\"\n".to_owned()
        + &reference_text()
            .replace("[base]", "[base]\nzz1r_standard_error = 0.01")
            .replace("[robot]", "[robot]\nnote = \"A-12\"")
            .replace("joint = 2", "joint = 2\nnote = \"oiled\"")
        + "\n[notes]\ngains = [1.0, 2.0, 3.0]\n\n[[notes.recorded]]\nday = 1\n";
    let file = parse(&text).unwrap();
    let (read, written) = round_trip(&file);
    assert_eq!(read.extra["note"].as_str(), Some("rig 7"));
    assert_eq!(read.extra["notes"]["gains"].as_array().unwrap().len(), 3);
    assert_eq!(read.extra["notes"]["recorded"][0]["day"].as_integer(), Some(1));
    assert_eq!(read.base_extra["zz1r_standard_error"].as_float(), Some(0.01));
    assert_eq!(read.robot.extra["note"].as_str(), Some("A-12"));
    assert_eq!(read.friction[1].extra["note"].as_str(), Some("oiled"));
    assert_eq!(round_trip(&read).1, written);
}

#[test]
fn syntax_errors_have_a_line() {
    assert_says(&parse("format = 1\n[robot\n").unwrap_err(), &["line 2"]);
    assert_says(&parse("format = 1\n").unwrap_err(), &["missing field `robot`"]);
    let wrong = ROBOT.replace("d1_m = 0.56", "d1_m = \"long\"");
    assert_says(&parse(&wrong).unwrap_err(), &["line 4", "string \"long\""]);
    let wrong = PENDULUM.replace("alpha0_V = 0.3561\n", "");
    assert_says(&parse(&wrong).unwrap_err(), &["line 12", "missing field `alpha0_V`"]);
    let wrong = PENDULUM.replace("joint = 3", "joint = -3");
    assert_says(&parse(&wrong).unwrap_err(), &["line 7", "-3"]);
    assert_says(&parse("").unwrap_err(), &["is empty"]);
}

#[test]
fn other_formats_are_refused_in_words() {
    let error = parse(&ROBOT.replace("format = 1", "format = 2")).unwrap_err();
    assert_says(&error, &["line 1", "format 2 is not known here: this version reads format 1"]);
    assert!(error.hint().contains("`format = 1`"), "{}", error.hint());
    let error = parse(&ROBOT.replace("format = 1", "")).unwrap_err();
    assert_says(&error, &["`format = 1` is missing"]);
    let error = parse(&ROBOT.replace("format = 1", "format = \"1\"")).unwrap_err();
    assert_says(&error, &["line 1", "format must be a whole number"]);
}

#[test]
fn base_parameters_are_all_there() {
    let error = parse(&reference_text().replace("mx3r", "note")).unwrap_err();
    assert_says(&error, &["line 12", "mx3r in [base] is missing"]);
    let error = parse(&reference_text().replace("zz1r = ", "zz1r = true # ")).unwrap_err();
    assert_says(&error, &["line 13", "zz1r must be a number"]);
}

#[test]
fn numbers_are_finite_everywhere() {
    for number in ["nan", "-inf", "1e999"] {
        let wrong = ROBOT.replace("a2_m = 0.2", &format!("a2_m = {number}"));
        let expected = format!("`robot.a2_m = {number}` is not a finite number");
        assert_says(&parse(&wrong).unwrap_err(), &["line 6", &expected]);
    }
    let wrong = ROBOT.replace("6.3", "nan");
    assert_says(&parse(&wrong).unwrap_err(), &["line 9", "robot.torque_constant_Nm_per_V"]);
}

#[test]
fn parameters_that_no_robot_can_have_are_named_with_their_line() {
    let text = reference_text();
    let says = |from: &str, to: &str, parts: &[&str]| {
        assert!(text.contains(from), "{text}");
        assert_says(&parse(&text.replace(from, to)).unwrap().robot().unwrap_err(), parts);
    };
    let line = |part: &str| {
        let before = &text[..text.find(part).unwrap()];
        format!("line {}", before.lines().count() + usize::from(before.ends_with('\n')))
    };
    says("a2_m = 0.2", "a2_m = -0.2", &["line 7", "a2_m is -0.2, but must be 0 or more"]);
    says("[12.0, 6.3", "[12.0, -6.3", &["line 10", "torque_constant_Nm_per_V of joint 2 is -6.3"]);
    let at = line("alpha0_V = 0.35\n");
    says("alpha0_V = 0.35\n", "alpha0_V = 0\n", &[&at, "alpha0_V of joint 2 is 0, but must"]);
    let at = line("zz3r = ");
    says("zz3r = ", "zz3r = -", &[&at, "zz3r + ia3 is -0.0714", "positive definite"]);
    let wrong = PENDULUM.replace("= 0.0709", "= 0");
    let error = parse(&wrong).unwrap().pendulum().unwrap_err();
    assert_says(&error, &["line 8", "inertia_kg_m2 of joint 3 is 0, but must be above 0"]);
}

#[test]
fn tables_that_contradict_are_refused() {
    let wrong = ROBOT.replace("[12.0, 6.3, 3.0]", "[12.0, 6.3]");
    assert_says(&parse(&wrong).unwrap_err(), &["line 9", "has 2 values, but must have 3"]);
    let twice = reference_text().replace("joint = 2", "joint = 1");
    assert_says(&parse(&twice).unwrap_err(), &["joint 1 has two [[friction]] tables"]);
    let fourth = reference_text().replace("joint = 2", "joint = 4");
    assert_says(&parse(&fourth).unwrap_err(), &["joint of the friction is 4"]);
    let wrong = PENDULUM.replacen("joint = 3", "joint = 0", 1);
    assert_says(&parse(&wrong).unwrap_err(), &["line 7", "joint of the pendulum is 0"]);
    let wrong = ROBOT.to_owned() + "[[effect]]\neffect = \"delay\"\njoint = 5\n";
    assert_says(&parse(&wrong).unwrap_err(), &["joint of the effect is 5"]);
}

#[test]
fn values_that_were_never_in_a_file_have_errors_too() {
    let error = RobotFile::default().robot().unwrap_err();
    assert!(error.to_string().contains("gravity_m_s2 in [robot] is missing"), "{error}");
    let friction = FrictionTable::of(1, &reference_robot().friction[0]);
    assert_eq!(friction.sigma1_v_s_per_rad, Some(3.6743));
}

#[test]
fn collected_models_are_robots() {
    let models = (1..=6).map(|n| format!("labelled/labelled-{n}/model.toml"));
    for path in
        models.chain(["rig-1/truth.toml".into()]).filter_map(|name| test_support::data(&name))
    {
        let file = RobotFile::read(path).unwrap();
        assert_eq!(round_trip(&file).0.robot().unwrap(), file.robot().unwrap());
    }
    for path in
        ["rig-1/robot.toml", "dfki-pendulum/robot.toml"].into_iter().filter_map(test_support::data)
    {
        RobotFile::read(path).unwrap();
    }
}

#[test]
fn what_motors_bear_is_two_figures_a_motor_or_none() {
    let with = |lines: &str| parse(&ROBOT.replacen("[robot]", &format!("[robot]\n{lines}"), 1));
    let both = "motor_continuous_V = [3, 3, 2]\nmotor_time_constant_s = [60, 60, 30]";
    let file = with(both).unwrap();
    assert_eq!(file.robot.motor_continuous_v, Some(vec![3.0, 3.0, 2.0]));
    assert_eq!(file.robot.motor_time_constant_s, Some(vec![60.0, 60.0, 30.0]));
    for wrong in [
        "motor_continuous_V = [3, 3, 2]",
        "motor_time_constant_s = [60, 60, 30]",
        "motor_continuous_V = [3, 3]\nmotor_time_constant_s = [60, 60, 30]",
        "motor_continuous_V = [3, 3, 0]\nmotor_time_constant_s = [60, 60, 30]",
    ] {
        let message = with(wrong).unwrap_err().to_string();
        assert!(message.contains("motor_"), "{wrong}: {message}");
    }
}
