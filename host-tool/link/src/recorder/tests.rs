//! Records in, rows and what is missing out.

use super::*;
use firmware::link::Counters;
use firmware::supervisor::{Fault, FaultRecord};
use firmware::{Angle, DacCode};

use rig::{Rig, plan};

fn record(sequence: u32, state: State) -> Telemetry {
    Telemetry {
        sequence,
        counts: [i32::MAX.wrapping_add(sequence as i32), 0, -5],
        codes: [DacCode(0), DacCode(16384), DacCode(0)],
        reference: [Angle(0); 3],
        mode: [Mode::Pd; 3],
        state,
        saturated: 0b100,
        fault: None,
        tick_time_tenth_us: 400,
        dropped: 7 + sequence / 10,
    }
}

fn block() -> ParameterBlock {
    plan::hold(0.02).block(&Rig::new(model::reference_robot::reference_robot()))
}

#[test]
fn what_is_missing_is_a_gap_and_counted() {
    let mut recorder = Recorder::new(&block(), 20);
    recorder.add_record(&record(0, State::Armed));
    for sequence in (1..30).filter(|s| !(5..8).contains(s)) {
        recorder.add_record(&record(sequence, State::Running));
    }
    assert_eq!(recorder.ticks_seen(), 29);
    assert_eq!(recorder.log.len(), 17);
    assert_eq!((recorder.missed(), recorder.dropped()), (3, 2));
    assert_eq!(recorder.saturated, [0, 0, 17]);
    assert_eq!(recorder.log.time_s[4..6], [0.007, 0.008]);
    assert_eq!(recorder.log.time_s.last(), Some(&0.019));
    assert_eq!(recorder.log.joints[1].command_v[0], 5.0);
}

fn report(ticks: u32, state: State) -> Report {
    let counters = Counters { ticks, telemetry_dropped: 7 + ticks / 10, ..Counters::default() };
    let position_known = [true; 3];
    Report { state, fault: None, position_known, parameters: None, has_key: false, counters }
}

#[test]
fn records_lost_at_the_beginning_are_missing() {
    let mut recorder = Recorder::new(&block(), 20);
    recorder.begins_after(&report(98, State::Armed));
    recorder.expect_run();
    recorder.add_record(&record(98, State::Running)); // of an earlier run
    recorder.add_record(&record(101, State::Armed));
    for sequence in 106..130 {
        recorder.add_record(&record(sequence, State::Running));
    }
    recorder.add_report(&report(140, State::Disarmed));
    assert_eq!((recorder.log.len(), recorder.missed(), recorder.ticks_done()), (16, 4, 20));
    assert_eq!(recorder.log.time_s[0], 0.004);
    assert_eq!(recorder.dropped(), 2);
    assert_eq!(recorder.board.len(), 16);
}

#[test]
fn records_lost_before_a_fault_are_missing() {
    let mut recorder = Recorder::new(&block(), 20);
    recorder.begins_after(&report(100, State::Armed));
    recorder.expect_run();
    (101..105).for_each(|sequence| recorder.add_record(&record(sequence, State::Running)));
    let fault = FaultRecord { fault: Fault::Speed, joint: 2, tick: 111, value: 2.0, limit: 1.0 };
    recorder.add_report(&Report { fault: Some(fault), ..report(150, State::Faulted) });
    assert_eq!((recorder.log.len(), recorder.missed(), recorder.ticks_done()), (4, 6, 10));
    let fault = Some((Fault::Speed, 2));
    recorder.add_record(&Telemetry { fault, ..record(113, State::Faulted) });
    recorder.add_record(&Telemetry { fault, ..record(114, State::Faulted) });
    assert_eq!((recorder.log.len(), recorder.missed(), recorder.ticks_done()), (4, 6, 10));
    let [.., last] = recorder.board.as_slice() else { panic!() };
    assert_eq!((last.t_s, last.fault, last.fault_joint), (0.012, "speed", 2));
    assert_eq!(recorder.board.len(), 5);
}

#[test]
fn records_lost_before_a_stop_are_missing() {
    let mut recorder = Recorder::new(&block(), 20);
    recorder.begins_after(&report(100, State::Armed));
    recorder.expect_run();
    (101..105).for_each(|sequence| recorder.add_record(&record(sequence, State::Running)));
    recorder.add_report(&report(112, State::Disarmed));
    assert_eq!((recorder.missed(), recorder.ticks_done()), (8, 12));
    recorder.add_record(&record(108, State::Armed));
    assert_eq!((recorder.missed(), recorder.ticks_done()), (3, 7));
}

#[test]
fn a_run_of_which_no_record_came_ends_by_the_reports_alone() {
    let mut recorder = Recorder::new(&block(), 20);
    recorder.begins_after(&report(100, State::Armed));
    recorder.expect_run();
    recorder.add_report(&report(100, State::Running));
    assert_eq!(recorder.ticks_seen(), 0);
    recorder.add_report(&report(130, State::Running));
    assert_eq!((recorder.ticks_seen(), recorder.missed(), recorder.ticks_done()), (30, 20, 20));
    recorder.add_report(&report(140, State::Disarmed));
    assert_eq!((recorder.missed(), recorder.dropped()), (20, 4));
}

#[test]
fn counts_do_not_wrap() {
    let mut recorder = Recorder::new(&block(), 5);
    (0..5).for_each(|sequence| recorder.add_record(&record(sequence, State::Running)));
    let Position::Count(counts) = &recorder.log.joints[0].position else { panic!() };
    let first = i64::from(i32::MAX);
    assert_eq!(*counts, [first, first + 1, first + 2, first + 3, first + 4]);
}

#[test]
fn a_run_that_took_no_tick_has_none_missing() {
    // A fault in the first tick: 100 records of a faulted board, then a report.
    let mut recorder = Recorder::new(&block(), 20);
    recorder.begins_after(&report(98, State::Armed));
    recorder.expect_run();
    recorder.add_record(&record(99, State::Armed));
    (100..200).for_each(|sequence| recorder.add_record(&record(sequence, State::Faulted)));
    recorder.add_report(&report(200, State::Disarmed));
    assert_eq!((recorder.ticks_done(), recorder.missed()), (0, 0));
    // Ctrl-C before the run command: what the board reports then is of no run.
    let mut recorder = Recorder::new(&block(), 20);
    recorder.begins_after(&report(98, State::Armed));
    recorder.add_record(&record(96, State::Armed));
    recorder.add_report(&report(102, State::Disarmed));
    assert_eq!((recorder.ticks_done(), recorder.missed()), (0, 0));
}
