//! The parts in which the tick checks its block: together they hold every value.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use common::joint;
use firmware::block::{MAX_BYTES, MotorHeating, ParameterBlock, PositionLimits};
use firmware::checksum::CRC_32;
use firmware::compensation::{AngularHarmonic, Feedforward, InputInverse};
use firmware::reference::{Injection, Noise};
use firmware::{Angle, Mode};

/// A block with something in most lists.
fn block() -> ParameterBlock {
    let mut block = common::block(Mode::PdModel);
    let wave = AngularHarmonic { order: 8, phase: Angle::from_radians(0.4) };
    let cogging = Feedforward::Cogging { amplitude_v: 0.1, wave };
    let offset = InputInverse::DacOffset { offset_v: 0.05 };
    block.compensations = [0, 1, 2].map(|_| joint(&[cogging], &[offset]));
    block.safety.heating[2] = Some(MotorHeating { continuous_v: 2.0, time_constant_s: 10.0 });
    block.safety.position[1] =
        Some(PositionLimits { lower_rad: -7.0, upper_rad: 7.0, braking_rad_per_s2: 6.0 });
    let noise = Noise { rms_v: 0.05, bandwidth_hz: 100.0, seed: 3 };
    block.reference.injection[0] = Injection::Noise(noise);
    block
}

/// The block with a bit of its body flipped and its checksum put right, if it still is one.
fn flipped(bytes: &[u8], bit: usize) -> Option<ParameterBlock> {
    let mut bytes = bytes.to_vec();
    bytes[4 + bit / 8] ^= 1 << (bit % 8);
    let end = bytes.len() - 4;
    let checksum = CRC_32.checksum(&bytes[..end]).to_le_bytes();
    bytes[end..].copy_from_slice(&checksum);
    ParameterBlock::decode(&bytes).ok()
}

#[test]
fn every_bit_of_a_block_is_in_one_of_its_parts() {
    let block = block();
    let mut buffer = [0; MAX_BYTES];
    let bytes = block.encode(&mut buffer).unwrap().to_vec();
    let parts = block.fingerprints();
    let others = (0..8 * (bytes.len() - 8)).filter_map(|bit| flipped(&bytes, bit));
    let mut changed = 0;
    for other in others.filter(|other| *other != block) {
        assert_ne!(other.fingerprints(), parts, "{other:?}");
        changed += 1;
    }
    assert!(changed > 3000, "{changed}");
}
