//! Blocks that hold compensations.
#![allow(missing_docs)]

mod common;

use common::{block, joint};
use firmware::block::MAX_BYTES;
use firmware::compensation::{
    AngularHarmonic, Compensations, ExternalLoad, Feedforward, InputInverse, MAX_FEEDFORWARD,
    MAX_INPUT_INVERSES, MAX_KNOTS, MAX_TABLES, Table, TableAxis,
};
use firmware::reference::{ConstantVelocity, Injection, MAX_SPEEDS, Motion, Noise};
use firmware::{Angle, BlockError, Controller, DacCode, Mode, ParameterBlock};
use model::effects::Tilt;
use proptest::prelude::*;

const WAVE: AngularHarmonic = AngularHarmonic { order: 8, phase: Angle(1 << 28) };
const COGGING: Feedforward = Feedforward::Cogging { amplitude_v: 0.2, wave: WAVE };
const OFFSET: InputInverse = InputInverse::DacOffset { offset_v: 0.3 };

fn encoded(block: &ParameterBlock) -> Vec<u8> {
    let mut buffer = [0; MAX_BYTES];
    block.encode(&mut buffer).unwrap().to_vec()
}

/// The name and joint in the refusal of a block whose joint 2 has these.
fn refusal(second: Compensations) -> (&'static str, u8) {
    let mut block = block(Mode::PdModel);
    block.compensations[1] = second;
    match ParameterBlock::decode(&encoded(&block)) {
        Err(BlockError::Parameter(error)) => (error.name, error.joint),
        other => panic!("{other:?}"),
    }
}

#[test]
fn values_out_of_their_range_are_refused_by_name() {
    let fed = |effect| refusal(joint(&[COGGING, effect], &[]));
    let undone = |effect| refusal(joint(&[], &[OFFSET, effect]));
    let wave = |harmonic| AngularHarmonic { order: harmonic, phase: Angle(0) };
    let cogging =
        |amplitude_v, harmonic| Feedforward::Cogging { amplitude_v, wave: wave(harmonic) };
    assert_eq!(fed(cogging(f32::NAN, 1)), ("cogging amplitude_V", 2));
    assert_eq!(fed(cogging(0.1, 0)), ("cogging harmonic", 2));
    assert_eq!(fed(cogging(0.1, 1001)), ("cogging harmonic", 2));
    let friction = Feedforward::PositionFriction { relative_amplitude: 1.0, wave: WAVE };
    assert_eq!(fed(friction), ("position_friction relative_amplitude", 2));
    let asymmetric = Feedforward::AsymmetricFriction { relative_asymmetry: -1.0 };
    assert_eq!(fed(asymmetric), ("asymmetric_friction relative_asymmetry", 2));
    let spring = Feedforward::CableSpring { stiffness_v_per_rad: 0.1, rest_rad: f32::INFINITY };
    assert_eq!(fed(spring), ("cable_spring rest_rad", 2));
    let drag = Feedforward::QuadraticDrag { coefficient_v_s2_per_rad2: -0.1 };
    assert_eq!(fed(drag), ("quadratic_drag coefficient_V_s2_per_rad2", 2));
    let constant = InputInverse::TorqueConstant { relative_error: -1.0 };
    assert_eq!(undone(constant), ("torque_constant relative_error", 2));
    let ripple = InputInverse::TorqueRipple { relative_amplitude: 1.0, wave: WAVE };
    assert_eq!(undone(ripple), ("torque_ripple relative_amplitude", 2));
    assert_eq!(undone(InputInverse::DacOffset { offset_v: 6.0 }), ("dac_offset offset_V", 2));
    assert_eq!(
        undone(InputInverse::DeadZone { half_width_v: -0.1 }),
        ("dead_zone half_width_V", 2)
    );
}

fn table(knots: &[f32], values_v: &[f32]) -> Table {
    let (knots, values_v) = (knots.iter().copied().collect(), values_v.iter().copied().collect());
    Table { axis: TableAxis::Velocity, knots, values_v }
}

