//! How fast the loop runs: the firmware in QEMU or in this process, the robot around it.
#![allow(missing_docs)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rig::Rig;
use simulation::board::{Board, InProcess};
use simulation::sensor::counts;
use simulation::{Settings, SimulatedRobot};
use tests::{image, qemu, rig};

const TICKS: u32 = 2000;

/// Ticks of the motion (20)-(21) with the model; 1000 a second are real time.
fn drive(board: &mut dyn Board, rig: &Rig) {
    let plan = rig::plan::task(10.0).with_mode(firmware::Mode::PdModel);
    board.load(&plan.block(rig)).unwrap();
    board.start().unwrap();
    let start = [1.57, -1.57, 0.0];
    let mut robot = SimulatedRobot::at_rest(rig.model, start, &Settings::default());
    for _ in 0..TICKS {
        let seen = counts(robot.q_rad(), rig.encoder_counts_per_turn).map(|c| c as i32);
        let reply = board.tick(&seen).unwrap();
        robot.advance(&reply.codes.map(|code| f64::from(code.to_volts())));
    }
}

fn lockstep(criterion: &mut Criterion) {
    let rig = rig();
    let mut group = criterion.benchmark_group("closed loop, ticks");
    group.throughput(Throughput::Elements(u64::from(TICKS))).sample_size(20);
    group.bench_function("firmware in this process", |b| {
        b.iter(|| drive(&mut InProcess::default(), &rig));
    });
    if let Some(image) = image() {
        let mut board = qemu(&image);
        group.bench_function("firmware in QEMU", |b| b.iter(|| drive(&mut board, &rig)));
    }
    group.finish();
}

criterion_group!(benches, lockstep);
criterion_main!(benches);
