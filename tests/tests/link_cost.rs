//! What the link costs the tick: nothing, however full the line is.
#![allow(missing_docs)]

use std::path::Path;

use firmware::block::MAX_BYTES;
use firmware::link::Command;
use firmware::supervisor::State;
use firmware::{Angle, Mode, ParameterBlock};
use host_tool::board::{Board, Qemu, QemuSettings};
use tests::operator::{Line, request, upload};
use tests::{image, minute_of, rig};

/// Ticks counted with each line.
const TICKS: usize = 3000;

/// What is on the line while the ticks are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Load {
    Idle,
    Telemetry,
    Valid,
    Broken,
}

/// The block that runs, with limits so wide that the encoders below are no fault.
fn block() -> ParameterBlock {
    let mut block = minute_of(&rig(), Mode::PdModel);
    block.safety.tracking_error_rad = [std::f32::consts::PI; 3];
    block.safety.saturation_s = 1e3;
    block.safety.stuck_travel_rad = 1e3;
    block
}

fn counts(tick: i32) -> [i32; 3] {
    [7 * tick, -5 * tick, 3 * tick]
}

/// A board that notes what each tick of its run costs.
struct Counted {
    board: Qemu,
    /// Counts of the timer in each tick since the run began.
    run: Vec<u32>,
}

impl Counted {
    /// A tick at the counts of the run's tick, or at rest before the run.
    fn tick(&mut self) {
        let reply = self.board.tick(&counts(self.run.len() as i32)).unwrap();
        if reply.reference != [Angle(0); 3] {
            self.run.push(reply.timer_counts);
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
    let mut counted = Counted { board: Qemu::start(&settings).unwrap(), run: Vec::new() };
    let mut line = Line::connect(&socket);
    std::fs::remove_dir_all(&directory).unwrap();

    let mut buffer = [0; MAX_BYTES];
    let block = block();
    let encoded = block.encode(&mut buffer).unwrap();
    line.greet(|| counted.tick());
    for command in upload(encoded).into_iter().chain([Command::Use]) {
        line.ask(command, || counted.tick()).unwrap();
    }
    line.ask(Command::Stream { on: load != Load::Idle }, || counted.tick()).unwrap();
    (0..300).for_each(|_| counted.tick());
    line.ask(Command::Arm, || counted.tick()).unwrap();
    line.ask(Command::Run { host_timeout_ms: None }, || counted.tick()).unwrap();

    let mut number = 1000;
    while counted.run.len() < TICKS {
        counted.tick();
        while matches!(load, Load::Valid | Load::Broken) && line.waiting() < 4096 {
            number += 1;
            let mut bytes = request(number, Command::Query);
            let middle = bytes.len() / 2;
            bytes[middle] ^= if load == Load::Broken { 0x10 } else { 0 };
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
        line.greet(|| counted.tick());
        line.ask(Command::Query, || counted.tick()).unwrap();
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
        if idle.is_empty() {
            idle.clone_from(&run);
        }
        // The timer counts 25.6 times an instruction: two readings differ by one count.
        let furthest = idle.iter().zip(&run).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(furthest < 0.05, "{load:?}: {furthest} instructions");
    }
}
