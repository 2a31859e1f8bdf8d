//! The commands of `docs/first-motion.md`, in their order, at a simulated board whose encoders
//! count from zero at power-on.
#![cfg(unix)]
#![allow(missing_docs)]

use std::path::Path;
use std::time::Duration;

use assert_cmd::Command;
use files::{Dataset, Log, RobotFile};
use firmware::reference::Time;
use model::reference_robot::reference_robot;
use rig::range::leaving;
use rig::{Plan, Rig, plan};
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

const PAGE: &str = include_str!("../../docs/first-motion.md");

/// The page's commands for a board that is there, from telling home to the task.
fn commands() -> Vec<String> {
    let lines = PAGE.lines().filter_map(|line| line.strip_prefix("    rrr "));
    let wanted = ["home", "upload", "run", "clear-fault", "connect", "set-key", "validate"];
    lines
        .map(|line| line.split('#').next().unwrap_or_default().trim().to_owned())
        .filter(|line| wanted.iter().any(|name| line.split(' ').next() == Some(name)))
        .collect()
}

/// The reference robot with the ranges that the page gives for an example.
fn with_limits() -> RobotFile {
    let marks = PAGE.split('`').skip(1).step_by(2);
    let example = marks.into_iter().find(|mark| mark.starts_with("limits_rad = ")).unwrap();
    let example: toml::Table = example.parse().unwrap();
    let mut file = RobotFile::from_robot(&reference_robot());
    file.robot.limits_rad = Some(example["limits_rad"].clone().try_into().unwrap());
    file
}

/// The built-in experiments as the page's table calls them, and which joint of each it tells of; none: all.
fn built_in() -> Vec<(&'static str, Option<usize>, Plan)> {
    let on_each = (1..=3u8).map(|joint| {
        let place = usize::from(joint) - 1;
        ("constant-velocity", Some(place), plan::constant_velocity(joint))
    });
    let others = [
        ("excitation", None, plan::excitation(1, 30.0)),
        ("driven-noise", None, plan::driven_noise(12.0, 1)),
        ("slow", None, plan::slow(20.0)),
        ("task", None, plan::task(20.0)),
    ];
    on_each.chain(others).collect()
}

#[test]
fn the_ranges_of_the_page_let_every_built_in_experiment_pass() {
    let rig = Rig::of_file(&with_limits()).unwrap();
    for (name, _, plan) in built_in() {
        assert_eq!(leaving(&plan.block(&rig)), None, "{name}");
    }
}

#[test]
fn built_in_experiments_pass_through_what_the_page_says() {
    let rig = Rig::new(reference_robot());
    let row = |name: &str| {
        let line = PAGE.lines().find(|line| line.starts_with(&format!("| `{name}"))).unwrap();
        let cells: Vec<&str> = line.trim_matches('|').split('|').skip(1).collect();
        let ends = |cell: &&str| {
            let (low, high) = cell.split_once(" to ").unwrap();
            [low, high].map(|end| end.trim().parse::<f32>().unwrap())
        };
        cells.iter().map(ends).collect::<Vec<_>>()
    };
    for (name, of_joint, plan) in built_in() {
        for joint in (0..3).filter(|joint| of_joint.is_none_or(|wanted| wanted == *joint)) {
            let period_s = rig.sample_period_s as f32;
            let at = |tick| Time::new(tick, period_s, 1.0 / period_s);
            let place = |tick| plan.reference.motion[joint].at(at(tick)).position_rad;
            let passed: Vec<f32> = (0..=plan.ticks(&rig)).map(place).collect();
            let lowest = passed.iter().copied().fold(f32::INFINITY, f32::min);
            let highest = passed.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            let [low, high] = row(name)[joint];
            let is_as_said = (lowest - low).abs() < 0.06 && (highest - high).abs() < 0.06;
            assert!(is_as_said, "{name}, joint {}: {lowest} to {highest}", joint + 1);
        }
    }
}

/// The output of a command that must succeed; the board's time runs faster than the host's.
fn rrr(at: &Path, board: &SimulatedBoard, line: &str) -> String {
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.current_dir(at).args(line.split(' ').filter(|word| !word.is_empty()));
    if !line.starts_with("validate") {
        command.args(["--port", &board.port()]);
    }
    if line.starts_with("run") {
        command.args(["--host-timeout-ms", "8000"]);
    }
    if at.join("rig.key").exists() {
        command.env("RRR_KEY_FILE", "rig.key");
    }
    command.timeout(Duration::from_secs(120));
    let assert = command.assert();
    let output = assert.get_output();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "rrr {line}: {errors}");
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[test]
fn every_command_of_the_page_does_what_it_says() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for name in ["model.toml", "identified.toml"] {
        with_limits().write(at.join(name)).unwrap();
    }
    // Somebody has held the arm aside while the power came on, and then let go.
    let mut settings = BoardSettings { speed: 4.0, ..BoardSettings::new(reference_robot()) };
    settings.arm.position_rad = [0.0, -1.3, 0.3];
    settings.arm.incremental_encoders = true;
    let board = SimulatedBoard::start(settings).unwrap();
    let commands = commands();
    assert!(commands.len() >= 8, "{commands:?}");
    for line in &commands {
        println!("rrr {line}");
        let text = rrr(at, &board, line);
        if line.starts_with("run") {
            assert!(text.contains("played to its end"), "{line}: {text}");
        }
    }
    for folder in ["first", "task"] {
        let dataset = Dataset::read(at.join(folder)).unwrap();
        for entry in &dataset.entries {
            let rows = Log::read(at.join(folder).join(&entry.file)).unwrap().time_s.len();
            assert!(rows > 1000, "{folder}: {rows} rows");
        }
    }
}
