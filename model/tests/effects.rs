//! Effects and what undoes them.
#![allow(missing_docs)]

use model::effects::{
    AngularHarmonic, Tilt, cogging_v, dead_zone, dead_zone_inverse, quadratic_drag_v,
    ripple_factor, with_payload,
};
use model::reference_robot::reference_robot;
use model::{Geometry, Posture};
use proptest::prelude::*;

#[test]
fn a_wave_repeats_n_times_a_turn() {
    let wave = AngularHarmonic { order: 8.0, phase_rad: 0.9 };
    let once = wave.sine(0.3);
    assert!((wave.sine(0.3 + std::f64::consts::TAU / 8.0) - once).abs() < 1e-12);
    assert!((cogging_v(0.1, once) - 0.1 * (8.0_f64 * 0.3 + 0.9).sin()).abs() < 1e-12);
    assert!((ripple_factor(0.2, once) - 1.0).abs() <= 0.2);
}

#[test]
fn drag_brakes_both_ways() {
    assert_eq!(quadratic_drag_v(0.1, 3.0), -quadratic_drag_v(0.1, -3.0));
    assert!(quadratic_drag_v(0.1, 3.0) < 0.0);
}

#[test]
fn a_dead_zone_lets_nothing_small_through() {
    assert_eq!(dead_zone(0.04, 0.05), 0.0);
    assert!((dead_zone(-0.3, 0.05_f64) + 0.25).abs() < 1e-15);
    assert_eq!(dead_zone_inverse(0.0, 0.05), 0.0);
}

/// Height and place of the tip in the base frame, from Table 1.
fn tip(q: &[f64; 3], g: &Geometry<f64>) -> [f64; 3] {
    let (reach, across) = (g.a2_m * q[1].cos() + g.a3_m * (q[1] + q[2]).cos(), g.d2_m + g.d3_m);
    let (s1, c1) = q[0].sin_cos();
    let height = g.d1_m + g.a2_m * q[1].sin() + g.a3_m * (q[1] + q[2]).sin();
    [reach * c1 + across * s1, reach * s1 - across * c1, height]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_dead_zone_is_undone(voltage_v in -10.0..10.0_f64, half_width_v in 0.0..5.0) {
        let command_v = dead_zone_inverse(voltage_v, half_width_v);
        prop_assert!((dead_zone(command_v, half_width_v) - voltage_v).abs() < 1e-14);
    }

    /// Virtual work: the torque is the force times the tip's movement.
    #[test]
    fn a_tip_force_does_the_work_of_its_torques(
        q in prop::array::uniform3(-3.0..3.0_f64),
        force in prop::array::uniform3(-10.0..10.0),
    ) {
        let robot = reference_robot::<f64>();
        let posture = Posture::new(q[1], q[2]);
        let torque = posture.tip_force_torque(q[0].sin_cos(), &robot.geometry, &force);
        for joint in 0..3 {
            let moved = |by: f64| {
                let mut at = q;
                at[joint] += by;
                let tip = tip(&at, &robot.geometry);
                force[0] * tip[0] + force[1] * tip[1] + force[2] * tip[2]
            };
            let work = (moved(1e-6) - moved(-1e-6)) / 2e-6;
            prop_assert!((torque[joint] - work).abs() < 1e-7, "{joint} {torque:?} {work}");
        }
    }

    /// On a base that leans, a mass at the tip weighs as a force on the tip does, once what
    /// a level base hides of it is told.
    #[test]
    fn a_payload_leans_as_its_weight_does(
        q in prop::array::uniform3(-3.0..3.0_f64),
        (a, b) in (-0.5..0.5_f64, -0.5..0.5_f64),
    ) {
        let robot = reference_robot::<f64>();
        let (g, posture, turned) = (robot.geometry, Posture::new(q[1], q[2]), q[0].sin_cos());
        let torque = |mass_kg| {
            let base = with_payload(&robot.base, &g, mass_kg);
            let aside = mass_kg * (g.d2_m + g.d3_m);
            Tilt::new(a, b, [0.0, -aside]).torque(turned, &posture, &base, &g)
        };
        let (bare, loaded) = (torque(0.0), torque(2.0));
        let weight_n = Tilt::new(a, b, [0.0; 2]).gravity_change.map(|c| 2.0 * g.gravity_m_s2 * c);
        let expected = posture.tip_force_torque(turned, &g, &weight_n);
        for joint in 0..3 {
            let error = loaded[joint] - bare[joint] - expected[joint];
            prop_assert!(error.abs() < 1e-9, "joint {joint}: {error}");
        }
    }
}
