//! How a link moves behind a spring whose motor's motion is measured.

use model::{Posture, Robot};
use nalgebra::RowVector2;

use super::doubt::Doubt;
use crate::logs::stretch::Kinematics;
use rig::effects::Transmission;
use signal::derivative;

/// Integration steps per sample.
const STEPS: usize = 6;

/// Difference for slopes of what a joint feels [rad, rad/s].
const STEP: f64 = 1e-4;

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

/// The motion of one link, integrated: its motor drives it through the spring, the other
/// joints move as measured. `felt` is what a stiff joint would feel. A link with play bounces,
/// and small errors grow from contact to contact; `push_nm`, what pushes the motor in the
/// interval after each sample [Nm], tells what torque the spring passed on and keeps such a
/// link on its track.
pub fn behind(
    spring: &Transmission,
    joint: usize,
    motor: &Kinematics,
    felt: &[Felt],
    push_nm: Option<&[f64]>,
    period_s: f64,
) -> JointMotion {
    let felt: Vec<Felt> = felt.iter().map(|felt| felt.without(spring)).collect();
    let drive = Drive::of(motor, joint, period_s);
    let mut motion = JointMotion::default();
    let mut follower = Follower::at_rest(spring, drive.angle(0, 0.0), felt[0].bias_nm);
    for k in 0..felt.len() {
        motion.q_rad.push(follower.link.q_rad);
        motion.qd_rad_per_s.push(follower.link.qd_rad_per_s);
        let next = &felt[(k + 1).min(felt.len() - 1)];
        let inside = |x: f64| (drive.angle(k, x), drive.speed(k, x), felt[k].towards(next, x));
        let mean = follower.cross(spring, inside, period_s, push_nm.is_some());
        motion.qdd_rad_per_s2.push(mean.acceleration);
        if let Some(push_nm) = push_nm {
            let own_nm = spring.motor_inertia_kg_m2 * motor.qdd_rad_per_s2[joint][k];
            let passed_nm = 0.5 * (push_nm[k.saturating_sub(1)] + push_nm[k]) - own_nm;
            follower.correct(passed_nm - mean.torque_nm, felt[k].inertia_kg_m2, period_s);
        }
    }
    motion
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
        self.torque_nm += part / STEPS as f64 * torque_nm;
        self.acceleration += part / STEPS as f64 * acceleration;
    }
}

/// A link on its way from sample to sample.
struct Follower {
    link: Link,
    doubt: Doubt,
    /// What the interval before adds to the means at the sample after it.
    before: Mean,
}

impl Follower {
    fn at_rest(spring: &Transmission, theta_rad: f64, bias_nm: f64) -> Self {
        let q_rad = theta_rad - spring.hold(bias_nm);
        Self {
            link: Link { q_rad, qd_rad_per_s: 0.0 },
            doubt: Doubt::at_first(spring.stiffness_nm_per_rad),
            before: Mean { torque_nm: 0.5 * bias_nm, acceleration: 0.0 },
        }
    }

    /// Crosses an interval; the motor's angle and velocity and what the link feels are known
    /// `inside` it. Returns the means about the sample where it begins.
    fn cross(
        &mut self,
        spring: &Transmission,
        inside: impl Fn(f64) -> (f64, f64, Felt),
        period_s: f64,
        doubts: bool,
    ) -> Mean {
        let step_s = period_s / STEPS as f64;
        let (mut early, mut late) = (self.before, Mean::default());
        for step in 0..STEPS {
            let x = (step as f64 + 0.5) / STEPS as f64;
            let (theta, speed, felt) = inside(x);
            let (torque_nm, felt) = self.link.advance(spring, theta, speed, &felt, step_s);
            if doubts {
                let slope = slope(spring, torque_nm) / STEPS as f64;
                let kick = step_s * STEPS as f64 / felt.inertia_kg_m2;
                self.doubt.advance(slope, kick, step_s, x);
            }
            let acceleration = felt.acceleration(torque_nm);
            early.add(torque_nm, acceleration, 1.0 - x);
            late.add(torque_nm, acceleration, x);
        }
        self.before = late;
        early
    }

