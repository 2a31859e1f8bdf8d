//! Which parts of the LuGre model can give energy away, and which cannot.
//!
//! The dissipation of eq. (9) with storage sigma0 z^2 / 2 is, in s = sigma0 z sgn(v) /
//! gamma(v), gamma s^2 |v| + (alpha2 + sigma1 (1 - s)) v^2. Without sigma1 it is never
//! negative; with it, where s goes beyond 1. After Barabanov and Ortega (IEEE Transactions
//! on Automatic Control, 2000), alpha2 >= sigma1 (gamma_max - gamma_min) / gamma_min suffices.

mod common;

use common::cases;
use common::lugre::{joints, largest_deflection_rad, level_range};
use model::{Friction, FrictionState};
use proptest::collection::vec;
use proptest::prelude::*;

/// The viscous friction that makes velocity to friction passive [V s/rad].
fn sufficient_alpha2(friction: &Friction<f64>) -> f64 {
    let (lowest, highest) = level_range(friction);
    friction.sigma1_v_s_per_rad * (highest - lowest) / lowest
}

/// Stored energy sigma0 z^2 / 2 [V rad].
fn stored(friction: &Friction<f64>, state: &FrictionState<f64>) -> f64 {
    0.5 * friction.sigma0_v_per_rad * state.deflection_rad * state.deflection_rad
}

/// Energy that enters through the joint during one step, less what is then stored more.
fn dissipated(
    friction: &Friction<f64>,
    state: &mut FrictionState<f64>,
    (velocity, duration_s): (f64, f64),
) -> f64 {
    let before = stored(friction, state);
    let mean_v = state.step(friction, velocity, duration_s);
    mean_v * velocity * duration_s - (stored(friction, state) - before)
}

/// Rounding, relative to the energies that pass.
const ROUNDING: f64 = 1e-12;

fn joint() -> impl Strategy<Value = Friction<f64>> {
    prop::sample::select(joints().to_vec())
}

/// Velocity from 1e-5 to 10 rad/s of either sign, for 1 us to 10 ms.
fn segment() -> impl Strategy<Value = (f64, f64)> {
    (-5.0..1.0, any::<bool>(), -6.0..-2.0).prop_map(|(size, forward, duration)| {
        let sign = if forward { 1.0 } else { -1.0 };
        (sign * 10_f64.powf(size), 10_f64.powf(duration))
    })
}

proptest! {
    #![proptest_config(cases(1000))]

    /// Velocity to sigma0 z, in every exact step, and z stays in its range.
    #[test]
    fn bristle_is_passive(joint in joint(), start in -1.0..1.0, segments in vec(segment(), 50)) {
        let bristle = Friction { sigma1_v_s_per_rad: 0.0, alpha2_v_s_per_rad: 0.0, ..joint };
        let range = largest_deflection_rad(&joint);
        let mut state = FrictionState { deflection_rad: start * range };
        for segment in segments {
            let scale = joint.alpha0_v * (range + (segment.0 * segment.1).abs());
            let lost = dissipated(&bristle, &mut state, segment);
            prop_assert!(lost > -ROUNDING * scale, "{lost:e}");
            prop_assert!(state.deflection_rad.abs() <= range * (1.0 + ROUNDING));
        }
    }

    /// Velocity to the whole friction, with just enough viscous friction.
    #[test]
    fn friction_is_passive_with_enough_viscous_friction(
        joint in joint(),
        start in -1.0..1.0,
        segments in vec(segment(), 50),
    ) {
        let alpha2_v_s_per_rad = sufficient_alpha2(&joint);
        let friction = Friction { alpha2_v_s_per_rad, ..joint };
        let range = largest_deflection_rad(&joint);
        let mut state = FrictionState { deflection_rad: start * range };
        for (velocity, duration_s) in segments {
            let lost = dissipated(&friction, &mut state, (velocity, duration_s));
            let way = range + (velocity * duration_s).abs();
            prop_assert!(lost > -ROUNDING * (1.0 + velocity.abs()) * way, "{lost:e}");
        }
    }
}

#[test]
fn the_paper_s_joints_have_less_viscous_friction_than_suffices() {
    let sufficient = joints().map(|friction| (sufficient_alpha2(&friction) * 1e3).round() / 1e3);
    assert_eq!(sufficient, [0.793, 1.264, 1.411]);
    let own = joints().map(|friction| friction.alpha2_v_s_per_rad);
    assert!((0..3).all(|i| own[i] < 0.12 * sufficient[i]), "{own:?}");
}

/// Energy that one cycle takes up: a creep bends the bristles up to the static level, a
/// pulse of high velocity, too short for them to follow, is pushed by sigma1 dz/dt.
fn cycle_energy(friction: &Friction<f64>, pulse_rad_per_s: f64) -> f64 {
    let creep = 0.05 * friction.stribeck_velocity_rad_per_s;
    let creep_s = 3.0 * largest_deflection_rad(friction) / creep;
    let rate = friction.sigma0_v_per_rad * pulse_rad_per_s / friction.alpha0_v;
    let pulse_s = 2.0 / rate;
    let mut state = FrictionState { deflection_rad: 0.0 };
    let mut energy_over = |(velocity, duration_s): (f64, f64)| {
        state.step(friction, velocity, duration_s) * velocity * duration_s
    };
    let mut cycle = || energy_over((creep, creep_s)) + energy_over((pulse_rad_per_s, pulse_s));
    // After a few cycles each ends in the state in which it began.
    for _ in 0..10 {
        cycle();
    }
    cycle()
}

#[test]
fn joints_1_and_2_give_energy_away_in_pulses_of_velocity() {
    let [joint_1, joint_2, _] = joints();
    for friction in [joint_1, joint_2] {
        assert!(cycle_energy(&friction, 1.0) > 0.0);
        assert!(cycle_energy(&friction, 5.0) < 0.0);
        let alpha2_v_s_per_rad = sufficient_alpha2(&friction);
        assert!(cycle_energy(&Friction { alpha2_v_s_per_rad, ..friction }, 5.0) > 0.0);
    }
}

/// alpha1 of joint 3 is negative: gamma is low only at creep, where v^2 is small, and
/// largest at speed, where s therefore stays below 1. It is passive all the same.
#[test]
fn joint_3_is_passive_with_its_own_viscous_friction() {
    let [.., friction] = joints();
    for size in (0..=600).map(|i| 10_f64.powf(f64::from(i) / 100.0 - 5.0)) {
        let gamma = friction.stribeck_level(size);
        for part in (-100..=100).map(|i| f64::from(i) / 100.0) {
            let s = part * level_range(&friction).1 / gamma;
            let damping = friction.alpha2_v_s_per_rad + friction.sigma1_v_s_per_rad * (1.0 - s);
            assert!(gamma * s * s * size + damping * size * size > 0.0);
        }
    }
}
