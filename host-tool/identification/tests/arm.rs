//! Identification of arms of any kind from simulated logs.

use files::arm_file::{ArmFriction, Encoder};
use files::example_arms::{six_axes, two_link_pendulum};
use files::{ArmFile, Dataset, EffectTable};
use identification::arm::{CommandTime, IdentifiedArm, Settings, identify};
use recordings::ArmCampaign;

mod arm_simulator;
use arm_simulator::{Recorder, command_error, forget_links, record, write_dataset};

const AXIS: &str = r#"
format = 2
[robot]
name = "linear axis"
[[joint]]
kind = "prismatic"
axis = [1.0, 0.0, 0.0]
mass_kg = 95.0
com_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [1.0, 0.0, 0.0, 1.0, 0.0, 1.0]
drive = { kind = "current", torque_constant_N_per_A = 35.0 }
encoder = { counts_per_m = 1e6 }
friction = { alpha0_V = 0.6, alpha2_V_s_per_m = 5.8 }
"#;

fn parse(text: &str) -> ArmFile {
    ArmFile::parse("robot.toml", text.as_bytes().to_vec()).unwrap()
}

/// The pendulum with encoders of 14 bits.
fn pendulum() -> ArmFile {
    let mut arm = two_link_pendulum();
    for joint in &mut arm.joints {
        joint.encoder = joint.encoder.map(|encoder| Encoder { counts: 16384.0, ..encoder });
    }
    arm
}

fn identified(truth: &ArmFile, robot: &ArmFile, recorders: &[Recorder]) -> IdentifiedArm {
    let directory = tempfile::tempdir().unwrap();
    let logs: Vec<String> = recorders.iter().map(|recorder| record(truth, recorder)).collect();
    write_dataset(directory.path(), &logs);
    let dataset = Dataset::read(directory.path()).unwrap();
    let campaign = ArmCampaign::read(&dataset, robot.clone()).unwrap();
    identify(&campaign, &Settings::default()).unwrap()
}

fn of_pendulum() -> Recorder {
    Recorder {
        loop_hz: 500,
        every: 1,
        duration_s: 30.0,
        amplitude: vec![1.2, 1.5],
        middle: vec![-1.5, 0.0],
        fastest_hz: 1.2,
        stiffness: vec![40.0, 12.0],
        noise: 0.01,
        seed: 1,
    }
}

fn of_six_joints() -> Recorder {
    Recorder {
        loop_hz: 500,
        every: 1,
        duration_s: 40.0,
        amplitude: vec![1.0, 0.7, 0.8, 1.2, 1.2, 1.5],
        middle: vec![0.0, 0.4, 0.3, 0.0, 0.5, 0.0],
        fastest_hz: 0.8,
        stiffness: vec![4000.0, 4000.0, 2000.0, 600.0, 500.0, 300.0],
        noise: 0.002,
        seed: 1,
    }
}

fn other(recorder: &Recorder, seed: u128) -> Recorder {
    Recorder { seed, duration_s: 20.0, ..recorder.clone() }
}

#[track_caller]
fn assert_within(truth: &ArmFile, found: &IdentifiedArm, recorder: &Recorder, most: f64) {
    let errors = command_error(truth, &found.model, &other(recorder, 77));
    println!("{errors:.4?} {:?} {:?}", found.command_time, found.condition_number);
    println!("{:.4?}\n{:.3?}\n{:#?}", found.left, found.bands, found.remarks);
    for base in &found.base {
        println!("{:60} {:10.5} +- {:.5}", base.name, base.value, base.standard_error);
    }
    assert!(errors.iter().all(|error| *error < most), "{errors:?}");
    for joint in found.model.chain().unwrap().joints() {
        assert!(joint.body.is_physical(), "{joint:?}");
    }
    assert!(found.model.remarks().is_empty());
}

