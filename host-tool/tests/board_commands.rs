//! The commands beside `rrr run`, at a simulated board: outputs that fail, the live table,
//! the port, the slots.
#![cfg(target_os = "linux")] // for /dev/full
#![allow(missing_docs)]

use std::fs::OpenOptions;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use assert_cmd::cargo::cargo_bin;
use files::RobotFile;
use firmware::ParameterBlock;
use firmware::block::MAX_BYTES;
use firmware::link::Command;
use firmware::store::{Layout, Slot, safe_defaults};
use link::transfer;
use model::reference_robot::reference_robot;
use serialport::TTYPort;
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

mod common;
use common::simulated_board::{assert_tells, board, client, refused, rrr, said};
use common::{directory, with_model};

/// Whether the board sends telemetry to whoever listens.
fn is_streaming(board: &SimulatedBoard) -> bool {
    let mut client = client(board);
    let begin = Instant::now();
    while begin.elapsed() < Duration::from_millis(200) {
        client.receive().unwrap();
    }
    !client.take_records().is_empty()
}

/// `rrr` with its standard output in a file or device.
fn with_output(at: &Path, board: &SimulatedBoard, line: &str, output: Stdio) -> Child {
    let mut command = std::process::Command::new(cargo_bin("rrr"));
    command.current_dir(at).args(line.split(' ')).args(["--port", &board.port()]);
    command.env_remove("RRR_KEY_FILE").stdout(output).stderr(Stdio::piped()).spawn().unwrap()
}

fn full() -> Stdio {
    OpenOptions::new().write(true).open("/dev/full").unwrap().into()
}

/// A pipe that nobody reads.
fn closed() -> Stdio {
    std::io::pipe().unwrap().1.into()
}

#[test]
fn a_full_output_ends_the_monitor_with_words_and_the_stream_off() {
    let (directory, board) = (directory(), board());
    for line in ["monitor --once", "monitor"] {
        let child = with_output(directory.path(), &board, line, full());
        let output = child.wait_with_output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert_tells(&text, &["error: the standard output cannot be written: ", "\nhint: "]);
        assert!(!is_streaming(&board), "{line}");
    }
}

#[test]
fn a_reader_that_goes_away_ends_the_monitor_with_the_stream_off() {
    let (directory, board) = (directory(), board());
    let output = with_output(directory.path(), &board, "monitor", closed());
    let output = output.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!is_streaming(&board));
}

#[test]
fn no_command_panics_at_a_closed_or_full_output() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    let lines = [
        "connect",
        "upload model.toml",
        "download --out a.bin",
        "stop",
        "clear-fault",
        "home --at 0,-1.5708,0",
        "set-key --remove",
        "set-key key",
    ];
    for line in lines {
        let at_full = with_output(at, &board, line, full()).wait_with_output().unwrap();
        let text = String::from_utf8(at_full.stderr).unwrap();
        assert_eq!(at_full.status.code(), Some(2), "{line}: {text}");
        assert_tells(&text, &["error: the standard output cannot be written: "]);
    }
    // The key is there all the same.
    for line in lines.map(|line| format!("{line} --key key")) {
        let output = with_output(at, &board, &line, closed()).wait_with_output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn completions_at_a_closed_or_full_output_do_not_panic() {
    for (output, status) in [(full(), 2), (closed(), 0)] {
        let mut command = std::process::Command::new(cargo_bin("rrr"));
        command.args(["completions", "bash"]).stdout(output).stderr(Stdio::piped());
        let output = command.spawn().unwrap().wait_with_output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(status), "{text}");
        assert!(!text.contains("panicked"), "{text}");
    }
}

#[test]
fn the_live_table_is_drawn_anew_until_ctrl_c_and_the_stream_is_off() {
    let (directory, board) = (directory(), board());
    let mut child = with_output(directory.path(), &board, "monitor", Stdio::piped());
    let mut shown = Vec::new();
    let mut output = child.stdout.take().unwrap();
    // Until the third table.
    while shown.windows(5).filter(|part| part == b"\x1b[7A\x1b").count() < 2 {
        let mut bytes = [0; 1024];
        let length = output.read(&mut bytes).unwrap();
        assert!(length > 0, "{}", String::from_utf8_lossy(&shown));
        shown.extend_from_slice(&bytes[..length]);
    }
    std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    output.read_to_end(&mut shown).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(!is_streaming(&board));

    let text = String::from_utf8(shown).unwrap();
    let tables: Vec<&str> = text.split("\x1b[7A\x1b[J").collect();
    for table in &tables {
        assert_eq!(table.lines().count(), 7, "{table}");
        assert_tells(table, &["disarmed  tick ", "position_rad", "fault none\nlink  open: "]);
    }
    let ticks: Vec<u32> = tables.iter().map(|table| tick(table)).collect();
    assert!(ticks.is_sorted_by(|earlier, later| earlier < later), "{ticks:?}");
}

/// The tick that a table tells.
fn tick(table: &str) -> u32 {
    let mut words = table.split_whitespace().skip_while(|word| *word != "tick");
    words.nth(1).unwrap().parse().unwrap()
}

