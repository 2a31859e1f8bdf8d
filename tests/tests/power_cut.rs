//! QEMU is killed while the board commits blocks, and started again with the flash that is left.
#![allow(missing_docs)]

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use firmware::store::{Boot, Layout, RamFlash, Store};
use firmware::{Mode, ParameterBlock};
use simulation::board::{Board, Qemu, QemuSettings};
use tests::{image, minute_of, rig};

const KILLS: u32 = 40;

/// A block that differs from others by its number.
fn numbered(number: u32) -> ParameterBlock {
    let mode = Mode::ALL[number as usize % 5];
    ParameterBlock { command_limit_v: 1.0 + number as f32 / 1000.0, ..minute_of(&rig(), mode) }
}

/// What the board will find in this file.
fn left_in(file: &Path) -> Boot {
    let bytes = std::fs::read(file).unwrap();
    Store::new(RamFlash::new(bytes), Layout::G474.bank_start, Layout::G474).boot()
}

fn kill_after(delay: Duration, process: u32) -> std::thread::JoinHandle<()> {
    std::thread::spawn(move || {
        std::thread::sleep(delay);
        Command::new("kill").args(["-9", &process.to_string()]).status().unwrap();
    })
}

/// Commits blocks, from `number` on, until the board is gone; the last one acknowledged.
fn commit_until_killed(board: &mut Qemu, number: u32) -> u32 {
    let mut acknowledged = number - 1;
    while let Ok(sequence) = board.commit(&numbered(acknowledged + 1)) {
        assert_eq!(sequence, acknowledged + 1);
        acknowledged = sequence;
    }
    acknowledged
}

#[test]
fn killed_during_commits_the_board_begins_with_the_old_or_the_new_block() {
    let Some(image) = image() else { return };
    let directory = std::env::temp_dir().join(format!("rrr-power-cut-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let settings = QemuSettings { directory: Some(directory.clone()), ..QemuSettings::new(image) };
    let mut board = Qemu::start(&settings).unwrap();
    assert_eq!(board.boot().unwrap(), None, "the flash is empty at first");
    board.commit(&numbered(1)).unwrap();
    let begin = Instant::now();
    board.commit(&numbered(2)).unwrap();
    let commit = begin.elapsed();
    drop(board);

    let (mut acknowledged, mut ended_early, mut unfinished) = (2, 0, 0);
    for kill in 0..KILLS {
        let mut board = Qemu::start(&settings).unwrap();
        let found = board.boot().unwrap().expect("a block");
        assert!((acknowledged..=acknowledged + 1).contains(&found), "{found} of {acknowledged}");
        ended_early += found - acknowledged;
        // Anywhere within the first commit or the second.
        let killer = kill_after(commit * (2 * kill + 1) / KILLS, board.process());
        acknowledged = commit_until_killed(&mut board, found + 1);
        killer.join().unwrap();
        let left = left_in(&directory.join("flash.bin"));
        let number = ((left.block.command_limit_v - 1.0) * 1000.0).round() as u32;
        assert!((acknowledged..=acknowledged + 1).contains(&number), "{left}");
        assert_eq!(left.block, numbered(number), "a mixture");
        unfinished += u32::from(left.to_string().contains("because"));
    }
    println!(
        "a commit takes {commit:?}; {KILLS} kills: {unfinished} left an unfinished block, \
         {ended_early} a whole one that nobody had been told of"
    );
    assert!(unfinished > 0, "kills come in the middle of commits");
    let mut board = Qemu::start(&settings).unwrap();
    board.boot().unwrap();
    board.start().unwrap();
    assert!(board.tick(&[0; 3]).is_ok(), "the block that was found is in force");
    drop(board);
    std::fs::remove_dir_all(directory).unwrap();
}
