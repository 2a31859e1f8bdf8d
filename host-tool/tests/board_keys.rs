//! `rrr` and the board's key: `set-key`, and the commands that need none.
#![cfg(unix)]
#![allow(missing_docs)]

use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use assert_cmd::cargo::cargo_bin;
use firmware::frame::FrameReader;
use firmware::link::{Command, MAX_FRAME_BYTES, PROTOCOL_VERSION, Request, ToBoard};
use firmware::supervisor::State;
use link::Client;
use simulation::simulated_board::SimulatedBoard;

mod common;
use common::simulated_board::{assert_tells, board, client, refused, rrr, said, stdout};
use common::{directory, with_model};

/// The names of a directory's files.
fn files(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn without_the_file_of_the_key_one_can_stop_and_look() {
    let (directory, board) = (directory(), board());
    let at = directory.path();
    for line in ["stop", "connect", "monitor --once", "download --in-use --out a.bin"] {
        let mut command = rrr(at, &board.port(), line);
        command.env("RRR_KEY_FILE", "missing").assert().success();
    }
    let text = said(at, &board, "stop --key missing");
    assert_tells(&text, &["the board is disarmed"]);
    let text = refused(rrr(at, &board.port(), "connect --key missing").assert());
    assert_tells(&text, &["missing: there is no such file"]);
    let mut clear = rrr(at, &board.port(), "clear-fault");
    let text = refused(clear.env("RRR_KEY_FILE", "missing").assert());
    assert_tells(&text, &["missing: there is no such file"]);
}

#[test]
fn a_first_key_may_be_the_one_that_the_environment_names() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    let with_key = |line: &str| {
        let mut command = rrr(at, &board.port(), line);
        stdout(&command.env("RRR_KEY_FILE", "key").assert().success())
    };
    assert_tells(&with_key("set-key key"), &["key: a new key", "needs the key"]);
    refused(rrr(at, &board.port(), "upload model.toml").assert());
    assert_tells(&with_key("upload model.toml"), &["the same byte for byte"]);
    assert_tells(&with_key("stop"), &["the board is disarmed"]);
    assert_tells(&with_key("set-key another"), &["another: a new key"]);
    let text = refused(rrr(at, &board.port(), "upload model.toml --key key").assert());
    assert_tells(&text, &["--key FILE"]);
    assert_tells(&said(at, &board, "set-key --remove --key another"), &["open: "]);
}

#[test]
fn a_key_that_the_board_does_not_take_is_not_left_in_a_file() {
    let (directory, board) = (directory(), board());
    let at = directory.path();
    said(at, &board, "set-key old");
    let without_proof = rrr(at, &board.port(), "set-key new").assert().stdout("");
    assert_tells(&refused(without_proof), &["has a key", "--key FILE"]);
    assert_eq!(files(at), ["old"]);

    // Away from Disarmed the board takes none either.
    said(at, &board, "set-key --remove --key old");
    arm(&mut client(&board));
    let armed = rrr(at, &board.port(), "set-key new").assert().stdout("");
    assert_tells(&refused(armed), &["armed", "rrr stop"]);
    assert_eq!(files(at), ["old"]);
    assert!(!client(&board).report().unwrap().has_key);
}

/// Arms the board as soon as its estimates have settled.
fn arm(client: &mut Client) {
    let begin = Instant::now();
    while client.execute(Command::Arm).is_err() {
        assert!(begin.elapsed() < Duration::from_secs(10));
        std::thread::sleep(Duration::from_millis(20));
    }
    assert_eq!(client.report().unwrap().state, State::Armed);
}

#[test]
fn where_no_key_can_be_written_the_board_gets_none_and_no_file_is_left() {
    let (directory, board) = (directory(), board());
    let at = directory.path();
    // A file of at most no bytes is what a full disk gives.
    let script = "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\"";
    let mut command = assert_cmd::Command::new("sh");
    command.args(["-c", script]).arg(cargo_bin("rrr")).args(["set-key", "key"]);
    command.args(["--port", &board.port()]).current_dir(at).env_remove("RRR_KEY_FILE");
    assert_tells(&refused(command.assert().stdout("")), &["key: no key can be made: "]);
    assert_eq!(files(at), [""; 0]);
    assert!(!client(&board).report().unwrap().has_key);
}

