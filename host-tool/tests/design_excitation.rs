//! The designed motion: its condition number, its limits, and what a recording of it keeps.

use std::path::Path;

use assert_cmd::Command;
use files::excitation_file::ExcitationFile;
use files::{JointLog, Log, RobotFile};
use firmware::Mode;
use firmware::reference::{FadeIn, FourierSeries, Motion};
use identification::excitation_design::condition::stacked_regressor;
use identification::excitation_design::{
    Demand, Effort, Limits, Series, Settings, State, condition_number, design,
};
use model::reference_robot::reference_robot;
use model::{BaseParameters, Robot};
use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;
use rig::Rig;
use rig::designed_excitation::DESIGNED_EXCITATION;
use rig::plan::excitation;
use simulation::board::InProcess;
use simulation::{self, record};

mod common;
use common::directory;

/// Samples of Phi are 10 ms apart, section 4.3.
const TICKS_PER_SAMPLE: usize = 10;

/// The campaign's excitation as the host computes it.
fn designed() -> Series {
    let wide = |row: [f32; 5]| row.map(f64::from);
    let FadeIn { duration_s } = DESIGNED_EXCITATION[0].fade_in;
    Series {
        centre_rad: DESIGNED_EXCITATION.map(|joint| f64::from(joint.centre_rad)),
        period_s: f64::from(DESIGNED_EXCITATION[0].period_s),
        fade_in_s: f64::from(duration_s),
        sine_rad: DESIGNED_EXCITATION.map(|joint| wide(joint.sine_rad)),
        cosine_rad: DESIGNED_EXCITATION.map(|joint| wide(joint.cosine_rad)),
    }
}

fn j_k(robot: &Robot<f64>, states: impl Iterator<Item = State>) -> f64 {
    let k_t = &robot.torque_constant_nm_per_v;
    condition_number(&stacked_regressor(&robot.geometry, k_t, states))
}

fn demand(robot: &Robot<f64>) -> Demand {
    let series = designed();
    Demand::of(robot, series.beginning(1e-3).chain(series.period(10_000)))
}

/// Robots whose values are each up to 15 % off the reference robot's.
fn other_robots() -> impl Iterator<Item = Robot<f64>> {
    let mut random = Pcg64Mcg::new(77);
    let factor = Uniform::new(0.85, 1.15).unwrap();
    let candidates = std::iter::repeat_with(move || {
        let mut off = |value: &mut f64| *value *= factor.sample(&mut random);
        let mut robot = reference_robot::<f64>();
        let mut base = robot.base.to_array();
        base.iter_mut().for_each(&mut off);
        robot.base = BaseParameters::from_array(base);
        robot.torque_constant_nm_per_v.iter_mut().for_each(&mut off);
        off(&mut robot.geometry.a2_m);
        for friction in &mut robot.friction {
            off(&mut friction.alpha0_v);
            off(&mut friction.alpha1_v);
            off(&mut friction.alpha2_v_s_per_rad);
            off(&mut friction.sigma0_v_per_rad);
            off(&mut friction.sigma1_v_s_per_rad);
        }
        robot
    });
    candidates.filter_map(|robot| robot.checked().ok())
}

/// The excitation recorded through the firmware, board and robot of one model.
fn recorded(robot: Robot<f64>) -> Log {
    let rig = Rig::new(robot);
    let plan = excitation(1, 21.0).with_mode(Mode::Pd);
    let settings = simulation::Settings::default();
    let ticks = plan.ticks(&rig);
    let mut board = InProcess::default();
    record(&mut board, &plan.block(&rig), &robot, &settings, ticks, &mut |_| {}).unwrap().log
}

fn largest_command(log: &Log) -> f64 {
    let commands = log.joints.iter().flat_map(|joint| &joint.command_v);
    commands.fold(0.0, |largest, command_v| command_v.abs().max(largest))
}

/// A mean over 21 samples, three times: zero phase, -3 dB at 12 Hz.
fn smoothed(signal: &[f64]) -> Vec<f64> {
    const HALF: usize = 10;
    let once = |signal: Vec<f64>| -> Vec<f64> {
        signal.windows(2 * HALF + 1).map(|w| w.iter().sum::<f64>() / w.len() as f64).collect()
    };
    (0..3).fold(signal.to_vec(), |signal, _| once(signal))
}

/// Angle, velocity and acceleration of a joint by smoothing and central differences.
fn filtered(joint: &JointLog) -> Vec<[f64; 3]> {
    const PERIOD_S: f64 = 1e-3;
    let q = smoothed(&joint.position_rad(655_360.0));
    let at = |w: &[f64]| {
        let velocity = (w[2] - w[0]) / (2.0 * PERIOD_S);
        [w[1], velocity, (w[2] - 2.0 * w[1] + w[0]) / (PERIOD_S * PERIOD_S)]
    };
    q.windows(3).map(at).collect()
}

