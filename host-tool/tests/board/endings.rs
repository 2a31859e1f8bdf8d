//! Runs that end early: Ctrl-C and faults.

use std::path::Path;
use std::process::{Child, Output};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

use files::{Dataset, Log};
use firmware::link::Command;
use link::run::{self, RunOutcome};
use link::{Address, Client, Recorder};
use model::reference_robot::reference_robot;
use rig::{Rig, plan};
use simulation::simulated_board::SimulatedBoard;

use crate::files::TOO_FAST;
use crate::line::{Deed, Line, at_query};
use crate::recording::{assert_all_ticks_are_accounted_for, board_messages};
use crate::{assert_tells, board, refused, rrr, spawned, stdout, with_model};

fn press_ctrl_c(child: &Child) {
    let id = child.id().to_string();
    std::process::Command::new("kill").args(["-INT", &id]).status().unwrap();
}

/// A run in which Ctrl-C is pressed at the 5th sign of life of its `part`-th motion.
fn interrupted(at: &Path, board: &SimulatedBoard, part: usize, line: &str) -> Output {
    let (sender, is_time) = mpsc::channel();
    let way = at_query(part, 5, move || {
        sender.send(()).unwrap();
        Deed::Pass
    });
    let child = spawned(at, &Line::to(board, way).port, line);
    is_time.recv_timeout(Duration::from_secs(60)).unwrap();
    press_ctrl_c(&child);
    let pressed = Instant::now();
    let output = child.wait_with_output().unwrap();
    assert!(pressed.elapsed() < Duration::from_secs(3), "{:?}", pressed.elapsed());
    output
}

fn words(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn after_ctrl_c_the_board_is_disarmed_the_log_kept_and_the_exit_status_130() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let output = interrupted(at, &board, 1, "run hold --duration 600 --out logs");
    assert_eq!(output.status.code(), Some(130), "`&&` goes no further");
    assert_tells(&words(&output.stderr), &["interrupted: the run was stopped in tick ", "0 V"]);
    let printed = words(&output.stdout);
    assert!(printed.find("ended ").unwrap() < printed.find("log  ").unwrap(), "{printed}");
    assert_tells(&stdout(rrr(at, &board, "connect").success()), &["state       disarmed"]);
    let log = Dataset::read(at.join("logs")).unwrap().recordings().unwrap().remove(0).log;
    assert!(log.len() > 500, "{}", log.len());
    assert_all_ticks_are_accounted_for(&words(&output.stdout), &log);
    let last = board_messages(&at.join("logs/hold.mcap")).pop().unwrap();
    assert_eq!((&last["state"], &last["fault"]), (&"armed".into(), &"none".into()));
}

#[test]
fn after_ctrl_c_the_arm_is_stopped_before_the_log_is_written() {
    let (directory, board) = (with_model(), board());
    let at = directory.path().to_owned();
    rrr(&at, &board, "upload model.toml").success();
    let (sender, at_stop) = mpsc::channel();
    let (press, is_time) = mpsc::channel();
    let (logs, mut queries) = (at.join("logs"), 0);
    let line = Line::to(&board, move |command| {
        queries += u32::from(*command == Command::Query);
        if queries == 10 {
            press.send(()).unwrap();
        }
        if *command == Command::Stop {
            // Long enough for the log to be written, were it not to wait for the answer.
            std::thread::sleep(Duration::from_millis(500));
            let names = std::fs::read_dir(&logs).unwrap().map(|entry| entry.unwrap().file_name());
            sender.send(names.collect::<Vec<_>>()).unwrap();
        }
        Deed::Pass
    });
    let mut child = spawned(&at, &line.port, "run hold --duration 600 --out logs");
    is_time.recv_timeout(Duration::from_secs(60)).unwrap();
    press_ctrl_c(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    // The one that grows row by row; all others wait until the board has heard `stop`.
    assert_eq!(at_stop.recv().unwrap(), ["hold.unfinished.csv"]);
    assert!(at.join("logs/hold.csv.gz").exists());
}

#[test]
fn after_ctrl_c_on_the_way_to_the_beginning_its_log_is_kept_but_not_listed() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let output = interrupted(at, &board, 1, "run task --out logs --approach-speed 0.1");
    assert_eq!(output.status.code(), Some(130));
    assert_tells(&words(&output.stderr), &["the approach was stopped"]);
    let log = Log::read(at.join("logs/task-approach.csv.gz")).unwrap();
    assert!(log.len() > 500, "{}", log.len());
    assert_all_ticks_are_accounted_for(&words(&output.stdout), &log);
    assert!(at.join("logs/task-approach.mcap").exists());
    assert!(!at.join("logs/dataset.toml").exists());
}

#[test]
fn ctrl_c_before_anything_is_recorded_leaves_no_folder_and_promises_no_log() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let ((sender, is_time), (done, is_pressed)) = (mpsc::channel(), mpsc::channel());
    let line = Line::to(&board, move |command| {
        if matches!(command, Command::UploadBegin { .. }) {
            sender.send(()).unwrap();
            is_pressed.recv().unwrap();
            std::thread::sleep(Duration::from_millis(200));
        }
        Deed::Pass
    });
    let child = spawned(at, &line.port, "run hold --out logs/today");
    is_time.recv_timeout(Duration::from_secs(60)).unwrap();
    assert!(at.join("logs/today").exists());
    press_ctrl_c(&child);
    done.send(()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert_tells(&words(&output.stdout), &["samples     0 of 0", "nothing was recorded"]);
    assert!(!words(&output.stderr).contains("log"), "{}", words(&output.stderr));
    assert!(!at.join("logs").exists());
}

