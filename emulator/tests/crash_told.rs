//! A crash of the image, told by `rrr connect`: where it was, and the processor's fault status.
#![allow(missing_docs)]

mod common;

use std::process::Command as Process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;

use common::{board_with_arm, commit, home_and_run, image};
use emulator::operator::Operator;
use emulator::tcp_line::{TcpLine, serve};
use firmware::Mode;
use model::reference_robot::reference_robot;
use rig::{Rig, plan};
use simulation::start_of;

/// A board whose thread crashes in a run; then the reset by the watchdog, and the next boot.
fn crashed() -> Operator {
    let block = plan::hold(20.0).with_mode(Mode::PdModel).block(&Rig::new(reference_robot()));
    let mut board = board_with_arm(&image().unwrap(), start_of(&block));
    board.run_ms(50).unwrap();
    commit(&mut board, &block);
    home_and_run(&mut board, start_of(&block));
    board.machine.crash_thread().unwrap();
    board.run_ms(200).unwrap();
    board
}

#[test]
fn rrr_connect_tells_where_the_processor_crashed_and_why() {
    let Some(tool) = std::env::var_os("RRR_TOOL").filter(|_| image().is_some()) else {
        return eprintln!("skipped, because RRR_TOOL or the image is not named");
    };
    let off = Arc::new(AtomicBool::new(false));
    let (seen, (tell, told)) = (off.clone(), channel());
    let board = std::thread::spawn(move || {
        let mut board = crashed();
        let place = board.machine.board().trace.faults[0].clone();
        let mut line = TcpLine::open(([127, 0, 0, 1], 0).into()).unwrap();
        tell.send((line.address().unwrap(), place)).unwrap();
        serve(&mut board.machine, &mut line, 1.0, &seen)
    });
    let (address, place) = told.recv().unwrap();
    let mut connect = Process::new(tool);
    connect.args(["connect", "--port", &format!("tcp:{address}")]).env_remove("RRR_KEY_FILE");
    let output = connect.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    off.store(true, Ordering::Relaxed);
    assert_eq!(board.join().unwrap(), Ok(()));
    let counter = place.split(' ').next().unwrap();
    assert!(output.status.success(), "{text}");
    for part in ["state       faulted", "crash at ", counter, "fault status 0x00010000"] {
        assert!(text.contains(part), "no `{part}` in: {text}");
    }
}