/// The states of one recorded period, every 10 ms, from the second period.
fn filtered_states(log: &Log) -> Vec<State> {
    let joints: Vec<Vec<[f64; 3]>> = log.joints.iter().map(filtered).collect();
    let state = |k: usize| {
        let each = |quantity: usize| [0, 1, 2].map(|i: usize| joints[i][k][quantity]);
        State { q_rad: each(0), qd_rad_per_s: each(1), qdd_rad_per_s2: each(2) }
    };
    (10_000..20_000).step_by(TICKS_PER_SAMPLE).map(state).collect()
}

fn peak_velocities(states: &[State]) -> [f64; 3] {
    [0, 1, 2].map(|i| states.iter().map(|s| s.qd_rad_per_s[i].abs()).fold(0.0, f64::max))
}

#[test]
fn the_designed_motion_excites_the_reference_robot_well() {
    let robot = reference_robot();
    let found = j_k(&robot, designed().period(1000));
    eprintln!("designed J_k {found:.4}, {:.2?}", demand(&robot));
    assert!((found - 3.571).abs() < 0.001, "{found}");
}

#[test]
fn the_designed_motion_keeps_the_limits() {
    let of_reference = demand(&reference_robot());
    assert!(of_reference.keeps(&Limits::of_paper(10.0)), "{of_reference:?}");
    let largest_v = of_reference.command_v.into_iter().fold(0.0, f64::max);
    assert!((5.25..5.4).contains(&largest_v), "document the peak of {largest_v} V");
    for robot in other_robots().take(50) {
        let demand = demand(&robot);
        assert!(demand.keeps(&Limits::of_paper(10.0)), "{demand:?}");
    }
}

#[test]
fn the_recorded_motion_excites_as_designed() {
    let robot = reference_robot();
    let log = recorded(robot);
    let states = filtered_states(&log);
    let found = j_k(&robot, states.iter().copied());
    let largest_v = largest_command(&log);
    let peaks = peak_velocities(&states);
    eprintln!("recorded J_k {found:.4}, largest command {largest_v:.2} V, peaks {peaks:.2?}");
    assert!((found - 3.605).abs() < 0.01, "{found}");
    assert!(largest_v < 9.0, "{largest_v} V");
    let limits = Limits::of_paper(10.0).velocity_rad_per_s;
    assert!((0..3).all(|i| peaks[i] <= limits[i]), "{peaks:?}");
}

#[test]
fn robots_15_percent_off_are_excited_well_too() {
    let mut worst = (0.0_f64, 0.0_f64);
    for robot in other_robots().take(10) {
        let log = recorded(robot);
        let found = j_k(&robot, filtered_states(&log).into_iter());
        worst = (worst.0.max(found), worst.1.max(largest_command(&log)));
    }
    eprintln!("over robots 15 % off: J_k below {:.2}, commands below {:.2} V", worst.0, worst.1);
    assert!(worst.0 < 4.5, "{worst:?}");
    assert!(worst.1 < 7.0, "{worst:?}");
}

#[test]
fn a_search_is_repeated_by_its_seed() {
    let robot = reference_robot();
    let effort = Effort { starts: 2, generations: 20, ..Effort::default() };
    let settings = Settings { effort, ..Settings::of_paper(10.0) };
    let first = design(&robot, &settings, &|_| {});
    assert_eq!(first, design(&robot, &settings, &|_| {}));
    assert!(first.keeps_limits && first.condition_number < 20.0, "{first:?}");
    let other = design(&robot, &Settings { seed: 2, ..settings }, &|_| {});
    assert!(first.series != other.series);
}

#[test]
fn a_short_search_is_below_4() {
    let effort = Effort { starts: 2, generations: 300, ..Effort::default() };
    let settings = Settings { effort, ..Settings::of_paper(10.0) };
    let found = design(&reference_robot(), &settings, &|_| {});
    assert!(found.keeps_limits && found.condition_number < 4.0, "{found:?}");
}

#[test]
fn weak_amplifiers_get_a_slower_motion() {
    let effort = Effort { starts: 1, generations: 60, ..Effort::default() };
    let settings = Settings { effort, ..Settings::of_paper(4.0) };
    let found = design(&reference_robot(), &settings, &|_| {});
    assert!(found.keeps_limits, "{found:?}");
    assert!(found.demand.command_v.iter().all(|&peak_v| peak_v <= 3.6001), "{found:?}");
    assert!(found.condition_number.is_finite());
}

fn rrr(directory: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("rrr").unwrap().current_dir(directory).args(arguments).assert()
}

fn with_model(change: impl FnOnce(&mut RobotFile)) -> tempfile::TempDir {
    let directory = directory();
    let mut file = RobotFile::from_robot(&reference_robot());
    change(&mut file);
    file.write(directory.path().join("model.toml")).unwrap();
    directory
}

const DESIGN: [&str; 7] =
    ["design-excitation", "--model", "model.toml", "--out", "excitation.toml", "--starts", "1"];

fn stderr(assert: &assert_cmd::assert::Assert) -> String {
    String::from_utf8(assert.get_output().stderr.clone()).unwrap()
}

