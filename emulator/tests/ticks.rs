//! What the tick costs in each reference and mode: `cargo xtask emulate --ticks` prints it.
#![allow(missing_docs)]

mod common;

use std::collections::BTreeMap;
use std::rc::Rc;

use common::{board_with_arm, commit, home_and_run, image, rig_that_compensates};
use emulator::handler::{Cost, Handler, Run};
use emulator::image::Image;
use emulator::registers::rcc::Reset;
use firmware::reference::{Injection, Noise};
use firmware::supervisor::ParameterWatch;
use firmware::{Mode, ParameterBlock};
use model::reference_robot::reference_robot;
use rig::{Plan, Rig, plan};
use simulation::start_of;

/// Ticks between two registers of the converter that are read back.
const WATCH_EVERY_TICKS: u64 = 16;
/// Instructions from the handler's first to the first code, friction of the measured motion included.
const MOST_TO_CODES: u64 = 1400;

/// How long each motion is played; `RRR_TICKS` has more of it.
fn milliseconds() -> u64 {
    if std::env::var_os("RRR_TICKS").is_some() { 4000 } else { 300 }
}

/// Everything on: a Fourier series and noise on all joints.
fn driven(mode: Mode) -> Plan {
    plan::driven_noise(60.0, 1).with_mode(mode)
}

/// What is played: its name, and the block.
fn blocks() -> Vec<(String, ParameterBlock)> {
    let rig = Rig::new(reference_robot());
    let references = [
        ("validation motion, eq. (20)-(21)", plan::task(20.0)),
        ("Fourier series", plan::excitation(1, 20.0)),
        ("constant velocity, one joint", plan::constant_velocity(2)),
        ("friction excitation, one joint", plan::friction_excitation(&rig)),
        ("pre-sliding noise, one joint", plan::presliding_noise(&rig, 1, 1)),
    ];
    let mut blocks: Vec<_> = references
        .into_iter()
        .map(|(name, plan)| {
            (format!("{name}, pd-model"), plan.with_mode(Mode::PdModel).block(&rig))
        })
        .collect();
    for mode in [Mode::PdModel, Mode::PdFriction, Mode::Pd] {
        let name = format!("Fourier series and noise, {}", mode.name());
        blocks.push((name, driven(mode).block(&rig)));
    }
    for mode in [Mode::FrictionOnly, Mode::OpenLoop] {
        let mut plan = driven(mode);
        for injection in &mut plan.reference.injection {
            *injection = Injection::Noise(Noise { rms_v: 0.02, bandwidth_hz: 200.0, seed: 9 });
        }
        blocks.push((format!("noise of 20 mV, {}", mode.name()), plan.block(&rig)));
    }
    let name = "Fourier series and noise, pd-model, twelve compensations".to_owned();
    blocks.push((name, driven(Mode::PdModel).block(&rig_that_compensates())));
    blocks
}

/// Runs that put codes out, with their numbers, and the spread of LDAC [cycles].
struct Played {
    runs: Vec<(u64, Run)>,
    latency: (u64, u64),
}

fn played(image: &Rc<Image>, block: &ParameterBlock) -> Played {
    let start = start_of(block);
    let mut board = board_with_arm(image, start);
    board.run_ms(50).unwrap();
    commit(&mut board, block);
    board.machine.reset(Reset::Pin).unwrap();
    home_and_run(&mut board, start);
    board.machine.board().trace.ticks.clear();
    board.machine.board().trace.handler = Handler::keeping();
    board.run_ms(milliseconds()).unwrap();
    let report = board.query().unwrap().unwrap();
    assert_eq!(report.fault, None);
    let machine = board.machine.board();
    let latencies = machine.trace.ticks.iter().filter_map(|tick| tick.latency);
    let latency = latencies.fold((u64::MAX, 0), |(a, b), x| (a.min(x), b.max(x)));
    Played { runs: machine.trace.handler.kept.clone(), latency }
}

/// Neither a register of the converter nor the parameters are checked in it.
fn is_ordinary(number: u64) -> bool {
    !number.is_multiple_of(WATCH_EVERY_TICKS) && !ParameterWatch::is_due(number as u32)
}

/// Mean and worst instructions and cycles.
fn row(costs: impl Iterator<Item = Cost> + Clone) -> String {
    let (mut sum, mut most, mut runs) = (Cost::default(), Cost::default(), 0);
    for Cost { instructions, cycles } in costs {
        runs += 1;
        sum = Cost { instructions: sum.instructions + instructions, cycles: sum.cycles + cycles };
        most.instructions = most.instructions.max(instructions);
        most.cycles = most.cycles.max(cycles);
    }
    let mean = |sum: u64| sum / runs.max(1);
    let (instructions, cycles) = (mean(sum.instructions), mean(sum.cycles));
    format!("{instructions} / {} | {cycles} / {}", most.instructions, most.cycles)
}

#[test]
fn the_tick_costs_what_the_tables_say() {
    let Some(image) = image() else { return };
    println!("mean / worst; ordinary ticks, then those that check a part of the parameters");
    println!(
        "| played | to codes, instructions | cycles | whole tick, instructions | cycles | whole with a part checked, instructions | cycles | timer to LDAC, cycles |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for (name, block) in blocks() {
        let Played { runs, latency } = played(&image, &block);
        assert!(runs.len() as u64 + 40 > milliseconds(), "{name}: {}", runs.len());
        let ordinary = runs.iter().filter(|(number, _)| is_ordinary(*number)).map(|(_, run)| run);
        let checked = runs.iter().filter(|(number, _)| ParameterWatch::is_due(*number as u32));
        assert_eq!(latency.0, latency.1, "{name}: LDAC has no jitter");
        let longest = ordinary.clone().map(|run| run.to_codes.instructions).max().unwrap_or(0);
        assert!(longest < MOST_TO_CODES, "{name}: {longest}");
        let to_codes = row(ordinary.clone().map(|run| run.to_codes));
        let whole = row(ordinary.map(|run| run.whole));
        let checks = row(checked.map(|(_, run)| run.whole));
        println!("| {name} | {to_codes} | {whole} | {checks} | {} to {} |", latency.0, latency.1);
    }
}

/// Instructions of a tick by function, on average over all ticks of the run; those in the image's
/// table of symbols, with what the compiler has put into them.
#[test]
fn the_tick_by_function() {
    let Some(image) = image() else { return };
    let block =
        plan::excitation(1, 20.0).with_mode(Mode::PdModel).block(&Rig::new(reference_robot()));
    let start = start_of(&block);
    let mut board = board_with_arm(&image, start);
    board.run_ms(50).unwrap();
    commit(&mut board, &block);
    home_and_run(&mut board, start);
    board.machine.board().trace.handler = Handler::keeping();
    board.run_ms(milliseconds()).unwrap();
    let handler = board.machine.board().trace.handler.clone();
    let mut functions: BTreeMap<String, u64> = BTreeMap::new();
    for (address, times) in &handler.executed {
        let place = image.place(*address);
        let name = place.split('+').next().unwrap_or_default().to_owned();
        *functions.entry(name).or_default() += times;
    }
    let mut functions: Vec<_> = functions.into_iter().collect();
    functions.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
    for (name, times) in functions {
        println!("{:8.1} {name}", times as f64 / handler.runs as f64);
    }
}
