//! How a link moves behind a spring whose motor's motion is measured.

use nalgebra::RowVector2;

use super::link_covariance::LinkCovariance;
use crate::logs::joint_dynamics::JointDynamics;
use crate::logs::kinematics::Kinematics;
use rig::effects::Transmission;
use signal::derivative;

/// Most integration steps per sample, and those of a link that bounces in its backlash.
const MOST_STEPS: usize = 6;
/// Fewest: means about a sample weigh what lies before and behind it.
const FEWEST_STEPS: usize = 2;
/// Most radians of the link's own oscillation in a step: leapfrog errs by a part x^2 / 24 of the
/// frequency, 2e-3 here.
const RADIANS_PER_STEP: f64 = 0.2;

/// Motion of one joint at the samples.
#[derive(Clone, Debug, Default)]
pub struct JointMotion {
    q_rad: Vec<f64>,
    qd_rad_per_s: Vec<f64>,
    qdd_rad_per_s2: Vec<f64>,
}

impl JointMotion {
    /// How far it is ahead of a joint's motor in acceleration, angle and velocity, at the samples.
    pub(super) fn ahead_of(&self, motor: &Kinematics, joint: usize) -> Vec<[f64; 3]> {
        let ahead = |k: usize| {
            [
                self.qdd_rad_per_s2[k] - motor.qdd_rad_per_s2[joint][k],
                self.q_rad[k] - motor.q_rad[joint][k],
                self.qd_rad_per_s[k] - motor.qd_rad_per_s[joint][k],
            ]
        };
        (0..self.q_rad.len()).map(ahead).collect()
    }
}

impl Kinematics {
    /// The same with another motion of a joint.
    pub fn take_joint(&mut self, joint: usize, motion: JointMotion) {
        self.q_rad[joint] = motion.q_rad;
        self.qd_rad_per_s[joint] = motion.qd_rad_per_s;
        self.qdd_rad_per_s2[joint] = motion.qdd_rad_per_s2;
    }
}

/// What tells the torque that a spring passed on.
#[derive(Clone, Copy, Debug)]
pub struct MeasuredTorque<'a> {
    /// What pushes the motor in the interval after each sample [Nm].
    pub push_nm: &'a [f64],
    /// Torque on the link that no model tells, in parts of the noise of the measured torque.
    pub unknown_torque: f64,
}

/// The motion of one link, integrated: its motor drives it through the spring, the other joints
/// move as measured. `dynamics` are those of the joint as if it were stiff. A link with backlash
/// bounces, and small errors grow from contact to contact; one that is hardly damped swings with the
/// encoder's steps. The `measured` torque corrects it as an extended Kalman filter does.
pub fn behind(
    spring: &Transmission,
    joint: usize,
    motor: &Kinematics,
    dynamics: &[JointDynamics],
    measured: MeasuredTorque,
    period_s: f64,
) -> JointMotion {
    let dynamics: Vec<JointDynamics> =
        dynamics.iter().map(|stiff| stiff.without_motor(spring)).collect();
    let drive = Drive::of(motor, joint, period_s);
    let mut motion = JointMotion::default();
    let (steps, unknown_torque) = (steps(spring, &dynamics, period_s), measured.unknown_torque);
    let mut follower =
        Follower::at_rest(spring, drive.angle(0, 0.0), dynamics[0].bias_nm, unknown_torque, steps);
    for k in 0..dynamics.len() {
        motion.q_rad.push(follower.link.q_rad);
        motion.qd_rad_per_s.push(follower.link.qd_rad_per_s);
        let next = &dynamics[(k + 1).min(dynamics.len() - 1)];
        let inside = |x: f64| (drive.angle(k, x), drive.speed(k, x), dynamics[k].towards(next, x));
        let mean = follower.cross(spring, inside, period_s);
        motion.qdd_rad_per_s2.push(mean.acceleration);
        let push_nm = 0.5 * (measured.push_nm[k.saturating_sub(1)] + measured.push_nm[k]);
        let passed_nm = push_nm - spring.motor_inertia_kg_m2 * motor.qdd_rad_per_s2[joint][k];
        follower.correct(passed_nm - mean.torque_nm, dynamics[k].inertia_kg_m2, period_s);
    }
    motion
}

/// Integration steps per sample that follow a link's own oscillation.
fn steps(spring: &Transmission, dynamics: &[JointDynamics], period_s: f64) -> usize {
    if spring.gap_rad > 0.0 {
        return MOST_STEPS;
    }
    let lightest = dynamics.iter().map(|joint| joint.inertia_kg_m2).fold(f64::INFINITY, f64::min);
    let rad_per_s = (spring.stiffness_nm_per_rad / lightest.max(f64::MIN_POSITIVE)).sqrt();
    let steps = (rad_per_s * period_s / RADIANS_PER_STEP).ceil();
    (steps as usize).clamp(FEWEST_STEPS, MOST_STEPS)
}

