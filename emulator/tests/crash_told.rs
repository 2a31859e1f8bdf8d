//! Faults of before a reset, told by `rrr connect`: a crash with its place and the processor's fault
//! status, a reset in a run.
#![allow(missing_docs)]

mod common;

use std::process::Command as Process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;

use common::{image, running};
use emulator::operator::Operator;
use emulator::registers::rcc::Reset;
use emulator::tcp_line::{TcpLine, serve};
use rig::plan;

/// A board in a run to which this is done; then the next boot.
fn after(failure: fn(&mut Operator)) -> Operator {
    let mut board = running(&image().unwrap(), plan::hold(20.0));
    failure(&mut board);
    board.run_ms(200).unwrap();
    board
}

/// What `rrr connect` tells of such a board, and where the core has faulted; none where the tool or the
/// image is not there.
fn told(failure: fn(&mut Operator)) -> Option<(String, Vec<String>)> {
    let Some(tool) = std::env::var_os("RRR_TOOL").filter(|_| image().is_some()) else {
        eprintln!("skipped, because RRR_TOOL or the image is not named");
        return None;
    };
    let off = Arc::new(AtomicBool::new(false));
    let (seen, (tell, told)) = (off.clone(), channel());
    let board = std::thread::spawn(move || {
        let mut board = after(failure);
        let places = board.machine.board().trace.faults.clone();
        let mut line = TcpLine::open(([127, 0, 0, 1], 0).into()).unwrap();
        tell.send((line.address().unwrap(), places)).unwrap();
        serve(&mut board.machine, &mut line, 1.0, &seen)
    });
    let (address, places) = told.recv().unwrap();
    let mut connect = Process::new(tool);
    connect.args(["connect", "--port", &format!("tcp:{address}")]).env_remove("RRR_KEY_FILE");
    let output = connect.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    off.store(true, Ordering::Relaxed);
    assert_eq!(board.join().unwrap(), Ok(()));
    assert!(output.status.success(), "{text}");
    Some((text, places))
}

fn assert_has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "no `{part}` in: {text}");
    }
}

#[test]
fn rrr_connect_tells_where_the_processor_crashed_and_why() {
    let crash = |board: &mut Operator| board.machine.crash_thread().unwrap();
    let Some((text, places)) = told(crash) else { return };
    let counter = places[0].split(' ').next().unwrap();
    let parts = ["state       faulted", "crash at ", counter, "fault status 0x00010000"];
    assert_has(&text, &parts);
}

#[test]
fn rrr_connect_tells_of_a_reset_and_of_a_brown_out_in_a_run() {
    let Some((text, _)) = told(|board| board.machine.reset(Reset::Pin).unwrap()) else { return };
    assert_has(&text, &["state       faulted", "reset while armed"]);
    let Some((text, _)) = told(|board| board.machine.reset(Reset::BrownOut).unwrap()) else {
        return;
    };
    assert_has(&text, &["state       faulted", "supply failed while armed"]);
}
