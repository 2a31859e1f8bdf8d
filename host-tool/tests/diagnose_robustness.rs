//! Logs that are not as a diagnosis would like them: each ends in a message that names the
//! log, the place and the cure, or in the right verdict with a remark.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use diagnosis::{self, Criteria, Diagnosis, DiagnosisError, Verdict};
use files::{RobotFile, Role};
use model::Robot;
use model::reference_robot::reference_robot;
use recordings::{Campaign, Trace};
use rig::effects::Catalogue;
use rig::plan::{driven_noise, excitation, slow};
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

const COUNTS_PER_TURN: f64 = 655_360.0;

/// Short logs of a robot with cogging on joint 3.
fn recorded() -> Vec<Trace> {
    let rig = Rig::new(reference_robot());
    let held_out = excitation(5, 4.0).with_role(Role::Holdout);
    let plans = [excitation(3, 6.0), slow(4.0), driven_noise(3.0, 4), held_out];
    plans.iter().zip(1..).map(|(plan, seed)| trace(&rig, plan, seed)).collect()
}

fn trace(rig: &Rig, plan: &Plan, seed: u64) -> Trace {
    let block = plan.block(rig);
    let settings = Settings { seed, ..Settings::default() };
    let definition = Catalogue::standard().by_name("cogging").unwrap();
    let effects = vec![definition.with(3, &[0.11, 8.0, 0.9]).unwrap()];
    let robot =
        SimulatedRobot::with_effects(reference_robot(), effects, start_of(&block), &settings);
    let mut board = InProcess::default();
    let recording = record_robot(&mut board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
    Trace::of_log(recording.log, plan.entry("csv"), COUNTS_PER_TURN)
}

/// These logs, recorded once.
fn logs() -> Vec<Trace> {
    static LOGS: OnceLock<Vec<Trace>> = OnceLock::new();
    LOGS.get_or_init(recorded).clone()
}

fn file(robot: &Robot<f64>) -> RobotFile {
    let mut file = RobotFile::from_robot(robot);
    file.robot.encoder_counts_per_rev = Some(COUNTS_PER_TURN);
    file.robot.command_limit_v = Some(10.0);
    file.robot.command_bits = Some(16);
    file
}

fn diagnose_with(robot_file: RobotFile, traces: Vec<Trace>) -> Result<Diagnosis, DiagnosisError> {
    let campaign = Campaign::new(robot_file, Some(COUNTS_PER_TURN), traces).unwrap();
    let found =
        diagnosis::diagnose(&campaign, &Catalogue::standard(), &Criteria::default(), &|_| ());
    if let Ok(diagnosis) = &found {
        eprintln!("{}", host_tool::commands::diagnose::in_words(diagnosis));
    }
    found
}

fn diagnose(traces: Vec<Trace>) -> Result<Diagnosis, DiagnosisError> {
    diagnose_with(file(&reference_robot()), traces)
}

#[track_caller]
fn assert_cogging(diagnosis: &Diagnosis) {
    let report = &diagnosis.report;
    let named: Vec<(&str, u8)> = report.causes.iter().map(|c| (&c.effect[..], c.joint)).collect();
    assert_eq!((report.verdict, &named[..]), (Verdict::Effect, &[("cogging", 3)][..]));
}

#[track_caller]
fn assert_remark(diagnosis: &Diagnosis, words: &[&str]) {
    let remarks = &diagnosis.report.remarks;
    let holds = |remark: &String| words.iter().all(|word| remark.contains(word));
    assert!(remarks.iter().any(holds), "no {words:?} in {remarks:#?}");
}

#[track_caller]
fn assert_refused(found: Result<Diagnosis, DiagnosisError>, words: &[&str]) {
    let message = found.expect_err("it was diagnosed").to_string();
    eprintln!("{message}");
    for word in words {
        assert!(message.contains(word), "no `{word}` in: {message}");
    }
}

#[track_caller]
fn assert_another_robot(diagnosis: &Diagnosis) {
    assert_eq!(diagnosis.report.verdict, Verdict::Unknown);
    assert_remark(diagnosis, &["the logs do not fit this model"]);
}

/// Logs whose rows are changed one by one.
fn changed(change: impl Fn(&mut Trace)) -> Vec<Trace> {
    let mut traces = logs();
    traces.iter_mut().for_each(change);
    traces
}

#[test]
fn without_a_log_held_out_parts_are() {
    let train = logs().into_iter().filter(|trace| trace.role == Role::Train).collect();
    let diagnosis = diagnose(train).unwrap();
    assert_cogging(&diagnosis);
    assert_remark(&diagnosis, &["no log is held out", "30 %"]);
}

#[test]
fn one_log_is_enough() {
    let diagnosis = diagnose(logs()[..1].to_vec()).unwrap();
    assert_cogging(&diagnosis);
    assert_remark(&diagnosis, &["no log is held out"]);
}

#[test]
fn a_short_log_alone_is_refused() {
    let mut short = logs()[..1].to_vec();
    cut(&mut short[0], 3000);
    assert_refused(diagnose(short), &["record one of 6 s or more"]);
}

fn cut(trace: &mut Trace, count: usize) {
    trace.time_s.truncate(count);
    for joint in &mut trace.joints {
        joint.q_rad.truncate(count);
        joint.command_v.truncate(count);
        joint.reference_rad = None;
    }
}

#[test]
fn no_log_at_all_is_refused() {
    assert_refused(diagnose(Vec::new()), &["lists no log", "dataset.toml"]);
}

#[test]
fn moving_arms_are_not_judged_by_the_model_of_one_joint() {
    let mut robot_file = file(&reference_robot());
    let model = r#"{"joint":3,"inertia_kg_m2":0.0714,"gravity_torque_Nm":1.97}"#;
    robot_file.base = None;
    robot_file.pendulum = Some(serde_json::from_str(model).unwrap());
    robot_file.friction.retain(|table| table.joint == 3);
    let found = diagnose_with(robot_file, logs());
    assert_refused(found, &["excitation-3.csv", "joint 1 moves", "stand still"]);
}

#[test]
fn logs_of_one_joint_are_not_judged_by_the_model_of_three() {
    let one = changed(|trace| trace.joints.retain(|joint| joint.number == 3));
    assert_refused(
        diagnose(one),
        &["excitation-3.csv", "q1 and u1 are not in the log", "3 joints"],
    );
}

#[test]
fn degrees_are_refused() {
    let degrees = changed(|trace| {
        let joints = trace.joints.iter_mut();
        joints.for_each(|joint| joint.q_rad.iter_mut().for_each(|q| *q = q.to_degrees()));
    });
    assert_refused(diagnose(degrees), &["excitation-3.csv", "joint 1", "radians or counts"]);
}

#[test]
fn another_count_per_turn_is_another_robot() {
    let stretched = changed(|trace| {
        let joints = trace.joints.iter_mut();
        joints.for_each(|joint| joint.q_rad.iter_mut().for_each(|q| *q *= 1.25));
    });
    assert_another_robot(&diagnose(stretched).unwrap());
}

#[test]
fn millivolts_are_refused() {
    let millivolts = changed(|trace| {
        let joints = trace.joints.iter_mut();
        joints.for_each(|joint| joint.command_v.iter_mut().for_each(|u| *u *= 1e3));
    });
    assert_refused(diagnose(millivolts), &["excitation-3.csv", "u1_V", "in volts?"]);
}

#[test]
fn a_longer_upper_arm_is_another_robot() {
    let mut robot = reference_robot::<f64>();
    robot.geometry.a2_m *= 2.0;
    assert_another_robot(&diagnose_with(file(&robot), logs()).unwrap());
}

#[test]
fn swapped_lengths_are_another_robot() {
    let mut robot = reference_robot::<f64>();
    std::mem::swap(&mut robot.geometry.a2_m, &mut robot.geometry.a3_m);
    assert_another_robot(&diagnose_with(file(&robot), logs()).unwrap());
}

#[test]
fn swapped_joints_are_another_robot() {
    let swapped = changed(|trace| {
        let [_, second, third] = &mut trace.joints[..] else { panic!("three joints") };
        std::mem::swap(second, third);
        (second.number, third.number) = (2, 3);
    });
    assert_another_robot(&diagnose(swapped).unwrap());
}

#[test]
fn a_tenth_of_the_rows_may_be_missing() {
    let gappy = changed(|trace| {
        let kept = |k: usize| (k as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32 & 0xff > 25;
        keep(trace, kept);
    });
    let diagnosis = diagnose(gappy).unwrap();
    assert_cogging(&diagnosis);
    assert_remark(&diagnosis, &["% of the samples are missing"]);
}

fn keep(trace: &mut Trace, kept: impl Fn(usize) -> bool) {
    let of = |column: &mut Vec<f64>| {
        let mut k = 0;
        column.retain(|_| {
            k += 1;
            kept(k - 1)
        });
    };
    of(&mut trace.time_s);
    for joint in &mut trace.joints {
        of(&mut joint.q_rad);
        of(&mut joint.command_v);
        joint.reference_rad.iter_mut().for_each(of);
    }
}

#[test]
fn an_encoder_may_wrap() {
    let wrapped = changed(|trace| {
        let joints = trace.joints.iter_mut();
        joints.for_each(|joint| joint.q_rad.iter_mut().for_each(|q| *q = q.rem_euclid(TAU)));
    });
    let diagnosis = diagnose(wrapped).unwrap();
    assert_cogging(&diagnosis);
    assert_remark(&diagnosis, &["wraps", "times"]);
}

#[test]
fn a_stuck_encoder_costs_its_log() {
    let mut traces = logs();
    let stuck = &mut traces[0].joints[1].q_rad;
    let moving = (3000..).find(|&k| (stuck[k] - stuck[k - 10]).abs() > 0.01).unwrap();
    let value = stuck[moving];
    stuck[moving..].fill(value);
    let diagnosis = diagnose(traces).unwrap();
    assert_cogging(&diagnosis);
    assert_remark(&diagnosis, &["left out", "excitation-3.csv", "q2", "stuck"]);
}

#[test]
fn all_encoders_stuck_are_refused() {
    let stuck = changed(|trace| {
        let value = trace.joints[2].q_rad[0];
        trace.joints[2].q_rad.fill(value);
    });
    assert_refused(diagnose(stuck), &["q3", "stuck"]);
}

#[test]
fn commands_at_the_limit_cost_their_log() {
    let mut traces = logs();
    for u in &mut traces[0].joints[2].command_v {
        *u = if *u > 0.0 { 10.0 } else { -10.0 };
    }
    let diagnosis = diagnose(traces).unwrap();
    assert_cogging(&diagnosis);
    assert_remark(&diagnosis, &["left out", "excitation-3.csv", "limit", "less motion"]);
}

/// Runs `rrr diagnose` on a data set of one log with this text.
#[track_caller]
fn assert_text_is_refused(text: &str, words: &[&str]) {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    file(&reference_robot()).write(path("model.toml")).unwrap();
    let list = "format = 1\n[[log]]\nfile = \"a.csv\"\nexperiment = \"task\"\nrole = \"train\"\n";
    std::fs::write(path("dataset.toml"), list).unwrap();
    std::fs::write(path("a.csv"), text).unwrap();
    let mut rrr = assert_cmd::Command::cargo_bin("rrr").unwrap();
    let run = rrr.current_dir(directory.path()).args(["diagnose", ".", "--model", "model.toml"]);
    let assert = run.args(["--out", "out"]).assert().code(2).stdout("");
    let message = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    eprintln!("{message}");
    for word in words {
        assert!(message.contains(word), "no `{word}` in: {message}");
    }
    assert!(!path("out").exists());
}

const HEADER: &str = "t_s,q1_rad,u1_V,q2_rad,u2_V,q3_rad,u3_V\n";

#[test]
fn a_number_that_is_none_is_refused() {
    let text = format!("{HEADER}0,0,0,0,0,0,0\n0.001,0,0,NaN,0,0,0\n");
    assert_text_is_refused(&text, &["a.csv", "line 3", "q2_rad", "NaN", "hint: "]);
}

#[test]
fn empty_logs_are_refused() {
    assert_text_is_refused("", &["a.csv", "hint: "]);
    assert_text_is_refused(HEADER, &["a.csv", "hint: "]);
    assert_text_is_refused(&format!("{HEADER}0,0,0,0,0,0,0\n"), &["a.csv", "hint: "]);
}

/// Evenly distributed over -1 to 1: Knuth's linear congruential generator.
fn even_random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

#[test]
fn positions_of_a_clock_that_jitters_are_noisy_by_speed() {
    const JITTER_S: f64 = 2e-4;
    let traces = changed(|trace| {
        let mut random = even_random(trace.time_s.len() as u64);
        for k in 1..trace.time_s.len() - 1 {
            let early_s = JITTER_S * random();
            for joint in &mut trace.joints {
                let speed = (joint.q_rad[k + 1] - joint.q_rad[k - 1])
                    / (trace.time_s[k + 1] - trace.time_s[k - 1]);
                joint.q_rad[k] += speed * early_s;
            }
        }
    });
    let report = diagnose(traces).unwrap().report;
    let named: Vec<(&str, u8)> = report.causes.iter().map(|c| (&c.effect[..], c.joint)).collect();
    assert_eq!(named, [("cogging", 3)]);
    let [with, floor] = [report.gap.with_effects_v[1], report.gap.noise_floor_v[1]];
    assert!(floor > 4e-3 && with < 2.0 * floor, "{with} of {floor} V");
}

#[test]
fn driven_noise_with_lost_samples_is_used() {
    let traces = changed(|trace| {
        let mut random = even_random(7);
        let kept: Vec<bool> = trace.time_s.iter().map(|_| random() > -0.98).collect();
        let keep = |signal: &mut Vec<f64>| {
            let mut at = kept.iter();
            signal.retain(|_| *at.next().unwrap());
        };
        keep(&mut trace.time_s);
        for joint in &mut trace.joints {
            keep(&mut joint.q_rad);
            keep(&mut joint.command_v);
            joint.reference_rad = None;
        }
    });
    let diagnosis = diagnose(traces).unwrap();
    assert_cogging(&diagnosis);
    assert_eq!(diagnosis.report.data.fit.len(), 3);
}
