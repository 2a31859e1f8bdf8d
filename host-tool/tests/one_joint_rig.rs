//! A rig that has joint 3 alone: the encoders of the others count nothing.
#![cfg(unix)]
#![allow(missing_docs)]

#[allow(dead_code)]
#[path = "common/at_board.rs"]
mod at_board;

use at_board::{assert_tells, refused, rrr, said};
use host_tool::files::{Dataset, Log, RobotFile};
use host_tool::link::simulated_board::{BoardSettings, SimulatedBoard};
use model::reference_robot::reference_robot;

#[test]
fn joint_3_alone_is_homed_run_and_recorded() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    RobotFile::from_robot(&reference_robot()).write(at.join("model.toml")).unwrap();
    let board = SimulatedBoard::start(BoardSettings {
        incremental_encoders: true,
        dead_encoders: [true, true, false],
        ..BoardSettings::new(reference_robot())
    })
    .unwrap();
    // Somebody turns joint 3 within the first second.
    std::thread::sleep(std::time::Duration::from_millis(1100));
    let text = said(at, &board, "home --at 0,-1.5708,0");
    assert_tells(&text, &["joint 1 has an encoder that has not", "joint 3 is at 0 rad"]);
    assert_tells(&said(at, &board, "connect"), &["not known of joint 1, 2: "]);

    said(at, &board, "upload model.toml --mode pd");
    let why = refused(rrr(at, &board.port(), "run hold --out all").assert());
    assert_tells(&why, &["joint 1: its encoder has not moved", "--joints"]);

    said(at, &board, "upload model.toml --mode pd --joints 3");
    let text = said(at, &board, "run hold --duration 1 --out one");
    assert_tells(&text, &["played to its end"]);
    let why = refused(rrr(at, &board.port(), "run presliding-noise --joint 1 --out one").assert());
    assert_tells(&why, &["joint 1 is moved by presliding-noise-1, but not there"]);
    let entry = Dataset::read(at.join("one")).unwrap().entries.remove(0);
    let log = Log::read(at.join("one").join(entry.file)).unwrap();
    assert_eq!(log.joints.iter().map(|joint| joint.joint).collect::<Vec<_>>(), [3]);
}
