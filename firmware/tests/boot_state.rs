//! Which stored blocks, faults and keys a boot accepts.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use firmware::block::MAX_BYTES;
use firmware::link::{BlockStore, BootState, Origin};
use firmware::store::{Kind, Layout, RamFlash, Store, slot_record};
use firmware::supervisor::{Fault, FaultRecord, State};
use firmware::{Mode, ParameterBlock};

const LAYOUT: Layout = Layout::G474;
const FAULT: FaultRecord =
    FaultRecord { fault: Fault::Speed, joint: 2, tick: 9, value: 20.0, limit: 15.0 };

/// A flash with these blocks in its slots, the second one newer, whatever they are.
fn flash(blocks: [Option<ParameterBlock>; 2]) -> Vec<u8> {
    let mut bytes = vec![0xFF; LAYOUT.used_bytes() as usize];
    let pages = LAYOUT.pages(Kind::Parameters);
    for ((block, page), sequence) in blocks.into_iter().zip(pages).zip(1..) {
        let mut buffer = [0; MAX_BYTES];
        let Some(block) = block else { continue };
        let from = (page - LAYOUT.bank_start) as usize;
        let room = &mut bytes[from..from + LAYOUT.page_bytes as usize];
        slot_record(sequence, block.encode(&mut buffer).unwrap(), room);
    }
    bytes
}

fn store(bytes: Vec<u8>) -> Store<RamFlash<Vec<u8>>> {
    Store::new(RamFlash::new(bytes), LAYOUT.bank_start, LAYOUT)
}

/// The state of a board that boots with this, as every board boots.
fn state_after_boot(kept: &BootState) -> (State, Option<Fault>) {
    let mut supervisor = kept.supervisor();
    supervisor.booted(kept.report());
    (supervisor.state(), supervisor.fault().map(|record| record.fault))
}

fn good() -> ParameterBlock {
    common::block(Mode::PdModel)
}

/// Blocks that are whole, but beyond what a board allows.
fn beyond() -> Vec<ParameterBlock> {
    let mut blocks = vec![good(); 8];
    blocks[0].sample_period_s = 2e-3;
    blocks[1].gains[2].proportional_v_per_rad = 2e4;
    blocks[2].safety.speed_rad_per_s[0] = 1e9;
    blocks[3].safety.tracking_error_rad[1] = 3.0;
    blocks[4].safety.acceleration_rad_per_s2[1] = 1e6;
    blocks[5].safety.saturation_s = 1e3;
    blocks[6].safety.stuck_travel_rad = 1.0;
    blocks[7].safety.stuck_voltage_v = 11.0;
    blocks
}

#[test]
fn a_block_beyond_the_hard_limits_is_not_used_however_it_came_there() {
    for wrong in beyond() {
        let kept = BootState::read(&mut store(flash([Some(good()), Some(wrong.clone())])));
        assert_eq!((kept.origin, kept.block.clone()), (Origin::Older, good()));
        assert_eq!(state_after_boot(&kept), (State::Disarmed, None));
        let kept = BootState::read(&mut store(flash([Some(wrong), None])));
        assert_eq!((kept.origin, kept.corrupt), (Origin::SafeDefaults, true));
        assert_eq!(state_after_boot(&kept), (State::Faulted, Some(Fault::CorruptParameters)));
    }
}

#[test]
fn slots_that_are_both_damaged_are_a_fault_and_empty_ones_are_not() {
    let mut bytes = flash([Some(good()), Some(good())]);
    for page in LAYOUT.pages(Kind::Parameters) {
        bytes[(page - LAYOUT.bank_start) as usize + 100] ^= 1;
    }
    let kept = BootState::read(&mut store(bytes));
    assert_eq!(state_after_boot(&kept), (State::Faulted, Some(Fault::CorruptParameters)));
    let kept = BootState::read(&mut store(flash([None, None])));
    assert_eq!(state_after_boot(&kept), (State::Disarmed, None));
}

#[test]
fn a_fault_is_kept_in_the_flash_until_it_is_cleared() {
    let mut store = store(flash([Some(good()), None]));
    store.store_fault(Some(&FAULT)).unwrap();
    assert_eq!(
        state_after_boot(&BootState::read(&mut store)),
        (State::Faulted, Some(Fault::Speed))
    );
    assert_eq!(BootState::read(&mut store).fault, Some(FAULT));
    store.store_fault(None).unwrap();
    assert_eq!(state_after_boot(&BootState::read(&mut store)), (State::Disarmed, None));
}

#[test]
fn a_fault_that_another_firmware_kept_is_latched_all_the_same() {
    for record in [&[0][..], &[1, 99], &[2, 3, 2, 9], &[0xFF; 12]] {
        let mut store = store(flash([Some(good()), None]));
        store.write_note(Kind::Fault, record).unwrap();
        assert_eq!(state_after_boot(&BootState::read(&mut store)).0, State::Faulted, "{record:?}");
    }
}
