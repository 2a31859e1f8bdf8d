//! Any arm under a PD loop, recorded as its encoders and drives would tell it.

use std::f64::consts::TAU;

use files::{ArmFile, ArmJoint, ArmJointLog, ArmLog, Experiment, Role};
use model::mechanism::JointKind;
use rand_distr::{Distribution, StandardNormal, Uniform};
use rand_pcg::Pcg64Mcg;
use rig::Plant;
use rig::effects::Effect;

use super::plant::SimulatedPlant;
use super::settings::Settings;

/// What an arm does while it is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmMotion {
    /// Samples per second, of the loop and of the log.
    pub rate_hz: f64,
    /// Duration [s].
    pub duration_s: f64,
    /// Fastest of the five sines of every joint's reference [Hz].
    pub fastest_hz: f64,
    /// Part of every joint's range that they cross.
    pub part_of_range: f64,
    /// Noise of the amplifiers, in parts of the torque of usual motion: what holds the joint, and
    /// what moves it with a velocity and an acceleration of one.
    pub noise_part: f64,
    /// Driven noise of the commands, in the same parts; it ends at a fifth of the rate.
    pub driven_part: f64,
    /// Same seed, same reference and noises.
    pub seed: u64,
}

/// A log to be recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmPlan {
    /// Its name.
    pub name: &'static str,
    /// What is done.
    pub experiment: Experiment,
    /// What the log is for.
    pub role: Role,
    /// How the arm moves.
    pub motion: ArmMotion,
}

/// Noise of amplifiers that are good ones, in parts of the torque of usual motion.
const NOISE_PART: f64 = 1e-3;

/// The logs in which the diagnosis looks for a gap: fast and slow motion, motion under driven noise,
/// and another motion to confirm on.
pub fn gap_plans(rate_hz: f64, seed: u64) -> [ArmPlan; 4] {
    let motion = |index: u64, fastest_hz: f64, driven_part: f64| ArmMotion {
        rate_hz,
        duration_s: 20.0,
        fastest_hz,
        part_of_range: 0.9,
        noise_part: NOISE_PART,
        driven_part,
        seed: 16 * seed + index,
    };
    let plan = |name, experiment, role, motion| ArmPlan { name, experiment, role, motion };
    [
        plan("excitation", Experiment::Excitation, Role::Train, motion(1, 1.0, 0.0)),
        plan("slow", Experiment::Slow, Role::Train, motion(2, 0.25, 0.0)),
        plan("driven-noise", Experiment::DrivenNoise, Role::Train, motion(3, 0.3, 0.15)),
        plan("task", Experiment::Task, Role::Holdout, motion(4, 0.8, 0.0)),
    ]
}

/// Either way from the middle where a joint has no limits [rad; m].
const FREE_RAD: f64 = 1.6;
const FREE_M: f64 = 0.3;
/// Natural frequency of the PD loop [Hz] and its damping.
const LOOP_HZ: f64 = 3.0;
const DAMPING: f64 = 0.7;
/// Longest integration step [s].
const LONGEST_STEP_S: f64 = 2e-4;

/// Records a motion of an arm that differs from its model by these effects.
///
/// The loop adds to the PD's torque the one that the model needs for the reference, so that the arm
/// follows it about as a real one does.
pub fn record_arm(
    arm: &ArmFile,
    plant: &Plant,
    effects: Vec<Box<dyn Effect>>,
    motion: &ArmMotion,
) -> ArmLog {
    let reference = Reference::of(arm, motion);
    let [start, ..] = reference.at(0.0);
    let scales = scales(plant, &start);
    let settings = Settings {
        sample_period_s: 1.0 / motion.rate_hz,
        substeps: (1.0 / motion.rate_hz / LONGEST_STEP_S).ceil() as u32,
        noise_v: 0.0,
        seed: motion.seed,
    };
    let robot = SimulatedPlant::with_effects(plant.clone(), effects, &start, &settings);
    let random = Pcg64Mcg::new(u128::from(motion.seed) << 9 | 1);
    let driven = vec![0.0; start.len()];
    Recorder { arm, plant, motion, reference, scales, robot, random, driven }.log()
}

/// A recording under way.
struct Recorder<'a> {
    arm: &'a ArmFile,
    plant: &'a Plant,
    motion: &'a ArmMotion,
    reference: Reference,
    /// Torque of a joint in usual motion.
    scales: Vec<f64>,
    robot: SimulatedPlant,
    random: Pcg64Mcg,
    /// Driven noise, low-passed.
    driven: Vec<f64>,
}

