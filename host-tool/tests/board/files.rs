//! What is checked before anything moves, and what happens when a log cannot be kept.

use std::process::Child;
use std::sync::mpsc;

use files::{Dataset, Log};

use crate::line::{Deed, Line, at_query};
use crate::{assert_tells, board, refused, rrr, rrr_at, spawned, with_model};

#[test]
fn what_cannot_take_the_log_is_found_before_anything_moves() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let list = "format = 1\nencoder_counts_per_rev = 4096\n[[log]]\nfile = \"a.csv\"\n\
        experiment = \"task\"\nrole = \"train\"\n";
    std::fs::create_dir(at.join("logs")).unwrap();
    std::fs::write(at.join("logs/dataset.toml"), list).unwrap();
    std::fs::write(at.join("file"), "").unwrap();
    // No file can be made in the last one, not even by root.
    for (out, why) in [("logs", "is 4096"), ("file/logs", "file/logs"), ("/proc/self", "written")] {
        let (sender, asked) = mpsc::channel();
        let line = Line::to(&board, move |command| {
            sender.send(format!("{command:?}")).unwrap();
            Deed::Pass
        });
        let text = refused(rrr_at(at, &line.port, &format!("run hold --out {out}")));
        assert_tells(&text, &[why]);
        let asked: Vec<String> = asked.iter().collect();
        assert!(!asked.iter().any(|command| command == "Arm"), "{out}: {asked:?}");
    }
    assert_eq!(std::fs::read_to_string(at.join("logs/dataset.toml")).unwrap(), list);
}

#[test]
fn a_log_that_cannot_be_kept_does_not_hide_why_the_run_ended() {
    let (directory, board) = (with_model(), board());
    let at = directory.path().to_owned();
    rrr(&at, &board, "upload model.toml").success();
    let logs = at.join("logs");
    let line = Line::to(
        &board,
        at_query(2, 1, move || {
            std::fs::remove_dir_all(&logs).unwrap();
            std::fs::write(&logs, "in the way").unwrap();
            Deed::Pass
        }),
    );
    let text = refused(rrr_at(&at, &line.port, TOO_FAST));
    assert_tells(&text, &["the board ended the run: speed", "and then: ", "clear-fault"]);
}

/// The task is faster than its limit, the way to its beginning is not.
pub const TOO_FAST: &str = "run task --out logs --approach-speed 1 --speed-limit 1.5";

/// A child whose terminal is gone.
fn without_terminal(mut child: Child) -> Child {
    drop((child.stdout.take(), child.stderr.take()));
    child
}

#[test]
fn without_a_terminal_the_run_is_recorded_and_listed_all_the_same() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let line = "run hold --duration 2 --out logs";
    let status = without_terminal(spawned(at, &board.port(), line)).wait().unwrap();
    assert_eq!(status.code(), Some(0));
    let dataset = Dataset::read(at.join("logs")).unwrap();
    assert_eq!(dataset.entries[0].file, "hold.csv.gz");
    assert!(dataset.recordings().unwrap()[0].log.len() > 1900);

    let status = without_terminal(spawned(at, &board.port(), TOO_FAST)).wait().unwrap();
    assert_eq!(status.code(), Some(2));
    assert_eq!(Dataset::read(at.join("logs")).unwrap().entries[1].file, "task.csv.gz");
    assert!(Log::read(at.join("logs/task.csv.gz")).unwrap().len() > 100);
}

#[test]
fn a_reference_that_leaves_the_joints_ranges_is_refused_with_its_time() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    let model = std::fs::read_to_string(at.join("model.toml")).unwrap();
    let with_limits = |limits: &str| {
        let limited = model.replacen("[robot]", &format!("[robot]\nlimits_rad = {limits}"), 1);
        std::fs::write(at.join("model.toml"), limited).unwrap();
    };
    with_limits("[[-1.0, 6.3], [-3.2, 0.1]]");
    assert_tells(&refused(rrr(at, &board, "upload model.toml")), &["has 2 pairs, but must have 3"]);
    with_limits("[[-1.0, 6.3], [-3.2, 0.1], [1.0, -1.0]]");
    assert_tells(&refused(rrr(at, &board, "upload model.toml")), &["limits_rad of joint 3"]);
    with_limits("[[-1.0, 6.3], [-3.2, 0.1], [-1.0, 1.0]]");
    let text = refused(rrr(at, &board, "upload model.toml --reference task"));
    assert_tells(&text, &["joint 3 leaves its range at ", " s of the reference", "limits_rad"]);
    rrr(at, &board, "upload model.toml").success();
    let text = refused(rrr(at, &board, "run task --out logs"));
    assert_tells(&text, &["joint 3 leaves its range at "]);
    rrr(at, &board, "run hold --duration 2 --out logs").success();
}