#[test]
fn ctrl_c_while_the_board_is_armed_keeps_it_from_running() {
    let (directory, board) = (with_model(), board());
    rrr(directory.path(), &board, "upload model.toml").success();
    let interrupted = Arc::new(AtomicBool::new(false));
    let (pressed, (sender, asked)) = (interrupted.clone(), mpsc::channel());
    let line = Line::to(&board, move |command| {
        if *command == Command::Arm {
            pressed.store(true, Ordering::Relaxed);
        }
        sender.send(format!("{command:?}")).unwrap();
        Deed::Pass
    });
    let mut client = Client::connect(&Address::of(&line.port), None).unwrap();
    let mut recorder = Recorder::new(&plan::hold(1.0).block(&Rig::new(reference_robot())), 1000);
    let ending = run::run(&mut client, 8000, &mut recorder, &interrupted, &mut ());
    assert!(matches!(ending, Ok(RunOutcome::Interrupted)), "{ending:?}");
    drop(client);
    let asked: Vec<String> = asked.iter().collect();
    assert_eq!(asked, ["Arm", "Stop", "Disarm", "Query"]);
}

#[test]
fn a_fault_ends_the_run_and_its_log_is_kept_and_tells_it() {
    fault_is_kept(TOO_FAST);
}

#[test]
fn too_little_voltage_against_gravity_is_a_fault_that_its_log_tells() {
    fault_is_kept(
        "run task --out logs --approach-speed 3 --command-limit-v 0.9 --tracking-limit 0.3",
    );
}

fn fault_is_kept(line: &str) {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let assert = rrr(at, &board, line);
    let printed = words(&assert.get_output().stdout);
    let text = refused(assert);
    assert_tells(&text, &["the board ended the run: ", " at joint ", "rrr clear-fault"]);
    assert_tells(&stdout(rrr(at, &board, "connect").success()), &["state       faulted", "fault "]);
    assert_tells(&refused(rrr(at, &board, "run hold --out logs")), &["the board is faulted"]);
    assert_tells(&stdout(rrr(at, &board, "clear-fault").success()), &["the board is disarmed"]);

    let dataset = Dataset::read(at.join("logs")).unwrap();
    assert_eq!(dataset.entries.len(), 1);
    let log = dataset.recordings().unwrap().remove(0).log;
    let [_, ticks, _] = assert_all_ticks_are_accounted_for(&printed, &log);
    assert!((100..20_000).contains(&ticks), "{ticks}");
    let commands_v = log.joints.iter().map(|joint| *joint.command_v.last().unwrap());
    assert!(commands_v.map(f64::abs).sum::<f64>() > 0.0, "the rows are of the running arm");
    assert_eq!(Log::read(at.join("logs/task.mcap")).unwrap().time_s, log.time_s);

    let board = board_messages(&at.join("logs/task.mcap"));
    assert_eq!(board.len(), log.len() + 1);
    let last = board.last().unwrap();
    assert_eq!(last["state"], "faulted");
    let fault = format!("{} at joint {}", last["fault"].as_str().unwrap(), last["fault_joint"]);
    assert_tells(&text, &[&fault]);
    assert_eq!(last["command_V"], serde_json::json!([0.0, 0.0, 0.0]));
    assert!(last["position_count"][0].is_i64());
    assert_eq!(last["t_s"].as_f64().unwrap(), ticks as f64 / 1000.0, "the tick of the fault");
}

#[test]
fn a_run_to_be_fitted_to_that_a_fault_has_ended_is_kept_but_not_listed() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let assert = rrr(at, &board, &format!("{TOO_FAST} --role train"));
    assert_tells(
        &words(&assert.get_output().stdout),
        &["it ended in a fault; not in dataset.toml"],
    );
    refused(assert);
    assert!(Log::read(at.join("logs/task.csv.gz")).unwrap().len() > 100);
    assert!(!at.join("logs/dataset.toml").exists());
}

#[test]
fn a_fault_on_the_way_to_the_beginning_keeps_that_log_unlisted() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let line = "run task --out logs --approach-speed 3 --speed-limit 1.5";
    let assert = rrr(at, &board, line);
    let printed = words(&assert.get_output().stdout);
    let text = refused(assert);
    assert_tells(&text, &["the board ended the approach: speed", "rrr clear-fault"]);
    let log = Log::read(at.join("logs/task-approach.csv.gz")).unwrap();
    assert_all_ticks_are_accounted_for(&printed, &log);
    let last = board_messages(&at.join("logs/task-approach.mcap")).pop().unwrap();
    assert_eq!(last["state"], "faulted");
    assert!(text.contains(last["fault"].as_str().unwrap()), "{text}");
    assert!(!at.join("logs/dataset.toml").exists());
}
