//! A board of another build says so in words, over a pty too.
#![cfg(unix)]
#![allow(missing_docs)]

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::Duration;

use assert_cmd::Command;
use firmware::link::{Hello, MAX_FRAME_BYTES, PROTOCOL_VERSION, ToHost};
use model::reference_robot::reference_robot;
use serialport::{SerialPort, TTYPort};
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

/// What `rrr connect` says about a board that answers everything with this Hello, exit status 2.
fn said_of(hello: Hello) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap();
    let board = std::thread::spawn(move || {
        let (mut line, _) = listener.accept().unwrap();
        let mut bytes = [0; 256];
        while line.read(&mut bytes).is_ok_and(|length| length > 0) {
            let mut frame = [0; MAX_FRAME_BYTES];
            let _ = line.write_all(ToHost::Hello(hello).write(&mut frame).unwrap());
        }
    });
    let mut command = Command::cargo_bin("rrr").unwrap();
    let said = command.args(["connect", "--port", &format!("tcp:{port}")]).assert().code(2);
    board.join().unwrap();
    String::from_utf8(said.get_output().stderr.clone()).unwrap()
}

#[test]
fn an_older_or_newer_firmware_is_told_in_words() {
    let same = Hello::of_this_build("a board");
    let newer = said_of(Hello { protocol_version: PROTOCOL_VERSION + 1, ..same });
    assert!(
        newer.contains("speaks version 2 of the protocol, this tool version 1: the tool is older")
    );
    assert!(newer.contains("a board, build ") && newer.contains("\nhint: "), "{newer}");
    let older = said_of(Hello { protocol_version: 0, ..same });
    assert!(older.contains("the firmware is older") && older.contains("rrr flash"), "{older}");
}

#[test]
fn a_firmware_with_other_messages_is_told_in_words() {
    let same = Hello::of_this_build("a board");
    let other = said_of(Hello { schema_hash: same.schema_hash ^ 1, ..same });
    assert!(other.contains("has messages of another build"), "{other}");
    assert!(other.contains("\nhint: "), "{other}");
}

/// Carries bytes between a board behind a socket and the far end of a pty.
fn carry(mut pty: TTYPort, mut board: TcpStream) {
    pty.set_timeout(Duration::from_millis(1)).unwrap();
    board.set_read_timeout(Some(Duration::from_millis(1))).unwrap();
    let mut bytes = [0; 4096];
    loop {
        // While nobody has the pty open, reading it fails.
        if let Ok(length) = pty.read(&mut bytes) {
            board.write_all(&bytes[..length]).unwrap();
        }
        match board.read(&mut bytes) {
            Ok(0) => return,
            Ok(length) => pty.write_all(&bytes[..length]).unwrap_or_default(),
            Err(_) => {}
        }
    }
}

#[test]
fn a_pty_is_a_line_like_any_other() {
    let board = SimulatedBoard::start(BoardSettings::new(reference_robot())).unwrap();
    let (far, near) = TTYPort::pair().unwrap();
    let name = near.name().unwrap();
    drop(near);
    let tcp = TcpStream::connect(board.port().trim_start_matches("tcp:")).unwrap();
    std::thread::spawn(move || carry(far, tcp));
    for _ in 0..2 {
        let mut command = Command::cargo_bin("rrr").unwrap();
        let assert = command.args(["connect", "--port", &name]).assert().success();
        let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
        assert!(text.contains("simulated, build") && text.contains(&name), "{text}");
    }
}