impl Recorder<'_> {
    fn log(mut self) -> ArmLog {
        let joints = self.arm.joints.len();
        let mut log = ArmLog { time_s: Vec::new(), joints: vec![ArmJointLog::default(); joints] };
        let period_s = 1.0 / self.motion.rate_hz;
        for sample in 0..(self.motion.duration_s / period_s) as usize {
            let time_s = sample as f64 * period_s;
            let reading = self.robot.reading_rad();
            let seen: Vec<f64> =
                self.arm.joints.iter().zip(&reading).map(|(joint, q)| counted(joint, *q)).collect();
            let command = self.command(time_s, &seen);
            log.time_s.push(time_s);
            for (joint, log) in log.joints.iter_mut().enumerate() {
                log.position.push(seen[joint]);
                log.command.push(command[joint]);
            }
            let noisy = self.noisy(&command);
            self.robot.advance(&noisy);
        }
        log
    }

    /// What the loop commands.
    fn command(&mut self, time_s: f64, seen: &[f64]) -> Vec<f64> {
        let [q, qd, qdd] = self.reference.at(time_s);
        let mut torque = vec![0.0; q.len()];
        self.plant.body.inverse_dynamics(&q, &qd, &qdd, &mut torque);
        let (w, moving) = (TAU * LOOP_HZ, self.robot.qd_rad_per_s().to_vec());
        for joint in 0..q.len() {
            let inertia = self.plant.body.inertia(joint, &q);
            let (ahead, faster) = (q[joint] - seen[joint], qd[joint] - moving[joint]);
            torque[joint] += inertia * (w * w * ahead + 2.0 * DAMPING * w * faster);
            torque[joint] += self.driven(joint);
        }
        let joints = self.arm.joints.iter().enumerate();
        let of_joint = |(index, joint): (usize, &ArmJoint)| {
            let constant = self.plant.torque_constant_nm_per_v[index];
            let friction = self.plant.friction[index].sliding(qd[index]);
            let limit = joint.drive.as_ref().and_then(|d| d.limit).unwrap_or(f64::INFINITY);
            // As a log writes it.
            let command = (torque[index] / constant + friction).clamp(-limit, limit);
            (1e7 * command).round() / 1e7
        };
        joints.map(of_joint).collect()
    }

    /// Driven noise of a joint's torque.
    fn driven(&mut self, joint: usize) -> f64 {
        const KEPT: f64 = 0.3;
        if self.motion.driven_part == 0.0 {
            return 0.0;
        }
        let deviate: f64 = StandardNormal.sample(&mut self.random);
        self.driven[joint] = KEPT * self.driven[joint] + deviate;
        self.motion.driven_part * self.scales[joint] * self.driven[joint]
    }

    /// The commands with the noise of the amplifiers.
    fn noisy(&mut self, command: &[f64]) -> Vec<f64> {
        let mut noise = |joint: usize| {
            let deviate: f64 = StandardNormal.sample(&mut self.random);
            let constant = self.plant.torque_constant_nm_per_v[joint];
            self.motion.noise_part * self.scales[joint] / constant * deviate
        };
        command.iter().enumerate().map(|(joint, u)| u + noise(joint)).collect()
    }
}

/// What the encoder reads of a position.
fn counted(joint: &ArmJoint, q: f64) -> f64 {
    joint.count_step().map_or(q, |step| (q / step).round() * step)
}

/// Torque that holds each joint, with that of a velocity and an acceleration of one.
fn scales(plant: &Plant, q: &[f64]) -> Vec<f64> {
    let mut hold = vec![0.0; q.len()];
    plant.body.mechanism().gravity(q, &mut hold);
    let of_joint = |joint: usize| {
        let friction = plant.torque_constant_nm_per_v[joint] * plant.friction[joint].sliding(1.0);
        hold[joint].abs() + plant.body.inertia(joint, q) + friction
    };
    (0..q.len()).map(of_joint).collect()
}

/// Five sines per joint.
struct Reference {
    middles: Vec<f64>,
    /// Amplitude, angular frequency, phase.
    sines: Vec<Vec<[f64; 3]>>,
}

impl Reference {
    fn of(arm: &ArmFile, motion: &ArmMotion) -> Self {
        let mut random = Pcg64Mcg::new(u128::from(motion.seed) << 1 | 1);
        let unit = Uniform::new(0.0, 1.0).expect("a range");
        let mut draw = || unit.sample(&mut random);
        let (mut middles, mut sines) = (Vec::new(), Vec::new());
        for joint in &arm.joints {
            let (middle, half) = range(joint);
            let sine = |k: usize| {
                let frequency = motion.fastest_hz * (k as f64 + 0.5 + 0.5 * draw()) / 5.0;
                let amplitude = motion.part_of_range * half / (1.0 + k as f64) / 1.5;
                [amplitude, TAU * frequency, TAU * draw()]
            };
            middles.push(middle);
            sines.push((0..5).map(sine).collect());
        }
        Self { middles, sines }
    }

    /// Position, velocity and acceleration of every joint at a time [s].
    fn at(&self, time_s: f64) -> [Vec<f64>; 3] {
        let sum = |of: &dyn Fn(&[f64; 3]) -> f64| -> Vec<f64> {
            self.sines.iter().map(|sines| sines.iter().map(of).sum()).collect()
        };
        let [mut q, qd, qdd] = [
            sum(&|[a, w, p]| a * (w * time_s + p).sin()),
            sum(&|[a, w, p]| a * w * (w * time_s + p).cos()),
            sum(&|[a, w, p]| -a * w * w * (w * time_s + p).sin()),
        ];
        q.iter_mut().zip(&self.middles).for_each(|(q, middle)| *q += middle);
        [q, qd, qdd]
    }
}

/// The middle of a joint's range, and how far it goes either way.
fn range(joint: &ArmJoint) -> (f64, f64) {
    match (joint.limits, joint.kind) {
        (Some([lower, upper]), _) => (0.5 * (lower + upper), 0.5 * (upper - lower)),
        (None, JointKind::Revolute) => (0.0, FREE_RAD),
        (None, JointKind::Prismatic) => (0.0, FREE_M),
    }
}