#[test]
fn a_board_that_streams_is_seen_to_stream() {
    let board = board();
    client(&board).execute(Command::Stream { on: true }).unwrap();
    assert!(is_streaming(&board), "else the tests of this file show nothing");
}

#[test]
fn a_port_that_another_program_has_is_told_with_what_to_do() {
    let directory = directory();
    let (_far, near) = TTYPort::pair().unwrap();
    let name = serialport::SerialPort::name(&near).unwrap();
    drop(near);
    // As `rrr run` holds it.
    let held = serialport::new(&name, 921_600).open().unwrap();
    let text = refused(rrr(directory.path(), &name, "stop").assert());
    assert_tells(&text, &[&name, "cannot be opened: another program has it"]);
    assert_tells(&text, &["press Ctrl-C", "`kill -INT`", "`rrr run` stops the arm first"]);
    drop(held);
    let text = refused(rrr(directory.path(), "/dev/none", "stop").assert());
    assert_tells(&text, &["/dev/none: cannot be opened: ", "look at the name", "the group"]);
}

fn encoded(block: &ParameterBlock) -> Vec<u8> {
    block.encode(&mut [0; MAX_BYTES]).unwrap().to_vec()
}

#[test]
fn a_download_brings_the_block_in_use_or_the_stored_one() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    let file = |name: &str| std::fs::read(at.join(name)).unwrap();
    said(at, &board, "download --in-use --out defaults.bin");
    assert_eq!(file("defaults.bin"), encoded(&safe_defaults()));

    said(at, &board, "upload model.toml");
    said(at, &board, "download --out stored.bin");
    let stored = ParameterBlock::decode(&file("stored.bin")).unwrap();
    let lower = encoded(&ParameterBlock { command_limit_v: 0.5, ..stored });
    transfer::put_into_use(&mut client(&board), &lower).unwrap();
    let text = said(at, &board, "download --in-use --out used.bin");
    assert_eq!(text, format!("used.bin: a block of {} bytes\n", lower.len()));
    assert_eq!(file("used.bin"), lower);
    said(at, &board, "download --out again.bin");
    assert_eq!(file("again.bin"), file("stored.bin"));
    said(at, &board, "download --in-use --out used.toml");
    let used = RobotFile::read(at.join("used.toml")).unwrap();
    assert_eq!(used.robot.command_limit_v, Some(0.5));
}

/// A model that is fetched and sent again must not lose what keeps the arm whole.
#[test]
fn a_downloaded_model_has_the_ranges_and_what_motors_bear() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    let mut limited = RobotFile::read(at.join("model.toml")).unwrap();
    limited.robot.limits_rad = Some(vec![[-4.0, 7.0], [-9.0, 7.0], [-8.0, 8.0]]);
    limited.robot.motor_continuous_v = Some(vec![3.0, 3.5, 2.0]);
    limited.robot.motor_time_constant_s = Some(vec![60.0, 45.0, 30.0]);
    limited.write(at.join("limited.toml")).unwrap();
    said(at, &board, "upload limited.toml");
    said(at, &board, "download --out again.toml");
    let again = RobotFile::read(at.join("again.toml")).unwrap().robot;
    assert_eq!(again.limits_rad, limited.robot.limits_rad);
    assert_eq!(again.motor_continuous_v, limited.robot.motor_continuous_v);
    assert_eq!(again.motor_time_constant_s, limited.robot.motor_time_constant_s);

    said(at, &board, "upload model.toml");
    said(at, &board, "download --out endless.toml");
    let endless = RobotFile::read(at.join("endless.toml")).unwrap().robot;
    assert_eq!((endless.limits_rad, endless.motor_continuous_v), (None, None));
}

#[test]
fn a_board_with_a_damaged_newer_slot_says_that_it_has_the_older_block() {
    let (directory, first) = (with_model(), board());
    let at = directory.path();
    said(at, &first, "upload model.toml");
    said(at, &first, "download --out older.bin");
    said(at, &first, "upload model.toml --command-limit-v 1");
    let mut flash = first.switch_off();
    // Slot A had the first upload, slot B the second.
    let in_newer = Layout::G474.slot(Slot::B) - Layout::G474.bank_start + 100;
    flash[in_newer as usize] ^= 1;

    let settings = BoardSettings { flash, ..BoardSettings::new(reference_robot()) };
    let second = SimulatedBoard::start(settings).unwrap();
    let text = said(at, &second, "connect");
    assert_tells(&text, &["parameters  the older one in the store; the newer one is damaged ("]);
    let block = std::fs::read(at.join("older.bin")).unwrap();
    let checksum = firmware::checksum::CRC_32C.checksum(&block);
    assert_tells(&text, &[&format!("({} bytes, CRC-32C {checksum:08X})", block.len())]);
    said(at, &second, "download --in-use --out used.bin");
    assert_eq!(std::fs::read(at.join("used.bin")).unwrap(), block);
}
