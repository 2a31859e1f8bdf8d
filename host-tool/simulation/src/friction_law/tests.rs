//! Each law meets its steady curve, gives no work away, and is calm at steps of 0.1 ms.

use std::f64::consts::TAU;

use model::friction::{Friction, FrictionScale};
use model::reference_robot::reference_robot;

use super::*;

const STEP_S: f64 = 1e-4;

fn friction(joint: usize) -> Friction<f64> {
    reference_robot::<f64>().friction[joint]
}

/// Every law on a joint, with its name and the velocity from which on it slides as eq. (10).
fn laws(joint: usize) -> Vec<(&'static str, Box<dyn FrictionLaw>)> {
    let friction = friction(joint);
    let stiffness = 0.5 * friction.sigma0_v_per_rad;
    vec![
        ("LuGre", Box::new(LuGre::new(friction))),
        ("tanh", Box::new(RegularisedCoulomb::new(friction, Slope::Tanh, 0.02))),
        ("ramp", Box::new(RegularisedCoulomb::new(friction, Slope::Ramp, 0.05))),
        ("Dahl", Box::new(Dahl::new(friction, stiffness))),
        ("Maxwell slip", Box::new(MaxwellSlip::new(friction, 6, 30.0, 100.0))),
        ("Stribeck lag", Box::new(StribeckLag::new(friction, 0.02, 0.03))),
        ("soft constraint", Box::new(SoftConstraint::new(friction, 0.02))),
    ]
}

fn slid(law: &mut dyn FrictionLaw, velocity: f64, seconds: f64) -> f64 {
    let steps = (seconds / STEP_S) as usize;
    let step = |_| law.step(FrictionScale::unchanged(), velocity, STEP_S);
    (0..steps).map(step).last().unwrap()
}

#[test]
fn every_law_slides_as_the_model_does() {
    for joint in 0..3 {
        for (name, mut law) in laws(joint) {
            for velocity in [0.5, -0.5, 3.0] {
                let found = slid(law.as_mut(), velocity, 1.0);
                let wanted = friction(joint).sliding(velocity);
                assert!((found - wanted).abs() < 1e-3 * wanted.abs(), "{name}: {found} {wanted}");
            }
        }
    }
}

#[test]
fn slow_sliding_follows_each_laws_own_curve() {
    let friction = friction(0);
    let viscous = friction.alpha2_v_s_per_rad * 0.01;
    let oil = Friction { stribeck_velocity_rad_per_s: 0.03, ..friction };
    let expected = [
        ("tanh", friction.stribeck_level(0.01) * 0.5_f64.tanh() + viscous),
        ("ramp", friction.stribeck_level(0.01) * 0.2 + viscous),
        ("Dahl", friction.alpha0_v + viscous),
        ("Maxwell slip", friction.sliding(0.01)),
        ("Stribeck lag", oil.sliding(0.01)),
        ("soft constraint", 0.5 * friction.alpha0_v + viscous),
    ];
    for (name, wanted) in expected {
        let (_, mut law) = laws(0).into_iter().find(|(n, _)| *n == name).unwrap();
        let found = slid(law.as_mut(), 0.01, 5.0);
        assert!((found - wanted).abs() < 2e-3 * wanted, "{name}: {found} {wanted}");
    }
}

#[test]
fn no_law_gives_work_away() {
    for (name, mut law) in laws(2) {
        for (amplitude_rad, frequency_hz) in [(1e-5, 3.0), (1e-3, 10.0), (0.3, 1.0), (2.0, 0.5)] {
            let cycle = (1.0 / (frequency_hz * STEP_S)) as usize;
            let mut work = |_| -> f64 {
                let velocity = |k: usize| {
                    let phase = TAU * (k as f64 + 0.5) / cycle as f64;
                    amplitude_rad * TAU * frequency_hz * phase.cos()
                };
                let step =
                    |k| law.step(FrictionScale::unchanged(), velocity(k), STEP_S) * velocity(k);
                (0..cycle).map(step).sum::<f64>() * STEP_S
            };
            let cycles: Vec<f64> = (0..4).map(&mut work).collect();
            // The first cycles start from another deflection.
            assert!(cycles[2] > 0.0 && cycles[3] > 0.0, "{name}, {amplitude_rad} rad: {cycles:?}");
        }
    }
}

#[test]
fn maxwell_slip_gives_way_bit_by_bit() {
    let friction = friction(0);
    let mut law = MaxwellSlip::new(friction, 4, 10.0, 100.0);
    let mut last = 0.0;
    for _ in 0..2000 {
        let found = law.step(FrictionScale::unchanged(), 1e-3, STEP_S);
        let slope = (found - last) / (1e-3 * STEP_S);
        assert!(slope < 1.001 * friction.sigma0_v_per_rad + friction.alpha2_v_s_per_rad / STEP_S);
        last = found;
    }
    law.rest();
    assert!(law.step(FrictionScale::unchanged(), 0.0, STEP_S) == 0.0);
}

#[test]
fn a_warm_joint_rubs_less_and_stays_warm() {
    let friction = friction(1);
    let warmth = Warmth { fall: 0.3, time_constant_s: 10.0, power_v_rad_per_s: 0.05 };
    let mut law = Warming::new(Box::new(LuGre::new(friction)), warmth);
    let cold = friction.sliding(1.0);
    let warm = slid(&mut law, 1.0, 100.0);
    law.rest();
    let again = slid(&mut law, 1.0, 0.1);
    assert!((warm / cold - 0.7).abs() < 0.01, "{cold} {warm}");
    assert!((again / warm - 1.0).abs() < 0.01, "{warm} {again}");
}