/// A line to a board that is cut as soon as the board has a new key, before it can say so.
fn cut_at_the_key(board: &SimulatedBoard) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = format!("tcp:{}", listener.local_addr().unwrap());
    let address = board.port().trim_start_matches("tcp:").to_owned();
    std::thread::spawn(move || {
        let (mut host, _) = listener.accept().unwrap();
        let mut board = TcpStream::connect(address).unwrap();
        let (mut from_board, mut to_host) = (board.try_clone().unwrap(), host.try_clone().unwrap());
        std::thread::spawn(move || std::io::copy(&mut from_board, &mut to_host));
        let (mut reader, mut bytes) = (FrameReader::new(), [0; 256]);
        while let Ok(length) = host.read(&mut bytes) {
            if bytes[..length].iter().any(|&byte| is_set_key(&mut reader, byte)) {
                host.shutdown(Shutdown::Both).unwrap();
                board.write_all(&bytes[..length]).unwrap();
                return std::thread::sleep(Duration::from_millis(200));
            }
            board.write_all(&bytes[..length]).unwrap();
        }
    });
    port
}

fn is_set_key(reader: &mut FrameReader, byte: u8) -> bool {
    let Some(Ok(ToBoard::Request(Request { command, .. }))) = reader.push(byte).map(ToBoard::read)
    else {
        return false;
    };
    matches!(command, Command::SetKey { .. })
}

#[test]
fn a_line_cut_before_the_answer_leaves_the_key_in_a_file_that_is_named() {
    let (directory, board) = (directory(), board());
    let at = directory.path();
    let text = refused(rrr(at, &cut_at_the_key(&board), "set-key key").assert().stdout(""));
    let [left] = &files(at)[..] else { panic!("{:?}", files(at)) };
    assert!(left.starts_with("key.") && left.ends_with(".new"), "{left}");
    assert_tells(&text, &["the board may have the new key", left, "rename it to key"]);
    // The hint works.
    std::thread::sleep(Duration::from_millis(300));
    assert!(client(&board).report().unwrap().has_key, "the cut came too early for this test");
    assert_tells(&said(at, &board, &format!("set-key {left} --key {left}")), &["needs the key"]);
    assert_tells(&said(at, &board, &format!("set-key --remove --key {left}")), &["open: "]);
}

/// A line where the board's answer to a new key is lost, and somebody else says Hello to the
/// board before it is asked again: then it refuses what it has done.
fn refusal_after_the_key(board: &SimulatedBoard) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = format!("tcp:{}", listener.local_addr().unwrap());
    let mut board = TcpStream::connect(board.port().trim_start_matches("tcp:")).unwrap();
    std::thread::spawn(move || {
        let (mut host, _) = listener.accept().unwrap();
        let is_mute = Arc::new(AtomicBool::new(false));
        pass_unless(is_mute.clone(), board.try_clone().unwrap(), host.try_clone().unwrap());
        let (mut reader, mut bytes, mut lost) = (FrameReader::new(), [0; 256], false);
        while let Ok(length @ 1..) = host.read(&mut bytes) {
            let is_seen = bytes[..length].iter().any(|&byte| is_set_key(&mut reader, byte));
            is_mute.store(is_seen && !lost, Ordering::Relaxed);
            board.write_all(&bytes[..length]).unwrap();
            if is_seen && !lost {
                std::thread::sleep(Duration::from_millis(100));
                board.write_all(&hello()).unwrap();
                std::thread::sleep(Duration::from_millis(100));
                lost = true;
            }
        }
    });
    port
}

/// Passes bytes on, and loses them while the line is mute.
fn pass_unless(is_mute: Arc<AtomicBool>, mut from: TcpStream, mut to: TcpStream) {
    std::thread::spawn(move || {
        let mut bytes = [0; 256];
        while let Ok(length @ 1..) = from.read(&mut bytes) {
            if !is_mute.load(Ordering::Relaxed) && to.write_all(&bytes[..length]).is_err() {
                return;
            }
        }
    });
}

fn hello() -> Vec<u8> {
    let mut frame = [0; MAX_FRAME_BYTES];
    let hello = ToBoard::Hello { protocol_version: PROTOCOL_VERSION };
    hello.write(&mut frame).unwrap().to_vec()
}

#[test]
fn a_refusal_after_a_lost_answer_leaves_the_key_too() {
    let (directory, board) = (directory(), board());
    let at = directory.path();
    let text = refused(rrr(at, &refusal_after_the_key(&board), "set-key key").assert().stdout(""));
    assert_tells(&text, &["does not prove it; the board may have the new key all the same"]);
    let [left] = &files(at)[..] else { panic!("{:?}", files(at)) };
    assert!(client(&board).report().unwrap().has_key);
    assert_tells(&said(at, &board, &format!("set-key --remove --key {left}")), &["open: "]);
}
