//! What the link costs the tick: nothing, however full the line is.
#![allow(missing_docs)]

use std::path::Path;

use firmware::block::MAX_BYTES;
use firmware::link::Command;
use firmware::supervisor::State;
use firmware::{Angle, Mode, ParameterBlock};
use simulation::board::{Board, Qemu, QemuSettings};
use simulation::start_of;
use tests::operator::{Line, request, upload};
use tests::{image, minute_of, rig};

/// Ticks counted with each line.
const TICKS: usize = 3000;
/// From counts in to codes out on average, supervisor included, with everything on.
const MOST_INSTRUCTIONS: f64 = 700.0;
/// Among broken requests, the host's signs of life.
const WHOLE_ONE_IN: u32 = 100;
const COUNTS_PER_TURN: u32 = 655_360;

/// What is on the line while the ticks are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Load {
    Idle,
    Telemetry,
    Valid,
    Broken,
}

/// Where an arm is at rest whose reference is about to begin.
fn start(block: &ParameterBlock) -> [i32; 3] {
    start_of(block).map(|q_rad| Angle::from_radians(q_rad as f32).in_counts(COUNTS_PER_TURN))
}

/// A board that notes what each tick of its run costs.
struct Counted {
    board: Qemu,
    /// The encoders of an arm that follows its reference a tick later.
    counts: [i32; 3],
    /// Where the reference was.
    last: Option<[Angle; 3]>,
    /// Counts of the timer in each tick since the run began.
    run: Vec<u32>,
}

impl Counted {
    /// A tick of the run, or at rest before the run.
    fn tick(&mut self) {
        let reply = self.board.tick(&self.counts).unwrap();
        if reply.reference == [Angle(0); 3] {
            return;
        }
        self.run.push(reply.timer_counts);
        let last = self.last.replace(reply.reference).unwrap_or(reply.reference);
        for i in 0..3 {
            let moved = Angle(reply.reference[i].0.wrapping_sub(last[i].0));
            self.counts[i] += moved.in_counts(COUNTS_PER_TURN);
        }
    }
}

/// The cost of each tick of a run, and the line afterwards.
fn ticks_with(load: Load, image: &Path) -> (Counted, Line) {
    let directory = std::env::temp_dir().join(format!("rrr-link-{load:?}-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let socket = directory.join("line");
    let mut settings = QemuSettings::new(image);
    settings.serial = format!("unix:{},server=on,wait=off", socket.display());
    let block = minute_of(&rig(), Mode::PdModel);
    let board = Qemu::start(&settings).unwrap();
    let mut counted = Counted { board, counts: start(&block), last: None, run: Vec::new() };
    let mut line = Line::connect(&socket);
    std::fs::remove_dir_all(&directory).unwrap();

    let mut buffer = [0; MAX_BYTES];
    let encoded = block.encode(&mut buffer).unwrap();
    line.handshake(|| counted.tick());
    for command in upload(encoded).into_iter().chain([Command::Use]) {
        line.request(command, || counted.tick()).unwrap();
    }
    line.request(Command::Stream { on: load != Load::Idle }, || counted.tick()).unwrap();
    (0..300).for_each(|_| counted.tick());
    line.request(Command::Arm, || counted.tick()).unwrap();
    line.request(Command::Run { host_timeout_ms: None }, || counted.tick()).unwrap();

    let mut number = 1000;
    while counted.run.len() < TICKS {
        counted.tick();
        while matches!(load, Load::Valid | Load::Broken) && line.waiting() < 4096 {
            number += 1;
            let mut bytes = request(number, Command::Query);
            let middle = bytes.len() / 2;
            // One in so many is whole, so that the host is heard.
            let is_broken = load == Load::Broken && !number.is_multiple_of(WHOLE_ONE_IN);
            bytes[middle] ^= if is_broken { 0x10 } else { 0 };
            line.send(&bytes);
        }
        line.exchange();
    }
    (counted, line)
}

#[test]
fn the_tick_costs_the_same_whatever_the_line_carries() {
    let Some(image) = image() else { return };
    let mut idle = Vec::new();
    println!("{:10} {:>8} {:>8} {:>10} {:>10}", "line", "mean", "worst", "requests", "broken");
    for load in [Load::Idle, Load::Telemetry, Load::Valid, Load::Broken] {
        let (mut counted, mut line) = ticks_with(load, &image);
        let run: Vec<f64> = counted.run[..TICKS].iter().map(|c| f64::from(*c) / 25.6).collect();
        // The board is still itself, and tells what it has seen.
        while line.waiting() > 0 {
            counted.tick();
            line.exchange();
        }
        line.handshake(|| counted.tick());
        line.request(Command::Query, || counted.tick()).unwrap();
        let report = line.report.unwrap();
        let counters = report.counters;
        assert_eq!((report.state, report.fault), (State::Running, None), "{load:?}");
        assert!(load != Load::Valid || counters.requests > 100, "{counters:?}");
        assert!(load != Load::Broken || counters.frames_broken > 100, "{counters:?}");
        assert!(load == Load::Idle || line.records > TICKS as u32 / 2, "{}", line.records);
        let (mean, worst) =
            (run.iter().sum::<f64>() / TICKS as f64, run.iter().fold(0.0, |a: f64, b| a.max(*b)));
        let (requests, broken) = (counters.requests, counters.frames_broken);
        let name = format!("{load:?}").to_lowercase();
        println!("{name:10} {mean:8.1} {worst:8.1} {requests:10} {broken:10}");
        assert!(mean < MOST_INSTRUCTIONS, "{mean} instructions from counts to codes");
        if idle.is_empty() {
            idle.clone_from(&run);
        }
        // The timer counts 25.6 times an instruction: two readings differ by one count.
        let furthest = idle.iter().zip(&run).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(furthest < 0.05, "{load:?}: {furthest} instructions");
    }
}