/// Means about a sample, weighted as a second difference of angles weighs accelerations:
/// most at the sample, not at all at the next and the one before.
#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    torque_nm: f64,
    acceleration: f64,
}

impl Mean {
    fn add(&mut self, torque_nm: f64, acceleration: f64, part: f64) {
        self.torque_nm += part * torque_nm;
        self.acceleration += part * acceleration;
    }
}

/// A link on its way from sample to sample.
struct Follower {
    link: Link,
    /// Covariance of the link's state.
    covariance: LinkCovariance,
    /// What the interval before adds to the means at the sample after it.
    before: Mean,
    /// Integration steps per sample.
    steps: usize,
}

impl Follower {
    fn at_rest(
        spring: &Transmission,
        theta_rad: f64,
        bias_nm: f64,
        unknown_torque: f64,
        steps: usize,
    ) -> Self {
        let q_rad = theta_rad - spring.hold(bias_nm);
        Self {
            link: Link { q_rad, qd_rad_per_s: 0.0 },
            covariance: LinkCovariance::initial(spring.stiffness_nm_per_rad, unknown_torque),
            before: Mean { torque_nm: 0.5 * bias_nm, acceleration: 0.0 },
            steps,
        }
    }

    /// Crosses an interval; the motor's angle and velocity and the link's dynamics are known
    /// `inside` it. Returns the means about the sample where it begins.
    fn cross(
        &mut self,
        spring: &Transmission,
        inside: impl Fn(f64) -> (f64, f64, JointDynamics),
        period_s: f64,
    ) -> Mean {
        let part = 1.0 / self.steps as f64;
        let step_s = period_s * part;
        let (mut early, mut late) = (self.before, Mean::default());
        for step in 0..self.steps {
            let x = (step as f64 + 0.5) * part;
            let (theta, speed, dynamics) = inside(x);
            let (torque_nm, dynamics) = self.link.advance(spring, theta, speed, &dynamics, step_s);
            let kick = period_s / dynamics.inertia_kg_m2;
            self.covariance.advance(slope(spring, torque_nm) * part, kick, step_s, x);
            let acceleration = dynamics.acceleration(torque_nm);
            early.add(torque_nm, acceleration, part * (1.0 - x));
            late.add(torque_nm, acceleration, part * x);
        }
        self.before = late;
        early
    }

    /// Corrects the link by the part of the measured torque about the last sample that the model
    /// lacks.
    fn correct(&mut self, innovation_nm: f64, inertia_kg_m2: f64, period_s: f64) {
        let change = self.covariance.update(innovation_nm, period_s / inertia_kg_m2);
        self.link.q_rad += change[0];
        self.link.qd_rad_per_s += change[1];
    }
}

/// Slopes of a spring's torque along the link's angle and velocity; none while it passes none.
fn slope(spring: &Transmission, torque_nm: f64) -> RowVector2<f64> {
    match torque_nm == 0.0 {
        true => RowVector2::zeros(),
        false => -RowVector2::new(spring.stiffness_nm_per_rad, spring.damping_nm_s_per_rad),
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
        let (da, db) =
            (self.period_s * self.qd_rad_per_s[k], self.period_s * self.qd_rad_per_s[next]);
        let (x2, x3) = (x * x, x * x * x);
        a + da * x + (3.0 * (b - a) - 2.0 * da - db) * x2 + (2.0 * (a - b) + da + db) * x3
    }

    /// The slope of the cubic.
    fn speed(&self, k: usize, x: f64) -> f64 {
        let next = (k + 1).min(self.q_rad.len() - 1);
        let mean = (self.q_rad[next] - self.q_rad[k]) / self.period_s;
        let (va, vb) = (self.qd_rad_per_s[k], self.qd_rad_per_s[next]);
        va + (6.0 * mean - 4.0 * va - 2.0 * vb) * x + 3.0 * (va + vb - 2.0 * mean) * x * x
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
    /// torque that the spring passes on, and the dynamics where the link is.
    fn advance(
        &mut self,
        spring: &Transmission,
        theta: f64,
        speed: f64,
        dynamics: &JointDynamics,
        step_s: f64,
    ) -> (f64, JointDynamics) {
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        let torque_nm = self.torque(spring, theta, speed);
        let dynamics = dynamics.with_link_ahead(self.q_rad - theta, self.qd_rad_per_s - speed);
        self.qd_rad_per_s += step_s * dynamics.acceleration(torque_nm);
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        (torque_nm, dynamics)
    }
}
