//! From an unknown robot to its validated model on the board, by `rrr`'s commands: identify,
//! upload, reboot, run (20)-(21) with the model, record, validate what was recorded.
#![allow(missing_docs)]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use clap::Parser;
use files::{Dataset, RobotFile};
use host_tool::commands::CommandLine;
use model::HANGING_RAD;
use model::reference_robot::reference_robot;
use recordings::tracking::Tracking;
use simulation::board::{Board, Qemu, QemuSettings};
use simulation::sensor::counts;
use simulation::{Settings, SimulatedRobot};
use tests::image;

const COUNTS_PER_TURN: u32 = 655_360;

/// The board in QEMU at the simulated robot, in real time, until its power is cut.
struct EmulatedBoard {
    off: Arc<AtomicBool>,
    thread: JoinHandle<[f64; 3]>,
}

impl EmulatedBoard {
    /// The robot hangs at rest here [rad]; `flash.bin` and the line's socket are in `directory`.
    fn on(image: &Path, directory: &Path, position_rad: [f64; 3]) -> Self {
        let socket = directory.join("line");
        let _ = std::fs::remove_file(&socket);
        let settings = QemuSettings {
            directory: Some(directory.to_owned()),
            serial: format!("unix:{},server=on,wait=off", socket.display()),
            ..QemuSettings::new(image)
        };
        let off = Arc::new(AtomicBool::new(false));
        let seen = off.clone();
        let thread = std::thread::spawn(move || ticking(&settings, position_rad, &seen));
        while !socket.exists() {
            assert!(!thread.is_finished(), "QEMU does not start");
            std::thread::sleep(Duration::from_millis(5));
        }
        Self { off, thread }
    }

    /// Kills QEMU; where the robot is then.
    fn cut(self) -> [f64; 3] {
        self.off.store(true, Ordering::Relaxed);
        self.thread.join().unwrap()
    }
}

fn ticking(settings: &QemuSettings, position_rad: [f64; 3], off: &AtomicBool) -> [f64; 3] {
    let mut board = Qemu::start(settings).unwrap();
    let mut robot = SimulatedRobot::at_rest(reference_robot(), position_rad, &Settings::default());
    let mut due = Instant::now();
    while !off.load(Ordering::Relaxed) {
        let counts = counts(&robot.reading_rad(), COUNTS_PER_TURN).map(|count| count as i32);
        let reply = board.tick(&counts).unwrap();
        robot.advance(&reply.codes.map(|code| f64::from(code.to_volts())));
        due += Duration::from_millis(1);
        match due.checked_duration_since(Instant::now()) {
            Some(early) => std::thread::sleep(early),
            None => due = Instant::now(),
        }
    }
    Command::new("kill").args(["-9", &board.process().to_string()]).status().unwrap();
    *robot.q_rad()
}

/// Runs `rrr` with these arguments; `DIR` is the directory's path.
fn rrr(directory: &Path, line: &str) {
    let line = line.replace("DIR", &directory.display().to_string());
    println!("$ rrr {line}");
    let words = std::iter::once("rrr").chain(line.split(' '));
    let result = CommandLine::try_parse_from(words).unwrap().command.run();
    assert!(result.is_ok(), "{line}: {}", result.unwrap_err().report());
}

/// A robot that nobody knows but the simulation, its campaign, and `robot.toml` of its maker.
fn record_campaign(directory: &Path) {
    let mut truth = RobotFile::from_robot(&reference_robot());
    truth.robot.encoder_counts_per_rev = Some(f64::from(COUNTS_PER_TURN));
    truth.robot.command_limit_v = Some(10.0);
    truth.robot.command_bits = Some(16);
    truth.write(directory.join("truth.toml")).unwrap();
    (truth.base, truth.friction) = (None, Vec::new());
    truth.write(directory.join("robot.toml")).unwrap();
    rrr(directory, "simulate --model DIR/truth.toml --dataset campaign --out DIR/campaign");
}

#[test]
fn an_identified_model_survives_the_reboot_and_its_run_is_validated() {
    let Some(image) = image() else { return };
    let image: PathBuf = image.canonicalize().unwrap();
    let directory = std::env::temp_dir().join(format!("rrr-end-to-end-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let at = directory.as_path();
    record_campaign(at);
    rrr(at, "identify DIR/campaign --robot DIR/robot.toml --out DIR/model.toml");

    let board = EmulatedBoard::on(&image, at, HANGING_RAD);
    rrr(at, "connect --port unix:DIR/line");
    rrr(at, "upload DIR/model.toml --port unix:DIR/line");
    rrr(at, "download --out DIR/before.bin --port unix:DIR/line");
    let position_rad = board.cut();

    let board = EmulatedBoard::on(&image, at, position_rad);
    rrr(at, "download --out DIR/after.bin --port unix:DIR/line");
    let [before, after] =
        ["before.bin", "after.bin"].map(|name| std::fs::read(at.join(name)).unwrap());
    assert_eq!(before, after, "the reboot finds what was uploaded");
    rrr(at, "run task --duration 10 --out DIR/logs --approach-speed 2 --port unix:DIR/line");
    rrr(at, "monitor --once --port unix:DIR/line");
    board.cut();

    rrr(at, "validate DIR/logs --model DIR/model.toml --out DIR/validation");
    assert!(at.join("validation/validation.html").exists());
    let recordings = Dataset::read(at.join("logs")).unwrap().recordings().unwrap();
    let log = &recordings[0].log;
    let errors: Vec<f64> = Tracking::of(log, f64::from(COUNTS_PER_TURN))
        .iter()
        .map(|tracking| 1e3 * tracking.rms_rad())
        .collect();
    println!("{} of 10000 samples; tracking error {errors:.4?} mrad rms", log.len());
    assert!(log.len() >= 9_500);
    assert!(errors.iter().all(|error| *error < 0.1), "{errors:?}");
    std::fs::remove_dir_all(directory).unwrap();
}
