//! How a link moves behind a spring whose motor's motion is measured.

use model::{Posture, Robot};

use super::stretch::Kinematics;
use crate::simulation::transmission::Transmission;

/// Integration steps per sample.
const STEPS: usize = 8;

/// The motion with that of one link integrated: its motor drives it through the spring, the
/// other joints move as measured. `felt` is what a stiff joint would feel.
pub fn behind(
    spring: &Transmission,
    joint: usize,
    motor: &Kinematics,
    felt: &[Felt],
    period_s: f64,
) -> Kinematics {
    let mut motion = motor.clone();
    let count = motor.q_rad[joint].len();
    let felt: Vec<Felt> = felt.iter().map(|felt| felt.without(spring)).collect();
    let mut link = Link { q_rad: motor.q_rad[joint][0], qd_rad_per_s: 0.0 };
    link.q_rad -= spring.hold(felt[0].bias_nm);
    for k in 0..count {
        let torque_nm = link.torque(spring, motor.q_rad[joint][k], motor.qd_rad_per_s[joint][k]);
        motion.q_rad[joint][k] = link.q_rad;
        motion.qd_rad_per_s[joint][k] = link.qd_rad_per_s;
        motion.qdd_rad_per_s2[joint][k] = felt[k].acceleration(torque_nm);
        let next = (k + 1).min(count - 1);
        let step_s = period_s / STEPS as f64;
        for step in 0..STEPS {
            let x = (step as f64 + 0.5) / STEPS as f64;
            let along = |signal: &[f64]| signal[k] + x * (signal[next] - signal[k]);
            let (theta, speed) = (along(&motor.q_rad[joint]), along(&motor.qd_rad_per_s[joint]));
            link.advance(spring, theta, speed, &felt[k].towards(&felt[next], x), step_s);
        }
    }
    smoothed_acceleration(&mut motion.qdd_rad_per_s2[joint]);
    motion
}

/// The second difference of the other joints is the mean over two intervals; so is this.
fn smoothed_acceleration(signal: &mut [f64]) {
    let raw = signal.to_vec();
    for k in 1..raw.len().saturating_sub(1) {
        signal[k] = 0.25 * raw[k - 1] + 0.5 * raw[k] + 0.25 * raw[k + 1];
    }
}

/// What a joint feels of the rest of the arm at a sample.
#[derive(Clone, Copy, Debug)]
pub struct Felt {
    inertia_kg_m2: f64,
    /// Torque that it needs without acceleration of its own.
    bias_nm: f64,
}

impl Felt {
    /// At every sample of a motion.
    pub fn along(joint: usize, motor: &Kinematics, robot: &Robot<f64>) -> Vec<Self> {
        (0..motor.q_rad[joint].len()).map(|k| Self::at(joint, motor, robot, k)).collect()
    }

    fn at(joint: usize, motor: &Kinematics, robot: &Robot<f64>, k: usize) -> Self {
        let (q, qd, mut qdd) = motor.state(k);
        qdd[joint] = 0.0;
        let posture = Posture::new(q[1], q[2]);
        let (base, geometry) = (&robot.base, &robot.geometry);
        Self {
            inertia_kg_m2: posture.mass_matrix(base, geometry)[joint][joint],
            bias_nm: posture.inverse_dynamics(base, geometry, &qd, &qdd)[joint],
        }
    }

    /// Without the motor's inertia, which enters nothing but the joint's own.
    fn without(&self, spring: &Transmission) -> Self {
        Self { inertia_kg_m2: self.inertia_kg_m2 - spring.motor_inertia_kg_m2, ..*self }
    }

    fn towards(&self, other: &Self, x: f64) -> Self {
        Self {
            inertia_kg_m2: self.inertia_kg_m2 + x * (other.inertia_kg_m2 - self.inertia_kg_m2),
            bias_nm: self.bias_nm + x * (other.bias_nm - self.bias_nm),
        }
    }

    fn acceleration(&self, torque_nm: f64) -> f64 {
        (torque_nm - self.bias_nm) / self.inertia_kg_m2
    }
}

#[derive(Clone, Copy, Debug)]
struct Link {
    q_rad: f64,
    qd_rad_per_s: f64,
}

impl Link {
    fn torque(&self, spring: &Transmission, theta_rad: f64, theta_rad_per_s: f64) -> f64 {
        spring.torque_nm(theta_rad - self.q_rad, theta_rad_per_s - self.qd_rad_per_s)
    }

    /// Half a step of drift, a whole one of acceleration, half a step of drift.
    fn advance(&mut self, spring: &Transmission, theta: f64, speed: f64, felt: &Felt, step_s: f64) {
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        let torque_nm = self.torque(spring, theta, speed);
        self.qd_rad_per_s += step_s * felt.acceleration(torque_nm);
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
    }
}
