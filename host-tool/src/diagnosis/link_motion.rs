//! How a link moves behind a spring whose motor's motion is measured.

use model::{Posture, Robot};

use super::stretch::Kinematics;
use super::voltage::at_samples;
use crate::signal::derivative;
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
    let drive = Drive::of(motor, joint, period_s);
    let mut link =
        Link { q_rad: drive.angle(0, 0.0) - spring.hold(felt[0].bias_nm), qd_rad_per_s: 0.0 };
    let step_s = period_s / STEPS as f64;
    let mut mean = Vec::with_capacity(count);
    for k in 0..count {
        motion.q_rad[joint][k] = link.q_rad;
        motion.qd_rad_per_s[joint][k] = link.qd_rad_per_s;
        let next = (k + 1).min(count - 1);
        let mut sum = 0.0;
        for step in 0..STEPS {
            let x = (step as f64 + 0.5) / STEPS as f64;
            let (theta, speed) = (drive.angle(k, x), drive.speed(k, x));
            sum += link.advance(spring, theta, speed, &felt[k].towards(&felt[next], x), step_s);
        }
        mean.push(sum / STEPS as f64);
    }
    motion.qdd_rad_per_s2[joint] = at_samples(&mean);
    motion
}

/// The motor's motion between its samples: cubic pieces of angle and velocity.
struct Drive<'a> {
    q_rad: &'a [f64],
    qd_rad_per_s: Vec<f64>,
    period_s: f64,
}

impl<'a> Drive<'a> {
    fn of(motor: &'a Kinematics, joint: usize, period_s: f64) -> Self {
        let q_rad = &motor.raw_rad[joint];
        Self { q_rad, qd_rad_per_s: derivative::first(q_rad, period_s), period_s }
    }

    fn angle(&self, k: usize, x: f64) -> f64 {
        let next = (k + 1).min(self.q_rad.len() - 1);
        let (a, b) = (self.q_rad[k], self.q_rad[next]);
        let (da, db) =
            (self.period_s * self.qd_rad_per_s[k], self.period_s * self.qd_rad_per_s[next]);
        let (x2, x3) = (x * x, x * x * x);
        a + da * x + (3.0 * (b - a) - 2.0 * da - db) * x2 + (2.0 * (a - b) + da + db) * x3
    }

    fn speed(&self, k: usize, x: f64) -> f64 {
        let next = (k + 1).min(self.q_rad.len() - 1);
        self.qd_rad_per_s[k] + x * (self.qd_rad_per_s[next] - self.qd_rad_per_s[k])
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

    /// Half a step of drift, a whole one of acceleration, half a step of drift; returns the
    /// acceleration.
    fn advance(
        &mut self,
        spring: &Transmission,
        theta: f64,
        speed: f64,
        felt: &Felt,
        step_s: f64,
    ) -> f64 {
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        let acceleration = felt.acceleration(self.torque(spring, theta, speed));
        self.qd_rad_per_s += step_s * acceleration;
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        acceleration
    }
}
