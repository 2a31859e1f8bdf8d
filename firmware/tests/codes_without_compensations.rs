//! A block without compensations gives the same codes as the firmware without compensations.
#![allow(missing_docs)]

mod common;

use common::block;
use crc::{CRC_32_ISO_HDLC, Crc};
use firmware::reference::{ConstantVelocity, FadeIn, FourierSeries, Injection, Motion, Noise};
use firmware::{Controller, Mode, ParameterBlock};

/// A motion of each kind, and noise on joint 3.
fn mixed(mode: Mode) -> ParameterBlock {
    let mut block = block(mode);
    block.reference.motion[1] = Motion::Fourier(FourierSeries {
        centre_rad: -1.2,
        period_s: 4.0,
        sine_rad: [0.5, -0.3, 0.2, 0.1, -0.05],
        cosine_rad: [-0.4, 0.2, 0.1, -0.1, 0.05],
        fade_in: FadeIn { duration_s: 1.0 },
    });
    block.reference.motion[2] = Motion::ConstantVelocity(ConstantVelocity {
        start_rad: -1.0,
        speeds_rad_per_s: [0.01, 0.5, 1.5].into_iter().collect(),
        leg_s: 0.8,
        ramp_s: 0.2,
    });
    let noise = Noise { rms_v: 0.3, bandwidth_hz: 200.0, seed: 5 };
    block.reference.injection[2] = Injection::Noise(noise);
    block
}

/// The checksum of the codes of twelve seconds, which end in braking and holding.
fn checksum(block: ParameterBlock) -> u32 {
    let crc = Crc::<u32>::new(&CRC_32_ISO_HDLC);
    let mut digest = crc.digest();
    let mut controller = Controller::new(block);
    controller.start();
    for k in 0..12_000 {
        let counts = [70 * k, -500 * (k % 700), 3 * k - (k * k) % 1117];
        for code in controller.tick(&counts).codes {
            digest.update(&code.0.to_le_bytes());
        }
    }
    digest.finalize()
}

#[test]
fn without_compensations_the_codes_are_those_of_version_1() {
    let found = Mode::ALL.map(|mode| [checksum(block(mode)), checksum(mixed(mode))]);
    let before = [
        [0x554e5884, 0x42aef7c3],
        [0xaaa433b3, 0xb5dc9bab],
        [0x36f01de4, 0x9dcb3a0f],
        [0xc50abb87, 0xc6b79694],
        [0xca60ea0f, 0x2a074429],
    ];
    assert_eq!(found, before, "{found:#010x?}");
}
