//! Any chain under a PD loop: logs as its encoders and drives would write them.
#![allow(dead_code)] // Each test file uses a part of it.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use files::ArmFile;
use files::arm_file::DriveKind;
use model::chain::SerialChain;
use model::mechanism::{JointKind, Mechanism};
use rand_distr::{Distribution, Normal, Uniform};
use rand_pcg::Pcg64Mcg;

/// How a log is recorded.
#[derive(Clone, Debug)]
pub struct Recorder {
    /// Rate of the PD loop [Hz].
    pub loop_hz: usize,
    /// Every so many samples of the loop are logged.
    pub every: usize,
    /// Duration [s].
    pub duration_s: f64,
    /// Amplitude of the reference per joint [rad; m].
    pub amplitude: Vec<f64>,
    /// Middle of the reference per joint [rad; m].
    pub middle: Vec<f64>,
    /// Fastest sine of the reference [Hz].
    pub fastest_hz: f64,
    /// Stiffness of the PD loop per joint [Nm/rad; N/m].
    pub stiffness: Vec<f64>,
    /// Noise of the command, in parts of its largest.
    pub noise: f64,
    /// Seed of reference and noise.
    pub seed: u128,
}

/// A motion of five sines per joint.
pub struct Reference {
    sines: Vec<Vec<[f64; 3]>>,
    middle: Vec<f64>,
}

impl Reference {
    pub fn of(recorder: &Recorder) -> Self {
        let mut random = Pcg64Mcg::new(recorder.seed << 1 | 1);
        let unit = Uniform::new(0.0, 1.0).unwrap();
        let mut draw = || unit.sample(&mut random);
        let sines = recorder.amplitude.iter().map(|amplitude| {
            let sine = |k: usize| {
                let frequency = recorder.fastest_hz * (k as f64 + 0.5 + 0.5 * draw()) / 5.0;
                [amplitude / (1.0 + k as f64) / 1.5, TAU * frequency, TAU * draw()]
            };
            (0..5).map(sine).collect::<Vec<_>>()
        });
        Self { sines: sines.collect(), middle: recorder.middle.clone() }
    }

    /// Position, velocity and acceleration at a time [s].
    pub fn at(&self, time_s: f64) -> [Vec<f64>; 3] {
        let sum = |f: &dyn Fn(&[f64; 3]) -> f64| -> Vec<f64> {
            self.sines.iter().map(|sines| sines.iter().map(f).sum()).collect()
        };
        let [mut q, qd, qdd] = [
            sum(&|[a, w, p]| a * (w * time_s + p).sin()),
            sum(&|[a, w, p]| a * w * (w * time_s + p).cos()),
            sum(&|[a, w, p]| -a * w * w * (w * time_s + p).sin()),
        ];
        q.iter_mut().zip(&self.middle).for_each(|(q, middle)| *q += middle);
        [q, qd, qdd]
    }
}

/// Torque by command.
pub fn constants(arm: &ArmFile) -> Vec<f64> {
    let constant = |joint: &files::ArmJoint| {
        let drive = joint.drive.as_ref().unwrap();
        if drive.kind == DriveKind::Torque { 1.0 } else { drive.torque_constant.unwrap() }
    };
    arm.joints.iter().map(constant).collect()
}

/// Friction in the unit of the command, effects load_friction and quadratic_drag among it; Coulomb's sign within 0.005
/// rad/s (m/s) of rest is a slope.
pub fn friction(arm: &ArmFile, chain: &SerialChain<f64>, q: &[f64], qd: &[f64]) -> Vec<f64> {
    let of_joint = |(joint, v): (&files::ArmJoint, &f64)| {
        let friction = joint.friction.unwrap();
        let peak =
            friction.peak().map_or(0.0, |[height, width]| height * (-(v / width).powi(2)).exp());
        (friction.alpha0.unwrap() + peak) * (v / 0.005).tanh() + friction.alpha2.unwrap() * v
    };
    let mut all: Vec<f64> = arm.joints.iter().zip(qd).map(of_joint).collect();
    for effect in &arm.effects {
        let joint = usize::from(effect.joint) - 1;
        let value = |name| effect.parameters[name].as_float().unwrap();
        all[joint] += match effect.effect.as_str() {
            "load_friction" => {
                let mut load = vec![0.0; q.len()];
                chain.inverse_dynamics(q, qd, &vec![0.0; q.len()], &mut load);
                let growth = value("coefficient_V_per_Nm");
                growth * load[joint].abs() * (qd[joint] / 0.005).tanh()
            }
            "quadratic_drag" => value("coefficient_V_s2_per_rad2") * qd[joint].abs() * qd[joint],
            other => panic!("{other}"),
        };
    }
    all
}

/// The command that gives a motion.
pub fn command(arm: &ArmFile, [q, qd, qdd]: &[Vec<f64>; 3]) -> Vec<f64> {
    let mut torque = vec![0.0; q.len()];
    let chain = arm.chain().unwrap();
    chain.inverse_dynamics(q, qd, qdd, &mut torque);
    let both = torque.iter().zip(constants(arm)).zip(friction(arm, &chain, q, qd));
    both.map(|((torque, constant), friction)| torque / constant + friction).collect()
}