#[test]
fn a_pendulum_of_two_unknown_links_is_found() {
    let truth = pendulum();
    let mut robot = truth.clone();
    forget_links(&mut robot);
    let recorder = of_pendulum();
    let found = identified(&truth, &robot, &[recorder.clone(), other(&recorder, 2)]);
    assert_eq!(found.command_time, CommandTime::Held);
    assert_within(&truth, &found, &recorder, 0.01);
    assert!(found.is_held_out && found.condition_number.is_some());
    let coulomb = found.model.joints[0].friction.unwrap().alpha0.unwrap();
    assert!((coulomb - 0.2).abs() < 0.01, "{coulomb}");
}

#[test]
fn every_tenth_row_of_it_is_enough() {
    let truth = pendulum();
    let mut robot = truth.clone();
    forget_links(&mut robot);
    let recorder = Recorder { every: 10, duration_s: 60.0, fastest_hz: 0.8, ..of_pendulum() };
    let found = identified(&truth, &robot, &[recorder.clone(), other(&recorder, 2)]);
    assert_eq!(found.command_time, CommandTime::Sampled);
    assert_within(&truth, &found, &recorder, 0.01);
}

#[test]
fn a_linear_axis_is_found_and_its_unknown_rotor_not_told_from_its_mass() {
    let truth = parse(AXIS);
    let mut robot = truth.clone();
    forget_links(&mut robot);
    let recorder = Recorder {
        loop_hz: 1000,
        every: 1,
        duration_s: 20.0,
        amplitude: vec![0.15],
        middle: vec![0.0],
        fastest_hz: 1.5,
        stiffness: vec![40_000.0],
        noise: 0.001,
        seed: 1,
    };
    let found = identified(&truth, &robot, &[recorder.clone(), other(&recorder, 2)]);
    assert_within(&truth, &found, &recorder, 0.01);
    let joint = &found.model.joints[0];
    assert_eq!(joint.armature, None);
    assert!((joint.link.mass_kg.unwrap() - 95.0).abs() < 0.1, "{:?}", joint.link);
    assert!(joint.standard_error("mass_kg").unwrap()[0] < 1.0);
}

#[test]
fn six_joints_with_gears_and_wrong_drawings_are_found() {
    let truth = six_axes();
    let mut robot = truth.clone();
    for (k, joint) in robot.joints.iter_mut().enumerate() {
        let factor = if k % 2 == 0 { 1.12 } else { 0.9 };
        joint.link.mass_kg = joint.link.mass_kg.map(|mass| factor * mass);
        joint.link.com_m = joint.link.com_m.map(|centre| centre.map(|x| 1.1 * x));
        (joint.armature, joint.friction) = (None, None);
    }
    let recorder = of_six_joints();
    let found = identified(&truth, &robot, &[recorder.clone(), other(&recorder, 2)]);
    assert_within(&truth, &found, &recorder, 0.01);
    // The first link's mass has no effect on any torque.
    let [given, kept] = [&robot, &found.model].map(|arm| arm.joints[0].link.mass_kg.unwrap());
    assert!((given - kept).abs() < 1e-3 * given, "{given} {kept}");
    let rotor = found.model.joints[2].armature.unwrap();
    assert!((rotor - 0.6).abs() < 0.006, "{rotor}");
}

#[test]
fn six_joints_of_which_only_the_geometry_is_known_are_found() {
    let truth = six_axes();
    let mut robot = truth.clone();
    forget_links(&mut robot);
    let recorder = of_six_joints();
    let begin = std::time::Instant::now();
    let found = identified(&truth, &robot, &[recorder.clone(), other(&recorder, 2)]);
    println!("recorded and identified in {:?}", begin.elapsed());
    assert_within(&truth, &found, &recorder, 0.01);
}