    /// Moves the link by what the torque about the last sample missed.
    fn correct(&mut self, missed_nm: f64, inertia_kg_m2: f64, period_s: f64) {
        let change = self.doubt.learn(missed_nm, period_s / inertia_kg_m2);
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

/// What a joint feels of the rest of the arm at a sample.
#[derive(Clone, Copy, Debug)]
pub struct Felt {
    inertia_kg_m2: f64,
    /// Torque that it needs without acceleration of its own, where the motor is.
    bias_nm: f64,
    /// Slopes of that torque along the joint's own angle and velocity: a link is a little
    /// away from its motor, and gravity's slope shifts the resonance.
    along_angle_nm: f64,
    along_velocity_nm_s: f64,
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
        let bias_nm = |posture: &Posture<f64>, qd: &[f64; 3]| {
            posture.inverse_dynamics(base, geometry, qd, &qdd)[joint]
        };
        let (mut q_moved, mut qd_moved) = (q, qd);
        q_moved[joint] += STEP;
        qd_moved[joint] += STEP;
        let here_nm = bias_nm(&posture, &qd);
        let moved = Posture::new(q_moved[1], q_moved[2]);
        Self {
            inertia_kg_m2: posture.mass_matrix(base, geometry)[joint][joint],
            bias_nm: here_nm,
            along_angle_nm: (bias_nm(&moved, &qd) - here_nm) / STEP,
            along_velocity_nm_s: (bias_nm(&posture, &qd_moved) - here_nm) / STEP,
        }
    }

    /// Without the motor's inertia, which enters nothing but the joint's own.
    fn without(&self, spring: &Transmission) -> Self {
        Self { inertia_kg_m2: self.inertia_kg_m2 - spring.motor_inertia_kg_m2, ..*self }
    }

    fn towards(&self, other: &Self, x: f64) -> Self {
        let between = |here: f64, there: f64| here + x * (there - here);
        Self {
            inertia_kg_m2: between(self.inertia_kg_m2, other.inertia_kg_m2),
            bias_nm: between(self.bias_nm, other.bias_nm),
            along_angle_nm: between(self.along_angle_nm, other.along_angle_nm),
            along_velocity_nm_s: between(self.along_velocity_nm_s, other.along_velocity_nm_s),
        }
    }

    /// Where and as fast as the link moves, its motor's `theta_rad` and `theta_rad_per_s`.
    fn with_link(&self, link: &Link, theta_rad: f64, theta_rad_per_s: f64) -> Self {
        let bias_nm = self.bias_nm
            + self.along_angle_nm * (link.q_rad - theta_rad)
            + self.along_velocity_nm_s * (link.qd_rad_per_s - theta_rad_per_s);
        Self { bias_nm, ..*self }
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
    /// torque that the spring passes on, and what the link feels of the arm.
    fn advance(
        &mut self,
        spring: &Transmission,
        theta: f64,
        speed: f64,
        felt: &Felt,
        step_s: f64,
    ) -> (f64, Felt) {
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        let torque_nm = self.torque(spring, theta, speed);
        let felt = felt.with_link(self, theta, speed);
        self.qd_rad_per_s += step_s * felt.acceleration(torque_nm);
        self.q_rad += 0.5 * step_s * self.qd_rad_per_s;
        (torque_nm, felt)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use model::reference_robot::reference_robot;
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::logs::stretch::Stretch;
    use crate::trial::voltage::{EffectInstance, Hypothesis, Trial};
    use files::Role;
    use rig::effects::Catalogue;
    use signal::LowPass;
    use signal::rms;
    use simulation::{Settings, SimulatedRobot};

    const PERIOD_S: f64 = 1e-3;
    const COUNT_RAD: f64 = TAU / 655_360.0;

    fn backlash(values: [f64; 4]) -> EffectInstance {
        let definition = Catalogue::standard().by_name("backlash").unwrap();
        EffectInstance { definition, joint: 3, values: values.to_vec() }
    }

    /// Ten seconds of driven noise on joint 3 of a robot with an effect, as encoders see them.
    fn driven(effect: Option<&EffectInstance>) -> Stretch {
        let effects = effect.and_then(EffectInstance::build).into_iter().collect();
        let start = [0.0, -1.5, 0.3];
        let settings = Settings::default();
        let mut robot = SimulatedRobot::with_effects(reference_robot(), effects, start, &settings);
        let mut random = Pcg64Mcg::new(3);
        let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
        let mut command_v: [Vec<f64>; 3] = Default::default();
        let mut angles: [Vec<f64>; 3] = Default::default();
        for k in 0..10_000 {
            let q = robot.q_rad().map(|q| (q / COUNT_RAD).round() * COUNT_RAD);
            let swing = (TAU * 0.7e-3 * f64::from(k)).sin();
            let push = 1.2 * noise() + 1.5 * swing - 4.0 * (q[2] - start[2]);
            let command = [0.0, 0.0, push];
            (0..3).for_each(|i| angles[i].push(q[i]));
            (0..3).for_each(|i| command_v[i].push(command[i]));
            robot.advance(&command);
        }
        let motion = motion(angles);
        let (role, settled) = (Role::Train, [0; 3]);
        let (log, start_s, period_s, broadband) = (0, 0.0, PERIOD_S, true);
        let postures = motion.postures();
        Stretch { log, role, start_s, period_s, motion, postures, command_v, broadband, settled }
    }

    fn motion(angles: [Vec<f64>; 3]) -> Kinematics {
        let smooth = |q: &Vec<f64>| LowPass::new(200.0, PERIOD_S).zero_phase(q);
        let q_rad = [0, 1, 2].map(|i| smooth(&angles[i]));
        let first = |q: &Vec<f64>| derivative::first(q, PERIOD_S);
        let second = |q: &Vec<f64>| -> Vec<f64> {
            let at = |k: usize| {
                let k = k.clamp(1, q.len() - 2);
                (q[k + 1] + q[k - 1] - 2.0 * q[k]) / (PERIOD_S * PERIOD_S)
            };
            (0..q.len()).map(at).collect()
        };
        Kinematics {
            qd_rad_per_s: [0, 1, 2].map(|i| first(&q_rad[i])),
            qdd_rad_per_s2: [0, 1, 2].map(|i| second(&angles[i])),
            q_rad,
            raw_rad: angles,
        }
    }

    /// What a model leaves of joint 3 below 40 Hz, rms [V].
    fn left_v(stretch: &Stretch, effect: Option<EffectInstance>) -> f64 {
        let effects = effect.into_iter().collect();
        let hypothesis = Hypothesis { robot: reference_robot(), lag_s: [0.0; 3], effects };
        let left = Trial::of(stretch, &hypothesis).residual(2);
        rms(&LowPass::new(40.0, PERIOD_S).zero_phase(&left)[500..9500])
    }

    const PLAY: [f64; 4] = [2e-3, 3000.0, 1.5, 0.01];

    #[test]
    fn a_link_that_bounces_in_its_play_is_followed_through_driven_noise() {
        let floor_v = left_v(&driven(None), None);
        let stretch = driven(Some(&backlash(PLAY)));
        let (with_v, without_v) = (left_v(&stretch, Some(backlash(PLAY))), left_v(&stretch, None));
        assert!(with_v < 5.0 * floor_v, "{with_v} V, floor {floor_v} V");
        assert!(without_v > 15.0 * with_v, "{without_v} V, floor {floor_v} V");
    }

    #[test]
    fn play_that_is_not_there_explains_nothing_away() {
        let delay = Catalogue::standard().by_name("delay").unwrap();
        let delay = EffectInstance { definition: delay, joint: 3, values: vec![4e-3] };
        let stretch = driven(Some(&delay));
        let null_v = left_v(&stretch, None);
        for gap_rad in [1e-6, 1e-4, 1e-3] {
            for stiffness in [500.0, 5e3, 5e4, 1e6] {
                let play = backlash([gap_rad, stiffness, 1e-2 * stiffness.sqrt(), 0.01]);
                let left_v = left_v(&stretch, Some(play));
                assert!(
                    left_v > 0.75 * null_v,
                    "{left_v} V, without {null_v} V, {stiffness} Nm/rad"
                );
            }
        }
    }
}
