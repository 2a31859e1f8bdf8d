//! The arm that the board believes it drives: eq. (8) with LuGre friction, in `f64`.

use model::friction::FrictionScale;
use model::vector::Vector3;
use model::{FrictionState, Posture, Robot};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

/// How the robot is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time between commands [s].
    pub sample_period_s: f64,
    /// Integration steps per command.
    pub substeps: u32,
    /// Amplifier noise, one sample per command [V rms].
    pub noise_v: f64,
    /// Same seed, same noise.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { sample_period_s: 1e-3, substeps: 10, noise_v: 4e-3, seed: 1 }
    }
}

/// A robot in motion.
///
/// Integrated by the midpoint leapfrog: positions half a step, velocities a whole
/// one with forces in the middle, positions the other half; one evaluation of the
/// dynamics a step, second order. Friction takes its exact step at the middle
/// velocity, so its relaxation at up to 32,000 1/s asks for no smaller step.
#[derive(Clone, Debug)]
pub struct SimulatedRobot {
    robot: Robot<f64>,
    step_s: f64,
    substeps: u32,
    noise_v: f64,
    random: Pcg64Mcg,
    q_rad: Vector3<f64>,
    qd_rad_per_s: Vector3<f64>,
    qdd_rad_per_s2: Vector3<f64>,
    friction: [FrictionState<f64>; 3],
}

impl SimulatedRobot {
    /// A checked robot at rest.
    pub fn at_rest(robot: Robot<f64>, q_rad: Vector3<f64>, settings: &Settings) -> Self {
        Self {
            robot,
            step_s: settings.sample_period_s / f64::from(settings.substeps),
            substeps: settings.substeps,
            noise_v: settings.noise_v,
            random: Pcg64Mcg::new(u128::from(settings.seed) << 1 | 1),
            q_rad,
            qd_rad_per_s: [0.0; 3],
            qdd_rad_per_s2: [0.0; 3],
            friction: [FrictionState::default(); 3],
        }
    }

    /// Joint angles [rad].
    pub fn q_rad(&self) -> &Vector3<f64> {
        &self.q_rad
    }

    /// Joint velocities [rad/s].
    pub fn qd_rad_per_s(&self) -> &Vector3<f64> {
        &self.qd_rad_per_s
    }

    /// Lets the commanded voltages act for one sample period.
    pub fn advance(&mut self, command_v: &Vector3<f64>) {
        let noisy_v = command_v.map(|u| u + self.noise_sample());
        for _ in 0..self.substeps {
            self.substep(&noisy_v);
        }
    }

    fn noise_sample(&mut self) -> f64 {
        let deviate: f64 = StandardNormal.sample(&mut self.random);
        self.noise_v * deviate
    }

    fn substep(&mut self, voltage_v: &Vector3<f64>) {
        let (half_s, whole_s) = (0.5 * self.step_s, self.step_s);
        let middle_qd = [0, 1, 2].map(|i| self.qd_rad_per_s[i] + half_s * self.qdd_rad_per_s2[i]);
        for i in 0..3 {
            self.q_rad[i] += half_s * self.qd_rad_per_s[i];
        }
        let qdd = self.acceleration(voltage_v, &middle_qd);
        for i in 0..3 {
            self.qd_rad_per_s[i] += whole_s * qdd[i];
            self.q_rad[i] += half_s * self.qd_rad_per_s[i];
        }
        self.qdd_rad_per_s2 = qdd;
    }

    /// Acceleration in the middle of a step, where friction also takes its step.
    fn acceleration(&mut self, voltage_v: &Vector3<f64>, qd: &Vector3<f64>) -> Vector3<f64> {
        let net_v = [0, 1, 2].map(|i| {
            let friction_v = self.friction[i].step_scaled(
                &self.robot.friction[i],
                FrictionScale::unchanged(),
                qd[i],
                self.step_s,
            );
            voltage_v[i] - friction_v
        });
        Posture::new(self.q_rad[1], self.q_rad[2]).forward_dynamics(
            &self.robot.base,
            &self.robot.geometry,
            qd,
            &self.robot.voltage_to_torque(&net_v),
        )
    }
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;

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
    fn ten_substeps_are_converged_to_a_tenth_of_a_count() {
        let (coarse, fine) = (after_a_second(10), after_a_second(320));
        let error = (0..3).map(|i| (coarse[i] - fine[i]).abs()).fold(0.0, f64::max);
        assert!(error < 9.6e-7, "{error:e} rad");
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
}