#[test]
fn tables_that_are_none_are_refused() {
    let refused = |knots: &[f32], values_v: &[f32]| {
        let tables = [table(&[0.0, 1.0], &[0.0, 0.1]), table(knots, values_v)];
        refusal(Compensations { tables: tables.into_iter().collect(), ..Default::default() })
    };
    let number = ("table's number of knots", 2);
    assert_eq!(refused(&[], &[]), number);
    assert_eq!(refused(&[1.0], &[1.0]), number);
    assert_eq!(refused(&[1.0, 2.0], &[1.0]), number);
    let knots = ("table knots", 2);
    assert_eq!(refused(&[1.0, 1.0], &[0.0, 0.0]), knots);
    assert_eq!(refused(&[1.0, 0.5], &[0.0, 0.0]), knots);
    assert_eq!(refused(&[1.0, f32::NAN], &[0.0, 0.0]), knots);
    assert_eq!(refused(&[1.0, f32::INFINITY], &[0.0, 0.0]), knots);
    let values = ("table values_V", 2);
    assert_eq!(refused(&[1.0, 2.0], &[0.0, 5.1]), values);
    assert_eq!(refused(&[1.0, 2.0], &[f32::NAN, 0.0]), values);
}

#[test]
fn a_block_of_version_3_is_refused_as_such() {
    // Version 3 had no tables: each joint ended with its two lists.
    let mut old = encoded(&block(Mode::PdModel));
    old[0..2].copy_from_slice(&3_u16.to_le_bytes());
    let end = old.len() - 4;
    let checksum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(&old[..end]);
    old[end..].copy_from_slice(&checksum.to_le_bytes());
    let error = ParameterBlock::decode(&old).unwrap_err();
    assert_eq!(error, BlockError::Version { found: 3 });
    assert!(error.to_string().contains("build it again"), "{error}");
}

#[test]
fn a_block_of_version_1_is_refused_as_such() {
    // Version 1 ended before the compensations: three times three empty lists, and nothing outside.
    let new = encoded(&block(Mode::PdModel));
    let mut old = new[..new.len() - 4 - 10].to_vec();
    let body = (old.len() - 4) as u16;
    old[0..2].copy_from_slice(&1_u16.to_le_bytes());
    old[2..4].copy_from_slice(&body.to_le_bytes());
    let checksum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(&old);
    old.extend(checksum.to_le_bytes());
    let error = ParameterBlock::decode(&old).unwrap_err();
    assert_eq!(error, BlockError::Version { found: 1 });
    assert!(error.to_string().contains("version 1"), "{error}");
}

#[test]
fn the_fullest_block_fits() {
    let noise = Injection::Noise(Noise { rms_v: 0.1, bandwidth_hz: 200.0, seed: u32::MAX });
    let legs = Motion::ConstantVelocity(ConstantVelocity {
        start_rad: 0.1,
        speeds_rad_per_s: [0.5; MAX_SPEEDS].into_iter().collect(),
        leg_s: 0.8,
        ramp_s: 0.2,
    });
    let wave = AngularHarmonic { order: 1000, phase: Angle(i32::MIN) };
    let mut full = joint(
        &[Feedforward::Cogging { amplitude_v: 0.1, wave }; MAX_FEEDFORWARD],
        &[InputInverse::TorqueRipple { relative_amplitude: 0.1, wave }; MAX_INPUT_INVERSES],
    );
    let ramp: Vec<f32> = (0..MAX_KNOTS as u8).map(f32::from).collect();
    let values_v: Vec<f32> = ramp.iter().map(|knot| 0.01 * knot).collect();
    full.tables = [(); MAX_TABLES].map(|()| table(&ramp, &values_v)).into_iter().collect();
    let mut block = block(Mode::OpenLoop);
    block.reference.motion = [(); 3].map(|()| legs.clone());
    block.reference.injection = [noise; 3];
    block.compensations = [(); 3].map(|()| full.clone());
    block.external_load =
        Some(ExternalLoad { tilt: Tilt::new(0.1, 0.1, [0.1; 2]), tip_force_n: [1.0; 3] });
    let bytes = encoded(&block);
    println!("{} of {MAX_BYTES} bytes", bytes.len());
    assert_eq!(ParameterBlock::decode(&bytes).unwrap(), block);
}

fn waves() -> impl Strategy<Value = AngularHarmonic> {
    (1..=1000_u16, any::<i32>())
        .prop_map(|(harmonic, phase)| AngularHarmonic { order: harmonic, phase: Angle(phase) })
}

