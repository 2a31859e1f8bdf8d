//! How fast the simulated robot runs in closed loop with the board of this process:
//! ten integration steps a tick. It must reach 500 times real time on one core.
#![allow(missing_docs)]

use std::time::{Duration, Instant};

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use model::reference_robot::reference_robot;
use rig::plan::excitation;
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, record};

/// One second.
const TICKS: u32 = 1000;

fn run(rig: &Rig, plan: &Plan, ticks: u32) {
    let settings = Settings { substeps: 10, ..Settings::default() };
    let mut board = InProcess::default();
    record(&mut board, &plan.block(rig), &rig.model, &settings, ticks, &mut |_| {})
        .expect("the board of this process takes the block");
}

/// Simulated seconds per second: the best of many short runs, so that what else the
/// computer does counts little.
fn times_real_time(rig: &Rig, plan: &Plan) -> f64 {
    let run_timed = |_| {
        let begun = Instant::now();
        run(rig, plan, TICKS);
        begun.elapsed()
    };
    let fastest = (0..300).map(run_timed).min().unwrap_or(Duration::MAX);
    f64::from(TICKS) * rig.sample_period_s / fastest.as_secs_f64()
}

fn closed_loop(criterion: &mut Criterion) {
    let rig = Rig::new(reference_robot());
    let plan = excitation(1, 30.0);
    println!("simulator: {:.0} times real time on one core", times_real_time(&rig, &plan));
    let mut group = criterion.benchmark_group("simulator");
    group.throughput(Throughput::Elements(u64::from(TICKS)));
    group.bench_function("closed loop, one second in 1 ms ticks of 10 steps", |b| {
        b.iter(|| run(&rig, &plan, TICKS))
    });
    group.finish();
}

criterion_group!(benches, closed_loop);
criterion_main!(benches);
