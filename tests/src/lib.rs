//! What the end-to-end tests share: the firmware in QEMU and what it plays.

pub mod operator;
pub mod soak;

use std::path::PathBuf;

use files::EffectTable;
use firmware::compensation::MAX_KNOTS;
use firmware::reference::{Injection, Noise};
use firmware::{Mode, ParameterBlock};
use model::reference_robot::reference_robot;
use rig::compensation::Compensations;
use rig::effects::{Catalogue, Effect, Table, TableAxis};
use rig::{Plan, Rig, plan};
use simulation::board::{Qemu, QemuSettings};

pub use test_support::image;

/// The firmware in QEMU.
///
/// # Panics
/// QEMU does not start.
pub fn qemu(image: &PathBuf) -> Qemu {
    Qemu::start(&QemuSettings::new(image)).expect("QEMU starts")
}

/// The rig with the reference robot.
pub fn rig() -> Rig {
    Rig::new(reference_robot())
}

/// Effects that a real arm might have beyond its model.
const HIDDEN: [&str; 8] = [
    "cogging:1:amplitude_V=0.08,harmonic=12,phase_rad=0.4",
    "dac_offset:1:offset_V=0.05",
    "cogging:2:amplitude_V=0.15,harmonic=8,phase_rad=0.9",
    "position_friction:2:relative_amplitude=0.3,harmonic=2,phase_rad=2.0",
    "cogging:3:amplitude_V=0.1,harmonic=8,phase_rad=-0.5",
    "dead_zone:3:half_width_V=0.05",
    "payload:mass_kg=0.3",
    "base_tilt:tilt_x_rad=0.03,tilt_y_rad=-0.02",
];

/// Those that are missing there, so that every kind that can be compensated is there.
const RARER: [&str; 9] = [
    "table:1:axis=position,knots=-1 0.5 1.7 3.2,values_V=0.05 -0.04 0.08 0",
    "table:2:axis=velocity,knots=-0.2 -0.05 0.05 0.2,values_V=0 0.05 -0.05 0",
    "table:3:axis=load,knots=-3 -0.5 0.4 2.5,values_V=0.06 -0.02 0.03 -0.06",
    "torque_constant:1:relative_error=0.05",
    "torque_ripple:2:relative_amplitude=0.08,harmonic=16,phase_rad=-1.2",
    "asymmetric_friction:3:relative_asymmetry=0.2",
    "cable_spring:2:stiffness_V_per_rad=0.1,rest_rad=1.0",
    "quadratic_drag:1:coefficient_V_s2_per_rad2=0.01",
    "tip_force:force_N=1 -2 0.5",
];

/// Effects as the command line writes them.
///
/// # Panics
/// One of them is none.
pub fn tables(texts: &[&str]) -> Vec<EffectTable> {
    texts.iter().map(|text| rig::effects::table_from_text(text).expect("an effect")).collect()
}

/// The effects of an arm that has eight of them.
///
/// # Panics
/// The list above is wrong.
pub fn hidden_effects() -> Vec<EffectTable> {
    tables(&HIDDEN)
}

/// Effects of all twelve kinds that can be compensated, and a table over each axis that can.
///
/// # Panics
/// The lists above are wrong.
pub fn every_kind_of_effect() -> Vec<EffectTable> {
    tables(&[&HIDDEN[..], &RARER].concat())
}

/// Tables of as many knots as the board takes, `count` on each joint: over velocity, over load.
///
/// # Panics
/// Never: the curves are curves.
pub fn full_tables(count: usize) -> Vec<EffectTable> {
    let axes = [TableAxis::Velocity, TableAxis::Load].into_iter().take(count);
    let on_joint = |axis, joint| {
        let knots: Vec<f64> = (0..MAX_KNOTS).map(|k| 0.4 * k as f64 - 4.0).collect();
        let values_v = knots.iter().map(|x| 0.02 * x.sin()).collect();
        Table { joint, axis, knots, values_v }.checked().expect("a curve").to_effect_table()
    };
    axes.flat_map(|axis| (1..=3).map(move |joint| on_joint(axis, joint))).collect()
}

/// Effects for the simulated robot.
///
/// # Panics
/// The list above is wrong.
pub fn simulated(effects: &[EffectTable]) -> Vec<Box<dyn Effect>> {
    effects
        .iter()
        .map(|table| Catalogue::standard().effect_of(table).expect("its values fit"))
        .collect()
}

/// The rig with the reference robot, compensating for effects.
///
/// # Panics
/// One of them cannot be compensated.
pub fn rig_that_compensates(effects: &[EffectTable]) -> Rig {
    let (compensations, left_out) =
        Compensations::of(effects, &Catalogue::standard()).expect("their values fit");
    assert!(left_out.is_empty(), "{left_out:?}");
    rig().with_compensations(compensations)
}

/// A minute of motion that exercises a mode: friction and open loop swing freely under noise.
pub fn minute_of(rig: &Rig, mode: Mode) -> ParameterBlock {
    let mut plan = plan::excitation(2, 60.0).with_mode(mode);
    for (index, injection) in plan.reference.injection.iter_mut().enumerate() {
        let noise = Noise { rms_v: 0.3, bandwidth_hz: 200.0, seed: 5 + index as u32 };
        *injection = Injection::Noise(noise);
    }
    plan.block(rig)
}

/// Every reference that the firmware can play, each with all terms of the control law on.
pub fn every_reference(rig: &Rig) -> Vec<Plan> {
    let mut plans = vec![plan::task(10.0), plan::excitation(1, 10.0), plan::driven_noise(10.0, 1)];
    plans.push(plan::constant_velocity(2));
    plans.push(plan::friction_excitation(rig));
    plans.push(plan::presliding_noise(rig, 1, 1));
    plans.into_iter().map(|plan| plan.with_mode(Mode::PdModel)).collect()
}
