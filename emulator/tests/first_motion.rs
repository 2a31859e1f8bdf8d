//! The commands of `docs/first-motion.md`, in their order, at the image on the emulated board.
#![allow(missing_docs)]

mod common;

use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;

use common::{arm, image};
use emulator::machine::Machine;
use emulator::tcp_line::{TcpLine, serve};
use files::RobotFile;
use model::reference_robot::reference_robot;

const PAGE: &str = include_str!("../../docs/first-motion.md");
/// Holds the path of `rrr`; `cargo xtask emulate` sets it.
const TOOL_VARIABLE: &str = "RRR_TOOL";
/// The board's time is faster than the host's; the host may be late.
const SPEED: f64 = 4.0;

/// The page's commands for a board that is there, from the first look to the task.
fn commands() -> Vec<String> {
    let lines = PAGE.lines().filter_map(|line| line.strip_prefix("    rrr "));
    let bare = lines.map(|line| line.split('#').next().unwrap_or_default().trim().to_owned());
    bare.filter(|line| !["flash", "monitor"].iter().any(|name| line.starts_with(name))).collect()
}

fn rrr(tool: &Path, at: &Path, port: &str, line: &str) -> String {
    let mut command = Command::new(tool);
    command.current_dir(at).args(line.split_whitespace()).env_remove("RRR_KEY_FILE");
    if !line.starts_with("validate") {
        command.args(["--port", port]);
    }
    if line.starts_with("run") {
        command.args(["--host-timeout-ms", "8000"]);
    }
    if at.join("rig.key").exists() {
        command.env("RRR_KEY_FILE", "rig.key");
    }
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "rrr {line}: {errors}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn from_power_on_to_the_first_motion_by_the_commands_of_the_page() {
    let Some(tool) = std::env::var_os(TOOL_VARIABLE).filter(|_| image().is_some()) else {
        return eprintln!("skipped, because {TOOL_VARIABLE} or the image is not named");
    };
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for name in ["model.toml", "identified.toml"] {
        RobotFile::from_robot(&reference_robot()).write(at.join(name)).unwrap();
    }
    let off = Arc::new(AtomicBool::new(false));
    let (seen, (tell, told)) = (off.clone(), channel());
    let board = std::thread::spawn(move || {
        let mut machine = Machine::new(image().unwrap(), arm(model::HANGING_RAD)).unwrap();
        let mut line = TcpLine::open(([127, 0, 0, 1], 0).into()).unwrap();
        tell.send(line.address().unwrap()).unwrap();
        let ended = serve(&mut machine, &mut line, SPEED, &seen);
        ended.map(|()| machine.resets.clone())
    });
    let port = format!("tcp:{}", told.recv().unwrap());
    std::thread::sleep(std::time::Duration::from_secs(1));
    for line in commands() {
        println!("rrr {line}");
        let text = rrr(tool.as_ref(), at, &port, &line);
        println!("{text}");
        assert!(!line.starts_with("run") || text.contains("played to its end"), "{line}: {text}");
    }
    off.store(true, Ordering::Relaxed);
    assert_eq!(board.join().unwrap(), Ok(Vec::new()), "no reset, nothing that is not modelled");
}