fn fed_forward() -> impl Strategy<Value = Feedforward> {
    prop_oneof![
        (0.0..5.0_f32, waves())
            .prop_map(|(amplitude_v, wave)| Feedforward::Cogging { amplitude_v, wave }),
        (0.0..10.0_f32, -100.0..100.0_f32).prop_map(|(stiffness_v_per_rad, rest_rad)| {
            Feedforward::CableSpring { stiffness_v_per_rad, rest_rad }
        }),
        (0.0..1.0_f32).prop_map(|coefficient_v_s2_per_rad2| Feedforward::QuadraticDrag {
            coefficient_v_s2_per_rad2
        }),
        (0.0..0.95_f32, waves()).prop_map(|(relative_amplitude, wave)| {
            Feedforward::PositionFriction { relative_amplitude, wave }
        }),
        (-0.95..0.95_f32)
            .prop_map(|relative_asymmetry| Feedforward::AsymmetricFriction { relative_asymmetry }),
    ]
}

fn undone() -> impl Strategy<Value = InputInverse> {
    prop_oneof![
        (-0.5..0.5_f32).prop_map(|relative_error| InputInverse::TorqueConstant { relative_error }),
        (0.0..0.9_f32, waves()).prop_map(|(relative_amplitude, wave)| InputInverse::TorqueRipple {
            relative_amplitude,
            wave
        }),
        (-5.0..5.0_f32).prop_map(|offset_v| InputInverse::DacOffset { offset_v }),
        (0.0..5.0_f32).prop_map(|half_width_v| InputInverse::DeadZone { half_width_v }),
    ]
}

prop_compose! {
    fn curve()(
        axis in prop::sample::select(vec![TableAxis::Position, TableAxis::Velocity, TableAxis::Load]),
        first in -10.0..10.0_f32,
        steps in prop::collection::vec((1e-5..3.0_f32, -5.0..5.0_f32), 2..=MAX_KNOTS),
    ) -> Table {
        let mut last = first;
        let knots = steps.iter().map(|(step, _)| { last += step; last }).collect();
        Table { axis, knots, values_v: steps.iter().map(|(_, value_v)| *value_v).collect() }
    }
}

prop_compose! {
    fn compensations()(
        fed_forward in prop::collection::vec(fed_forward(), 0..=MAX_FEEDFORWARD),
        undone in prop::collection::vec(undone(), 0..=MAX_INPUT_INVERSES),
        tables in prop::collection::vec(curve(), 0..=MAX_TABLES),
    ) -> Compensations {
        Compensations { tables: tables.into_iter().collect(), ..joint(&fed_forward, &undone) }
    }
}

prop_compose! {
    fn outside()(
        gravity_change in prop::array::uniform3(-2.0..2.0_f32),
        hidden_moment_kg_m in prop::array::uniform2(-10.0..10.0_f32),
        tip_force_n in prop::array::uniform3(-200.0..200.0_f32),
    ) -> ExternalLoad {
        ExternalLoad { tilt: Tilt { gravity_change, hidden_moment_kg_m }, tip_force_n }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_block_survives_the_wire_and_drives(
        compensations in prop::array::uniform3(compensations()),
        outside in prop::option::of(outside()),
        mode in prop::sample::select(Mode::ALL.to_vec()),
    ) {
        let block = ParameterBlock { compensations, external_load: outside, ..block(mode) };
        let decoded = ParameterBlock::decode(&encoded(&block)).unwrap();
        prop_assert_eq!(&decoded, &block);
        let mut controller = Controller::new(decoded);
        controller.start();
        for k in 0..200 {
            let output = controller.tick(&[9 * k, -7 * k, 100 * k]);
            let limit = DacCode::from_volts(block.command_limit_v).0;
            prop_assert!(output.codes.iter().all(|code| code.0.abs() <= limit));
        }
    }

    #[test]
    fn changed_bytes_never_panic(
        compensations in prop::array::uniform3(compensations()),
        index in any::<prop::sample::Index>(),
        byte in any::<u8>(),
    ) {
        let block = ParameterBlock { compensations, ..block(Mode::PdModel) };
        let mut bytes = encoded(&block);
        let end = bytes.len() - 4;
        let index = index.index(end);
        bytes[index] = byte;
        let checksum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(&bytes[..end]);
        bytes[end..].copy_from_slice(&checksum.to_le_bytes());
        if let Ok(block) = ParameterBlock::decode(&bytes) {
            let mut controller = Controller::new(block);
            controller.start();
            for k in 0..20 {
                controller.tick(&[9 * k, -7 * k, 100 * k]);
            }
        }
    }
}