#[test]
fn the_command_writes_what_simulate_plays() {
    let directory = with_model(|_| {});
    let path = directory.path();
    let assert = rrr(path, &[&DESIGN[..], &["--seconds", "0.3"]].concat()).success();
    let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    assert!(text.contains("J_k = ") && text.contains("of  6.28 rad/s"), "{text}");
    let file = ExcitationFile::read(path.join("excitation.toml")).unwrap();
    let arguments = "simulate --model model.toml --dataset excitation --out run --excitation";
    let arguments: Vec<&str> = arguments.split(' ').chain(["excitation.toml"]).collect();
    rrr(path, &arguments).success();
    let log = Log::read(path.join("run/excitation.csv.gz")).unwrap();
    let reference = log.joints[1].reference_rad.as_ref().unwrap();
    let Motion::Fourier(FourierSeries { centre_rad, cosine_rad, .. }) = &file.motion()[1] else {
        panic!("not a Fourier series");
    };
    // After whole periods the sines are zero.
    let expected = centre_rad + cosine_rad.iter().sum::<f32>();
    assert!((reference[10_000] - f64::from(expected)).abs() < 1e-4, "{}", reference[10_000]);
}

#[test]
fn a_robot_that_cannot_overcome_friction_is_refused() {
    let directory = with_model(|file| file.robot.command_limit_v = Some(0.3));
    let arguments = [&DESIGN[..], &["--seconds", "0.2"]].concat();
    let text = stderr(&rrr(directory.path(), &arguments).code(2));
    assert!(text.contains("no motion found within 0.27 V"), "{text}");
    assert!(!directory.path().join("excitation.toml").exists());
}

#[test]
fn bad_files_and_numbers_are_named() {
    let directory = with_model(|_| {});
    let path = directory.path();
    let text = stderr(&rrr(path, &[&DESIGN[..], &["--seconds=-1"]].concat()).code(2));
    assert!(text.contains("--seconds -1: no time"), "{text}");
    let joint = |number: u8, period_s: &str| {
        format!(
            "[[joint]]\njoint = {number}\ncentre_rad = 0.0\nperiod_s = {period_s}\n\
             sine_rad = [1.0, 0.0, 0.0, 0.0, 0.0]\ncosine_rad = [1.0, 0.0, 0.0, 0.0, 0.0]\n"
        )
    };
    let refused = |joints: String, words: &str| {
        let file = path.join("bad.toml");
        std::fs::write(&file, format!("format = 1\nfade_in_s = 1.0\n{joints}")).unwrap();
        let error = ExcitationFile::read(&file).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(joint(1, "10.0") + &joint(2, "0.0") + &joint(3, "10.0"), "line 12: period_s");
    refused(joint(1, "10.0") + &joint(3, "10.0") + &joint(2, "10.0"), "joints 1, 2, 3");
    refused(joint(1, "10.0") + &joint(2, "10.0"), "length 3");
    refused(joint(1, "10.0") + &joint(2, "nan") + &joint(3, "10.0"), "not a finite number");
}

/// `rrr design-excitation` on a model whose ranges are these.
fn designed_within(limits_rad: [[f64; 2]; 3]) -> (tempfile::TempDir, assert_cmd::assert::Assert) {
    let directory = directory();
    let mut file = RobotFile::from_robot(&reference_robot());
    file.robot.limits_rad = Some(limits_rad.to_vec());
    file.write(directory.path().join("model.toml")).unwrap();
    let mut command = Command::cargo_bin("rrr").unwrap();
    let line = "design-excitation --model model.toml --out motion.toml --starts 1 --seconds 5";
    let assert = command.current_dir(directory.path()).args(line.split(' ')).assert();
    (directory, assert)
}

#[test]
fn a_design_stays_in_the_ranges_of_the_model_file_as_the_board_sees_them() {
    let limits_rad = [[-1.0, 1.5], [-2.6, -0.6], [-1.2, 1.2]];
    let (directory, assert) = designed_within(limits_rad);
    assert.success();
    let motion = ExcitationFile::read(directory.path().join("motion.toml")).unwrap().motion();
    let rig = Rig { limits_rad: limits_rad.map(Some), ..Rig::new(reference_robot()) };
    let block = excitation(1, 30.0).with_motion(motion.clone()).block(&rig);
    assert_eq!(rig::range::leaving(&block), None);
    let reach = |i: usize| {
        let Motion::Fourier(series) = &motion[i] else { panic!("a series") };
        let terms = series.sine_rad.iter().chain(&series.cosine_rad);
        terms.map(|amplitude| amplitude.abs()).sum::<f32>()
    };
    assert!((0..3).all(|i| reach(i) > 0.2), "it still moves");
}

#[test]
fn a_range_in_which_the_arm_cannot_hang_is_refused() {
    let (_directory, assert) = designed_within([[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0]]);
    let output = assert.failure();
    let text = String::from_utf8_lossy(&output.get_output().stderr).into_owned();
    assert!(text.contains("joint 2 hangs outside its range"), "{text}");
}
