//! The exact LuGre step at constant velocity: against eq. (9) integrated with tiny
//! steps, in `f32` against `f64`, and beside explicit Euler.

mod common;

use common::largest;
use common::lugre::{deflection_rate, integrate, joints, largest_deflection_rad, level_range};
use model::{Friction, FrictionState};

/// Documented at [`FrictionState::step`].
const DEFLECTION_BOUND: f64 = 1e-12;
const VOLTAGE_BOUND_V: f64 = 1e-10;
const F32_DEFLECTION_BOUND: f64 = 2e-7;
const F32_VOLTAGE_BOUND_V: f64 = 6e-6;

const STEPS_S: [f64; 2] = [1e-4, 1e-3];

/// A joint at a deflection, moving at a velocity for a time; all representable in `f32`.
struct Case {
    friction: Friction<f64>,
    deflection_rad: f64,
    velocity_rad_per_s: f64,
    step_s: f64,
}

impl Case {
    /// Deflection in parts of its range, and mean voltage, after the exact step.
    fn exact_step(&self) -> [f64; 2] {
        let mut state = FrictionState { deflection_rad: self.deflection_rad };
        let mean_v = state.step(&self.friction, self.velocity_rad_per_s, self.step_s);
        self.in_range(state.deflection_rad, mean_v)
    }

    fn exact_step_in_f32(&self) -> [f64; 2] {
        let mut state = FrictionState { deflection_rad: self.deflection_rad as f32 };
        let velocity = self.velocity_rad_per_s as f32;
        let mean_v = state.step(&self.friction.cast(), velocity, self.step_s as f32);
        self.in_range(state.deflection_rad.into(), mean_v.into())
    }

    /// Runge-Kutta with 300 steps per time constant.
    fn integrated(&self) -> [f64; 2] {
        let v = self.velocity_rad_per_s;
        let steps = ((self.rate_per_s() * self.step_s * 300.0) as usize).max(20);
        let (z, mean_v) = integrate(&self.friction, |_| v, self.deflection_rad, self.step_s, steps);
        self.in_range(z, mean_v)
    }

    /// sigma0 |v| / gamma, at which z relaxes.
    fn rate_per_s(&self) -> f64 {
        let level = self.friction.stribeck_level(self.velocity_rad_per_s);
        self.friction.sigma0_v_per_rad * self.velocity_rad_per_s.abs() / level
    }

    fn in_range(&self, deflection_rad: f64, mean_v: f64) -> [f64; 2] {
        [deflection_rad / largest_deflection_rad(&self.friction), mean_v]
    }
}

/// All joints, velocities of both signs from 1e-5 to 10 rad/s, starts across z's range.
fn cases() -> impl Iterator<Item = Case> {
    let starts = [-1.0, -0.5, 0.0, 0.5, 1.0];
    let joints = joints().into_iter().map(|friction| friction.cast::<f32>().cast());
    joints.flat_map(move |friction| {
        let at_start = move |part: f64| {
            STEPS_S.into_iter().flat_map(move |step_s| {
                velocities().map(move |v| Case {
                    friction,
                    deflection_rad: single(part * largest_deflection_rad(&friction)),
                    velocity_rad_per_s: single(v),
                    step_s: single(step_s),
                })
            })
        };
        starts.into_iter().flat_map(at_start)
    })
}

fn velocities() -> impl Iterator<Item = f64> {
    let sizes = (0..=18).map(|third| 10_f64.powf(f64::from(third) / 3.0 - 5.0));
    sizes.flat_map(|v| [v, -v])
}

fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

/// The largest differences of deflection and of voltage.
fn worst(a: fn(&Case) -> [f64; 2], b: fn(&Case) -> [f64; 2]) -> [f64; 2] {
    let pairs: Vec<_> = cases().map(|case| (a(&case), b(&case))).collect();
    [0, 1].map(|part| largest(pairs.iter().map(|(a, b)| a[part] - b[part])))
}

#[test]
fn step_is_the_solution_of_equation_9() {
    let [deflection, voltage] = worst(Case::exact_step, Case::integrated);
    assert!(deflection < DEFLECTION_BOUND, "{deflection:e} of the range");
    assert!(voltage < VOLTAGE_BOUND_V, "{voltage:e} V");
}

#[test]
fn f32_error_is_as_documented() {
    let [deflection, voltage] = worst(Case::exact_step_in_f32, Case::exact_step);
    assert!(deflection < F32_DEFLECTION_BOUND, "{deflection:e} of the range");
    assert!(voltage < F32_VOLTAGE_BOUND_V, "{voltage:e} V");
    assert!(deflection > 0.3 * F32_DEFLECTION_BOUND, "document {deflection:e}");
    assert!(voltage > 0.3 * F32_VOLTAGE_BOUND_V, "document {voltage:e}");
}

#[test]
fn two_half_steps_are_one_step() {
    for case in cases() {
        let (v, half_s) = (case.velocity_rad_per_s, 0.5 * case.step_s);
        let mut state = FrictionState { deflection_rad: case.deflection_rad };
        let halves = [0; 2].map(|_| state.step(&case.friction, v, half_s));
        let expected = case.exact_step();
        let got = case.in_range(state.deflection_rad, 0.5 * (halves[0] + halves[1]));
        let error = largest([got[0] - expected[0], got[1] - expected[1]]);
        assert!(error < 1e-11, "{error:e}");
    }
}

#[test]
fn standstill_keeps_the_deflection() {
    for friction in joints() {
        let deflection_rad = 0.7 * largest_deflection_rad(&friction);
        let mut state = FrictionState { deflection_rad };
        let voltage = state.step(&friction, 0.0, 1e-3);
        assert_eq!(state.deflection_rad, deflection_rad);
        assert_eq!(voltage, friction.sigma0_v_per_rad * deflection_rad);
    }
}

/// At 10 rad/s the deflection of joint 1 relaxes at 51,000 1/s.
#[test]
fn explicit_euler_explodes_where_the_exact_step_does_not() {
    let (step_s, velocity) = (1e-3, 10.0);
    for friction in joints() {
        let (mut euler, mut exact) = (0.0, FrictionState { deflection_rad: 0.0 });
        for _ in 0..100 {
            euler += step_s * deflection_rate(&friction, velocity, euler);
            exact.step(&friction, velocity, step_s);
        }
        let range = largest_deflection_rad(&friction);
        assert!(euler.abs() > 1e6 * range, "{euler:e}");
        let steady = level_range(&friction).1.min(friction.stribeck_level(velocity));
        assert!((exact.deflection_rad * friction.sigma0_v_per_rad - steady).abs() < 1e-12);
    }
}
