//! A run begins near its reference, and without a step.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use common::supervised::{RUN, armed, holding};
use firmware::Mode;
use firmware::reference::Reference;
use firmware::supervisor::{Health, OrderError};

#[test]
fn a_run_does_not_begin_far_from_its_reference() {
    let mut block = holding(Mode::Pd);
    block.reference = Reference::hold([0.0, 0.0, -0.7]);
    match armed(block.clone()).execute(RUN) {
        Err(OrderError::FarFromStart { joint: 3, distance_rad }) => {
            assert!((distance_rad + 0.7).abs() < 1e-5, "{distance_rad}");
        }
        other => panic!("{other:?}"),
    }
    block.mode = [Mode::OpenLoop; 3];
    assert_eq!(armed(block).execute(RUN), Ok(()), "it has no reference there");
}

#[test]
fn a_run_begins_near_its_reference_and_without_a_step() {
    for (off_rad, begins) in [(0.45, false), (0.06, false), (0.04, true), (-0.04, true)] {
        let mut block = holding(Mode::Pd);
        block.reference = Reference::hold([off_rad; 3]);
        let mut supervisor = armed(block);
        assert_eq!(supervisor.execute(RUN).is_ok(), begins, "{off_rad} rad");
        let mut before_v = 0.0;
        for tick in 1..=if begins { 600 } else { 0 } {
            let code = supervisor.tick(&[0; 3], Health::default()).codes[1];
            let change_v = (code.to_volts() - before_v).abs();
            assert!(change_v < 0.01, "{change_v} V in tick {tick}");
            before_v = code.to_volts();
        }
        assert!(!begins || (before_v - 80.0 * off_rad).abs() < 0.01, "{before_v} V in the end");
    }
}

#[test]
fn no_block_widens_the_start_beyond_a_tenth_of_a_radian() {
    let mut block = holding(Mode::Pd);
    block.safety.start_error_rad[2] = 0.11;
    let error = firmware::block::HardLimits::default().check(&block).unwrap_err();
    assert_eq!((error.name, error.joint), ("start_error_limit_rad", 3));
}
