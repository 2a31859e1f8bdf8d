//! Parameter blocks survive encoding and decoding; wrong ones are refused by name.
#![allow(missing_docs)]

mod common;

use common::block;
use firmware::block::{MAX_BYTES, ParameterBlock, VERSION};
use firmware::reference::{Injection, Motion, Noise};
use firmware::{BlockError, Mode};

fn encoded(block: &ParameterBlock) -> Vec<u8> {
    let mut buffer = [0; MAX_BYTES];
    block.encode(&mut buffer).unwrap().to_vec()
}

/// The name and joint in the refusal of a block.
fn refusal(change: impl FnOnce(&mut ParameterBlock)) -> (&'static str, u8) {
    let mut block = block(Mode::PdModel);
    change(&mut block);
    match ParameterBlock::decode(&encoded(&block)) {
        Err(BlockError::Parameter(error)) => (error.name, error.joint),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_block_survives_the_wire() {
    for mode in Mode::ALL {
        let block = block(mode);
        assert_eq!(ParameterBlock::decode(&encoded(&block)).unwrap(), block);
    }
}

#[test]
fn values_that_no_rig_has_are_refused_by_name() {
    assert_eq!(refusal(|b| b.robot.base.mx2r = f32::NAN), ("mx2r", 0));
    assert_eq!(refusal(|b| b.robot.base.zz3r = -0.1).1, 0);
    assert_eq!(refusal(|b| b.robot.friction[2].alpha0_v = 0.1), ("alpha1_V", 3));
    assert_eq!(refusal(|b| b.robot.friction[0].sigma0_v_per_rad = 0.0), ("sigma0_V_per_rad", 1));
    assert_eq!(
        refusal(|b| b.robot.torque_constant_nm_per_v[1] = -6.3),
        ("torque_constant_Nm_per_V", 2)
    );
    assert_eq!(
        refusal(|b| b.gains[1].proportional_v_per_rad = f32::INFINITY),
        ("proportional_gain_V_per_rad", 2)
    );
    assert_eq!(refusal(|b| b.command_limit_v = 11.0), ("command_limit_V", 0));
    assert_eq!(refusal(|b| b.sample_period_s = 0.0), ("sample_period_s", 0));
    assert_eq!(refusal(|b| b.encoder_counts_per_turn = 0), ("encoder_counts_per_rev", 0));
    assert_eq!(
        refusal(|b| b.velocity_bandwidth_rad_per_s[0] = 1e5),
        ("velocity_bandwidth_rad_per_s", 1)
    );
}

#[test]
fn references_that_cannot_be_played_are_refused_by_name() {
    let hold = Motion::Hold { angle_rad: 1e6 };
    assert_eq!(refusal(|b| b.reference.motion[1] = hold), ("angle_rad", 2));
    let quintic = Motion::Quintic { from_rad: 0.0, to_rad: 1.0, duration_s: 0.0 };
    assert_eq!(refusal(|b| b.reference.motion[0] = quintic), ("duration_s", 1));
    let noise = Injection::Noise(Noise { rms_v: 0.1, bandwidth_hz: 600.0, seed: 1 });
    assert_eq!(refusal(|b| b.reference.injection[2] = noise), ("noise bandwidth_Hz", 3));
}

#[test]
fn broken_bytes_are_refused() {
    let good = encoded(&block(Mode::Pd));
    for index in 0..good.len() {
        let mut bytes = good.clone();
        bytes[index] ^= 0x10;
        assert!(ParameterBlock::decode(&bytes).is_err(), "byte {index}");
        assert!(ParameterBlock::decode(&good[..index]).is_err(), "cut at {index}");
    }
}

#[test]
fn a_block_of_another_version_is_refused_as_such() {
    let mut bytes = encoded(&block(Mode::Pd));
    let end = bytes.len() - 4;
    bytes[0..2].copy_from_slice(&(VERSION + 1).to_le_bytes());
    let checksum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(&bytes[..end]);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    let error = ParameterBlock::decode(&bytes).unwrap_err();
    assert_eq!(error, BlockError::Version { found: VERSION + 1 });
    assert!(error.to_string().contains(&format!("version {}", VERSION + 1)), "{error}");
}