#[test]
fn logs_of_20_hz_and_5_khz_serve_together() {
    let truth = pendulum();
    let mut robot = truth.clone();
    forget_links(&mut robot);
    let slow = Recorder {
        loop_hz: 1000,
        every: 50,
        duration_s: 90.0,
        fastest_hz: 0.5,
        noise: 0.002,
        ..of_pendulum()
    };
    let fast = Recorder { loop_hz: 5000, duration_s: 12.0, seed: 3, ..of_pendulum() };
    let found = identified(&truth, &robot, &[slow.clone(), fast.clone(), other(&slow, 2)]);
    assert_within(&truth, &found, &fast, 0.01);
    let alone = identified(&truth, &robot, &[slow.clone(), other(&slow, 2)]);
    assert_within(&truth, &alone, &slow, 0.02);
}

#[test]
fn commands_beyond_the_drive_s_limit_do_no_harm() {
    let mut truth = pendulum();
    truth.joints[0].drive.as_mut().unwrap().limit = Some(2.5);
    let mut robot = truth.clone();
    forget_links(&mut robot);
    let recorder = of_pendulum();
    let log = record(&truth, &recorder);
    let beyond = log.lines().skip(1).filter(|line| {
        let u: f64 = line.split(',').nth(2).unwrap().parse().unwrap();
        u.abs() > 2.5
    });
    assert!(beyond.count() > 100);
    let found = identified(&truth, &robot, &[recorder.clone(), other(&recorder, 2)]);
    assert_within(&truth, &found, &recorder, 0.01);
}

/// A geared arm whose friction has a peak near rest, grows with the load on one joint, and on another less than with
/// the velocity.
#[test]
fn friction_of_gears_is_found_with_what_it_grows_with() {
    let effect = |effect: &str, joint: u8, parameter: &str, value: f64| EffectTable {
        effect: effect.into(),
        joint,
        parameters: [(parameter.to_owned(), value.into())].into_iter().collect(),
        extra: Default::default(),
    };
    let mut truth = pendulum();
    let given = truth.joints[0].friction.unwrap();
    truth.joints[0].friction =
        Some(ArmFriction { alpha1: Some(0.1), stribeck_velocity: Some(0.1), ..given });
    truth.effects = vec![
        effect("load_friction", 1, "coefficient_V_per_Nm", 0.03),
        effect("quadratic_drag", 2, "coefficient_V_s2_per_rad2", -0.002),
    ];
    let mut robot = truth.clone();
    forget_links(&mut robot);
    // What a model of before says of such friction is found anew, or gone.
    robot.effects = vec![
        effect("quadratic_drag", 1, "coefficient_V_s2_per_rad2", 0.05),
        effect("load_friction", 1, "coefficient_V_per_Nm", 0.3),
    ];
    let recorder = Recorder { noise: 0.002, ..of_pendulum() };
    let slow = Recorder { fastest_hz: 0.15, seed: 5, ..recorder.clone() };
    let found = identified(&truth, &robot, &[recorder.clone(), slow, other(&recorder, 2)]);
    println!("{:#?} {:#?}", found.model.effects, found.friction_terms);
    assert_within(&truth, &found, &recorder, 0.01);
    let terms = &found.friction_terms;
    let growth = terms[0].load_friction.unwrap().value;
    assert!((growth - 0.03).abs() < 0.003, "{growth}");
    let peak = found.model.joints[0].friction.unwrap().peak().unwrap();
    assert!((peak[0] - 0.1).abs() < 0.03, "{peak:?}");
    let square = terms[1].quadratic_drag.unwrap().value;
    assert!((square + 0.002).abs() < 0.0005, "{square}");
    assert_eq!((terms[1].load_friction, terms[1].stribeck_peak), (None, None));
    assert!(terms.iter().all(|terms| terms.constant.is_none()));
    assert_eq!(found.model.effects.len(), 2);
    // Sums of links' values are known, the links are not; the file tells both.
    let told = parse(&found.model.to_toml().unwrap()).base_errors;
    let of_base = found.base.iter().map(|base| (&base.name, base.standard_error));
    assert!(told.iter().map(|told| (&told.name, told.standard_error)).eq(of_base));
    assert!(told[0].standard_error < 0.001 && told[0].name.contains("0.3 joint[2].mass_kg"));
}
