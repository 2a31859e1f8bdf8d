//! The integrator is accurate, and friction holds.

use model::reference_robot::reference_robot;
use rig::effects::Transmission;

use super::*;

/// Angles after a second of open-loop voltage that slides and reverses all joints.
fn after_a_second(substeps: u32) -> Vector3<f64> {
    let settings = Settings { substeps, noise_v: 0.0, ..Settings::default() };
    let start = [0.0, -std::f64::consts::FRAC_PI_2, 0.0];
    let mut robot = SimulatedRobot::at_rest(reference_robot(), start, &settings);
    for tick in 0..1000 {
        let phase = 0.012 * f64::from(tick);
        robot.advance(&[1.5 * phase.sin(), 2.0 * phase.cos(), 1.2 * (1.7 * phase).sin()]);
    }
    *robot.q_rad()
}

#[test]
fn ten_substeps_are_converged_to_a_fifth_of_a_count() {
    let (coarse, fine) = (after_a_second(10), after_a_second(320));
    let error = (0..3).map(|i| (coarse[i] - fine[i]).abs()).fold(0.0, f64::max);
    assert!(error < 1.9e-6, "{error:e} rad");
    assert!(fine.iter().all(|q| q.abs() > 1e-3), "{fine:?} moved");
}

#[test]
fn friction_holds_the_arm_below_its_static_level() {
    let settings = Settings { noise_v: 0.0, ..Settings::default() };
    let start = [0.3, -std::f64::consts::FRAC_PI_2 + 0.03, 0.0];
    let mut robot = SimulatedRobot::at_rest(reference_robot(), start, &settings);
    for _ in 0..5000 {
        robot.advance(&[0.2, 0.0, 0.1]);
    }
    let moved = (0..3).map(|i| (robot.q_rad()[i] - start[i]).abs()).fold(0.0, f64::max);
    assert!(moved < 3e-3, "{moved} rad is bristle deflection, not sliding");
}

/// A soft spring on joint 3 that rubs.
#[derive(Debug)]
struct RubbingSpring(f64);

impl Effect for RubbingSpring {
    fn transmission(&self) -> Option<(usize, Transmission)> {
        let transmission = Transmission {
            gap_rad: 0.02,
            stiffness_nm_per_rad: 100.0,
            damping_nm_s_per_rad: 0.02,
            motor_inertia_kg_m2: 0.01,
        };
        Some((2, transmission))
    }

    fn transmission_friction_nm(&self) -> Option<(usize, f64)> {
        Some((2, self.0))
    }
}

#[test]
fn dry_friction_in_a_gap_calms_the_link() {
    let restless = |level_nm: f64| {
        let settings = Settings { noise_v: 0.0, ..Settings::default() };
        let effects: Vec<Box<dyn Effect>> = vec![Box::new(RubbingSpring(level_nm))];
        let start = [0.0, -std::f64::consts::FRAC_PI_2, 0.3];
        let mut robot = SimulatedRobot::with_effects(reference_robot(), effects, start, &settings);
        (0..1000).for_each(|_| robot.advance(&[0.0; 3]));
        (robot.plant.link_qd_rad_per_s()[2] - robot.qd_rad_per_s()[2]).abs()
    };
    assert!(restless(0.3) < 0.1 * restless(0.0));
}
