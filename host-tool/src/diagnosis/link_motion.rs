//! How a link moves behind a spring whose motor's motion is measured.

use model::{Posture, Robot};
use nalgebra::{Matrix2, RowVector2};

use super::stretch::Kinematics;
use crate::signal::derivative;
use crate::simulation::transmission::Transmission;

/// Integration steps per sample.
const STEPS: usize = 6;
/// Torque on a link that no model tells, in parts of the noise of the measured torque.
const UNKNOWN_TORQUE: f64 = 0.5;

/// Motion of one joint at the samples.
#[derive(Clone, Debug, Default)]
pub struct JointMotion {
    q_rad: Vec<f64>,
    qd_rad_per_s: Vec<f64>,
    qdd_rad_per_s2: Vec<f64>,
}

impl Kinematics {
    /// The same with another motion of a joint.
    pub fn take_joint(&mut self, joint: usize, motion: JointMotion) {
        self.q_rad[joint] = motion.q_rad;
        self.qd_rad_per_s[joint] = motion.qd_rad_per_s;
        self.qdd_rad_per_s2[joint] = motion.qdd_rad_per_s2;
    }
}

/// The motion of one link, integrated: its motor drives it through the spring, the
/// other joints move as measured. `felt` is what a stiff joint would feel; `passed_nm` is the
/// torque at the samples that the motor passed on by its own equation, which keeps a link
/// with play from losing its track.
pub fn behind(
    spring: &Transmission,
    joint: usize,
    motor: &Kinematics,
    felt: &[Felt],
    push_nm: Option<&[f64]>,
    period_s: f64,
) -> JointMotion {
    let mut motion = JointMotion::default();
    let count = motor.q_rad[joint].len();
    let felt: Vec<Felt> = felt.iter().map(|felt| felt.without(spring)).collect();
    let drive = Drive::of(motor, joint, period_s);
    let mut link = Link { q_rad: drive.angle(0, 0.0) - spring.hold(felt[0].bias_nm), qd_rad_per_s: 0.0 };
    let step_s = period_s / STEPS as f64;
    let along = -RowVector2::new(spring.stiffness_nm_per_rad, spring.damping_nm_s_per_rad);
    let mut doubt = Doubt::at_first(spring);
    let mut before = Mean { torque_nm: 0.5 * felt[0].bias_nm, acceleration: 0.0 };
    for k in 0..count {
        motion.q_rad.push(link.q_rad);
        motion.qd_rad_per_s.push(link.qd_rad_per_s);
        let next = (k + 1).min(count - 1);
        let (mut early, mut late) = (Mean::default(), Mean::default());
        for step in 0..STEPS {
            let x = (step as f64 + 0.5) / STEPS as f64;
            let (theta, speed) = (drive.angle(k, x), drive.speed(k, x));
            let here = felt[k].towards(&felt[next], x);
            let passed = link.advance(spring, theta, speed, &here, step_s);
            if push_nm.is_some() {
                let slope = if passed == 0.0 { RowVector2::zeros() } else { along };
                doubt.advance(slope, here.inertia_kg_m2, step_s, x);
            }
            let acceleration = here.acceleration(passed);
            early.add(passed, acceleration, 1.0 - x);
            late.add(passed, acceleration, x);
        }
        motion.qdd_rad_per_s2.push(before.acceleration + early.acceleration);
        if let Some(push_nm) = push_nm {
            let own = spring.motor_inertia_kg_m2 * motor.qdd_rad_per_s2[joint][k];
            let passed = 0.5 * (push_nm[k.saturating_sub(1)] + push_nm[k]) - own;
            let missed_nm = passed - before.torque_nm - early.torque_nm;
            doubt.correct(&mut link, missed_nm, felt[k].inertia_kg_m2, period_s);
        }
        before = late;
    }
    motion
}

#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    torque_nm: f64,
    acceleration: f64,
}

impl Mean {
    fn add(&mut self, torque_nm: f64, acceleration: f64, part: f64) {
        self.torque_nm += part / STEPS as f64 * torque_nm;
        self.acceleration += part / STEPS as f64 * acceleration;
    }
}

/// How little is known of where a link is, carried along as an extended Kalman filter does:
/// the covariance of its angle and velocity in units of that of the measured torque.
#[derive(Clone, Copy, Debug)]
struct Doubt {
    spread: Matrix2<f64>,
    /// Slopes of the state now along that at the begin of the interval.
    moved: Matrix2<f64>,
    /// Slopes along the state at the begin of the interval of what a torque adds to the means
    /// at the sample there and at the next.
    early: RowVector2<f64>,
    late: RowVector2<f64>,
    /// Slope of what the interval before added, along the same.
    before: RowVector2<f64>,
}

impl Doubt {
    /// A torque's worth of angle at the begin.
    fn at_first(spring: &Transmission) -> Self {
        let angle = (3.0 / spring.stiffness_nm_per_rad).powi(2);
        Self {
            spread: Matrix2::new(angle, 0.0, 0.0, 1e3 * angle),
            moved: Matrix2::identity(),
            early: RowVector2::zeros(),
            late: RowVector2::zeros(),
            before: RowVector2::zeros(),
        }
    }

    /// One step of the link, by the slopes of its torque along angle and velocity.
    fn advance(&mut self, slope: RowVector2<f64>, inertia_kg_m2: f64, step_s: f64, x: f64) {
        let drift = |moved: &mut Matrix2<f64>| {
            moved[(0, 0)] += 0.5 * step_s * moved[(1, 0)];
            moved[(0, 1)] += 0.5 * step_s * moved[(1, 1)];
        };
        drift(&mut self.moved);
        let torque = slope * self.moved;
        self.early += torque * ((1.0 - x) / STEPS as f64);
        self.late += torque * (x / STEPS as f64);
        self.moved[(1, 0)] += step_s / inertia_kg_m2 * torque[0];
        self.moved[(1, 1)] += step_s / inertia_kg_m2 * torque[1];
        drift(&mut self.moved);
    }

    /// Moves the link by what the torque at the sample at the begin of the interval missed.
    fn correct(&mut self, link: &mut Link, missed_nm: f64, inertia_kg_m2: f64, period_s: f64) {
        let back = self.moved.try_inverse().unwrap_or_else(Matrix2::identity);
        self.spread = self.moved * self.spread * self.moved.transpose();
        self.spread[(1, 1)] += (UNKNOWN_TORQUE * period_s / inertia_kg_m2).powi(2);
        let slope = (self.before + self.early) * back;
        let across = self.spread * slope.transpose();
        let gain = across / (1.0 + (slope * across)[0]);
        link.q_rad += gain[0] * missed_nm;
        link.qd_rad_per_s += gain[1] * missed_nm;
        self.spread -= gain * across.transpose();
        self.before = self.late * back;
        self.moved = Matrix2::identity();
        self.early = RowVector2::zeros();
        self.late = RowVector2::zeros();
    }
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
        let (da, db) = (self.period_s * self.qd_rad_per_s[k], self.period_s * self.qd_rad_per_s[next]);
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
    /// torque that the spring passes on.
    fn advance(
        &mut self,
        spring: &Transmission,
        theta: f64,
        speed: f64,
        felt: &Felt,
        step_s: f64,
    ) -> f64 {
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        let torque_nm = self.torque(spring, theta, speed);
        self.qd_rad_per_s += step_s * felt.acceleration(torque_nm);
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        torque_nm
    }
}