/// The log of an arm under its PD loop, as CSV with encoder counts.
pub fn record(arm: &ArmFile, recorder: &Recorder) -> String {
    const LONGEST_STEP_S: f64 = 2e-4;
    let (chain, constants) = (arm.chain().unwrap(), constants(arm));
    let steps: Vec<f64> = arm.joints.iter().map(|joint| joint.count_step().unwrap()).collect();
    let reference = Reference::of(recorder);
    let mut random = Pcg64Mcg::new(recorder.seed << 9 | 1);
    let normal = Normal::new(0.0, 1.0).unwrap();
    let period_s = 1.0 / recorder.loop_hz as f64;
    let parts = (period_s / LONGEST_STEP_S).ceil() as usize;
    let [mut q, mut qd, _] = reference.at(0.0);
    let mut text = header(arm);
    for sample in 0..(recorder.duration_s / period_s) as usize {
        let time_s = sample as f64 * period_s;
        let [wanted, speed, _] = reference.at(time_s);
        let counts: Vec<i64> = q.iter().zip(&steps).map(|(q, s)| (q / s).round() as i64).collect();
        let u: Vec<f64> = (0..q.len())
            .map(|joint| {
                let stiffness = recorder.stiffness[joint];
                let error = wanted[joint] - counts[joint] as f64 * steps[joint];
                let torque = stiffness * (error + 0.08 * (speed[joint] - qd[joint]));
                let noise = recorder.noise * stiffness * 0.1 * normal.sample(&mut random);
                (torque + noise) / constants[joint]
            })
            .collect();
        if sample % recorder.every == 0 {
            write!(text, "{time_s:.6}").unwrap();
            for (count, u) in counts.iter().zip(&u) {
                write!(text, ",{count},{u:.7}").unwrap();
            }
            text.push('\n');
        }
        let u = limited(arm, &u);
        for _ in 0..parts {
            step(arm, &chain, &constants, &u, &mut q, &mut qd, period_s / parts as f64);
        }
    }
    text
}

/// What the drives pass on.
fn limited(arm: &ArmFile, u: &[f64]) -> Vec<f64> {
    let limit = |joint: &files::ArmJoint| joint.drive.as_ref().unwrap().limit;
    let of_joint = |(joint, u): (&files::ArmJoint, &f64)| {
        limit(joint).map_or(*u, |limit| u.clamp(-limit, limit))
    };
    arm.joints.iter().zip(u).map(of_joint).collect()
}

fn header(arm: &ArmFile) -> String {
    let columns = (1..).zip(&arm.joints);
    let columns = columns.map(|(n, joint)| format!(",q{n}_count,u{n}_{}", joint.command_unit()));
    format!("t_s{}\n", columns.collect::<String>())
}

/// One step of the Runge-Kutta method of fourth order.
fn step(
    arm: &ArmFile,
    chain: &SerialChain<f64>,
    constants: &[f64],
    u: &[f64],
    q: &mut [f64],
    qd: &mut [f64],
    h: f64,
) {
    let n = q.len();
    let slope = |q: &[f64], qd: &[f64]| {
        let friction = friction(arm, chain, q, qd);
        let torque: Vec<f64> = (0..n).map(|j| constants[j] * (u[j] - friction[j])).collect();
        let mut qdd = vec![0.0; n];
        chain.forward_dynamics(q, qd, &torque, &mut qdd);
        (qd.to_vec(), qdd)
    };
    let moved = |x: &[f64], by: &[f64], h: f64| -> Vec<f64> {
        x.iter().zip(by).map(|(x, by)| x + h * by).collect()
    };
    let a = slope(q, qd);
    let b = slope(&moved(q, &a.0, h / 2.0), &moved(qd, &a.1, h / 2.0));
    let c = slope(&moved(q, &b.0, h / 2.0), &moved(qd, &b.1, h / 2.0));
    let d = slope(&moved(q, &c.0, h), &moved(qd, &c.1, h));
    for j in 0..n {
        q[j] += h / 6.0 * (a.0[j] + 2.0 * b.0[j] + 2.0 * c.0[j] + d.0[j]);
        qd[j] += h / 6.0 * (a.1[j] + 2.0 * b.1[j] + 2.0 * c.1[j] + d.1[j]);
    }
}

/// A data set of logs, the last of them held out.
pub fn write_dataset(directory: &Path, logs: &[String]) {
    let mut list = "format = 1\n".to_owned();
    for (index, log) in logs.iter().enumerate() {
        let role = if index + 1 == logs.len() && index > 0 { "holdout" } else { "train" };
        std::fs::write(directory.join(format!("{index}.csv")), log).unwrap();
        write!(list, "[[log]]\nfile = \"{index}.csv\"\nexperiment = \"task\"\nrole = \"{role}\"\n")
            .unwrap();
    }
    std::fs::write(directory.join("dataset.toml"), list).unwrap();
}

/// What a model's command is wrong by on a motion, rms by the command's rms, per joint; where the
/// joint moves.
pub fn command_error(truth: &ArmFile, model: &ArmFile, recorder: &Recorder) -> Vec<f64> {
    let reference = Reference::of(recorder);
    let mut squares = vec![[0.0; 2]; truth.joints.len()];
    for k in 0..2000 {
        let state = reference.at(0.01 * f64::from(k));
        let (right, found) = (command(truth, &state), command(model, &state));
        for (joint, squares) in squares.iter_mut().enumerate() {
            if state[1][joint].abs() > 0.02 {
                squares[0] += (right[joint] - found[joint]).powi(2);
                squares[1] += right[joint].powi(2);
            }
        }
    }
    squares.iter().map(|[error, all]| (error / all).sqrt()).collect()
}

/// A link's values as unknown.
pub fn forget_links(arm: &mut ArmFile) {
    for joint in &mut arm.joints {
        joint.link = files::arm_file::LinkTable::default();
        joint.armature = None;
        joint.friction = None;
    }
}

/// Unit of a joint's position.
pub fn is_prismatic(arm: &ArmFile, joint: usize) -> bool {
    arm.joints[joint].kind == JointKind::Prismatic
}
