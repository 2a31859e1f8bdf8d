//! Outputs that are not what their codes say, found by measuring them.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use common::supervised::{RUN, armed, holding};
use firmware::reference::{Injection, Noise, Reference};
use firmware::supervisor::{
    Fault, FaultRecord, Health, Kept, Order, State, Supervisor, TickRecord,
};
use firmware::{DacCode, Mode, ParameterBlock};

/// The tick from which on the outputs are not right.
const FROM: u32 = 100;

/// Volts of codes.
fn volts(record: &TickRecord) -> [f32; 3] {
    record.codes.map(DacCode::to_volts)
}

/// A tick that measures, before its codes act, what `output_v` makes of those of the tick before.
fn tick(
    supervisor: &mut Supervisor,
    before: &TickRecord,
    counts: &[i32; 3],
    output_v: impl Fn([f32; 3]) -> [f32; 3],
) -> TickRecord {
    let record = supervisor.tick(counts, Health::default());
    let is_well = supervisor.outputs_measured(&output_v(volts(before)), &record);
    assert_eq!(is_well, supervisor.fault().is_none());
    record
}

/// Noise of 1 V at every joint, none of which has a reference.
fn noise() -> ParameterBlock {
    let mut block = holding(Mode::OpenLoop);
    block.reference.injection =
        [Injection::Noise(Noise { rms_v: 1.0, bandwidth_hz: 200.0, seed: 3 }); 3];
    block
}

/// All joints 0.04 rad off: feedback grows to 3.2 V within half a second.
fn growing() -> ParameterBlock {
    ParameterBlock { reference: Reference::hold([0.04; 3]), ..holding(Mode::Pd) }
}

/// Plays so many ticks; how many after [`FROM`] the fault was found, and its record.
fn found(
    block: ParameterBlock,
    ticks: u32,
    output_v: impl Fn(u32, [f32; 3]) -> [f32; 3],
) -> Option<(u32, FaultRecord)> {
    let mut supervisor = armed(block);
    supervisor.execute(RUN).unwrap();
    let mut record = supervisor.tick(&[0; 3], Health::default());
    assert!(supervisor.outputs_measured(&[0.0; 3], &record));
    for number in 1..ticks {
        let k = number as i32;
        let dither = [7 * (k % 3), -(k % 5), 2 * (k % 2)];
        record = tick(&mut supervisor, &record, &dither, |code_v| match number {
            0..FROM => code_v,
            _ => output_v(number - FROM, code_v),
        });
        if let Some(fault) = supervisor.fault() {
            assert_eq!(supervisor.state(), State::Faulted);
            assert_eq!(supervisor.codes(), None, "0 V in the tick that finds it");
            return Some((number - FROM + 1, fault));
        }
    }
    None
}

/// After how many ticks the fault was found, which must be at output 2.
fn ticks_to(found: Option<(u32, FaultRecord)>) -> u32 {
    let (ticks, record) = found.expect("a fault");
    println!("after {ticks} ticks: {record}");
    assert_eq!((record.fault, record.joint), (Fault::OutputVoltage, 2));
    assert!(record.value.is_nan() || record.value > record.limit);
    assert_eq!(record.limit, 0.75);
    ticks
}

#[test]
fn outputs_that_are_right_but_for_the_resistors_are_no_fault() {
    let resistors = |_, code_v: [f32; 3]| code_v.map(|v| 1.03 * v + 0.15);
    assert_eq!(found(noise(), 5_000, resistors), None);
    assert_eq!(found(growing(), 450, resistors), None);
}

#[test]
fn an_output_at_another_voltage_is_found_in_five_ticks() {
    assert_eq!(ticks_to(found(noise(), 1_000, |_, [a, _, c]| [a, 6.0, c])), 5);
    assert_eq!(ticks_to(found(noise(), 1_000, |_, [a, _, c]| [a, f32::NAN, c])), 5, "no number");
    assert_eq!(ticks_to(found(noise(), 1_000, |_, [a, _, c]| [a, -10.9, c])), 5, "no counts");
}

#[test]
fn an_output_that_sticks_is_found_once_its_code_is_elsewhere() {
    let mut supervisor = armed(growing());
    supervisor.execute(RUN).unwrap();
    let codes: Vec<_> =
        (0..500).map(|_| volts(&supervisor.tick(&[0; 3], Health::default()))).collect();
    let stuck_v = codes[FROM as usize - 1][1];
    let elsewhere = codes.iter().position(|code_v| code_v[1] - stuck_v > 0.75).unwrap() as u32;
    let ticks = ticks_to(found(growing(), 500, |_, [a, _, c]| [a, stuck_v, c]));
    // Measured a tick later than it was put out, then five times.
    assert!(ticks.abs_diff(elsewhere - FROM + 6) <= 1, "{ticks}, {elsewhere}");
}

#[test]
fn a_few_disturbed_samples_stop_nothing() {
    let disturbed = |number: u32, [a, b, c]: [f32; 3]| [a, if number % 5 < 4 { 9.9 } else { b }, c];
    assert_eq!(found(noise(), 3_000, disturbed), None);
}

#[test]
fn outputs_are_watched_while_the_amplifiers_are_enabled() {
    let mut supervisor = armed(noise());
    let quiet = supervisor.tick(&[0; 3], Health::default());
    for state in [State::Armed, State::Disarmed] {
        if state == State::Disarmed {
            supervisor.execute(Order::ClearFault).unwrap();
        }
        let ticks = (1..=100).find(|_| {
            tick(&mut supervisor, &quiet, &[0; 3], |_| [2.0, 0.0, 0.0]);
            supervisor.fault().is_some()
        });
        assert_eq!(ticks, (state == State::Armed).then_some(5), "{state}");
    }
}

#[test]
fn what_is_kept_over_a_reset_is_that_it_is_armed_then_the_fault() {
    let mut supervisor = armed(noise());
    assert_eq!(supervisor.kept(), Kept::Armed);
    supervisor.execute(RUN).unwrap();
    assert_eq!(supervisor.kept(), Kept::Armed);
    supervisor.execute(Order::Disarm).unwrap();
    assert_eq!(supervisor.kept(), Kept::Nothing);
    supervisor.execute(Order::Arm).unwrap();
    supervisor.tick(&[0; 3], Health { emergency_stop: true, ..Health::default() });
    assert_eq!(supervisor.kept().fault().map(|record| record.fault), Some(Fault::EmergencyStop));
}
