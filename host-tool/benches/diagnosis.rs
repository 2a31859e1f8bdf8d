//! What a diagnosis costs against the length of the logs: three joints at 1 kHz, cogging
//! hidden on joint 3. Tells time, processor time and peak memory of a first one, then
//! criterion repeats it.
#![allow(missing_docs)]

use std::fs;
use std::time::Instant;

use criterion::{BenchmarkId, Criterion, SamplingMode, criterion_group, criterion_main};
use diagnosis::{Criteria, diagnose};
use files::{RobotFile, Role};
use model::reference_robot::reference_robot;
use recordings::{Campaign, Trace};
use rig::Rig;
use rig::effects::Catalogue;
use rig::plan::{Plan, driven_noise, excitation, slow, task};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

/// Lengths of all logs together [s].
const LENGTHS_S: [f32; 4] = [18.0, 36.0, 72.0, 144.0];

/// The experiments of the recipe `gap`, which take 72 s, made longer or shorter.
fn plans(length_s: f32) -> Vec<Plan> {
    let part = length_s / 72.0;
    vec![
        excitation(1, 20.0 * part),
        slow(20.0 * part),
        driven_noise(12.0 * part, 1),
        task(10.0 * part),
        excitation(2, 10.0 * part).with_role(Role::Holdout),
    ]
}

fn campaign(length_s: f32) -> Campaign {
    let rig = Rig::new(reference_robot());
    let cogging =
        rig::effects::table_from_text("cogging:3:amplitude_V=0.15,harmonic=8,phase_rad=0.9")
            .expect("an effect");
    let counts = f64::from(rig.encoder_counts_per_turn);
    let trace = |plan: &Plan| {
        let block = plan.block(&rig);
        let effects = vec![Catalogue::standard().effect_of(&cogging).expect("its values fit")];
        let (start, settings) = (start_of(&block), Settings::default());
        let robot = SimulatedRobot::with_effects(rig.model, effects, start, &settings);
        let (mut board, ticks) = (InProcess::default(), plan.ticks(&rig));
        let recording = record_robot(&mut board, &block, robot, ticks, &mut |_| {})
            .expect("the board of this process takes the block");
        Trace::of_log(recording.log, plan.entry("csv"), counts)
    };
    let traces = plans(length_s).iter().map(trace).collect();
    Campaign::new(RobotFile::from_robot(&rig.model), Some(counts), traces).expect("a whole model")
}

fn run(campaign: &Campaign) {
    diagnose(campaign, &Catalogue::standard(), &Criteria::default(), &|_| ())
        .expect("the logs can be used");
}

/// Processor time of this process [s]; `None` where the system does not tell.
fn processor_s() -> Option<f64> {
    const TICKS_PER_S: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    let after_name = stat.rsplit_once(')')?.1;
    let fields: Vec<&str> = after_name.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) / TICKS_PER_S)
}

/// Most memory that was in use since the last call of `forget_peak` [MB].
fn peak_mb() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kilobytes * 1.024e-3)
}

fn forget_peak() {
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// Runs it once and tells what it took.
fn tell(campaign: &Campaign, length_s: f32) {
    forget_peak();
    let (before_s, begun) = (processor_s().unwrap_or(f64::NAN), Instant::now());
    run(campaign);
    let elapsed_s = begun.elapsed().as_secs_f64();
    let used_s = processor_s().unwrap_or(f64::NAN) - before_s;
    println!(
        "diagnosis of {length_s} s: {elapsed_s:.1} s, processor {used_s:.1} s, peak {:.0} MB",
        peak_mb().unwrap_or(f64::NAN)
    );
}

fn diagnosis(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("diagnosis");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(std::time::Duration::from_millis(1));
    for length_s in LENGTHS_S {
        let campaign = campaign(length_s);
        let mut printed = false;
        group.bench_function(BenchmarkId::from_parameter(format!("{length_s} s")), |bench| {
            if !std::mem::replace(&mut printed, true) {
                tell(&campaign, length_s);
            }
            bench.iter(|| run(&campaign));
        });
    }
    group.finish();
}

criterion_group!(benches, diagnosis);
criterion_main!(benches);
