//! Servo arms simulated for tests and blind trials: links, motions, effects, encoders.

use files::arm_file::{ArmFriction, Drive, DriveKind, Encoder, EncoderSide, LinkTable};
use files::{ArmFile, ArmJoint, ArmJointLog, ArmLog, Role};
use model::chain::SerialChain;
use rand_distr::{Distribution, Normal, Uniform};
use rand_pcg::Pcg64Mcg;
use recordings::{ArmCampaign, ArmRecording};

use crate::along::without_rotors;
use crate::arm_replay::Arm;
use crate::joint::ServoJoint;
use crate::step::State;

/// How a simulated arm is recorded.
#[derive(Clone, Copy, Debug)]
pub struct Recording {
    /// Rows a second.
    pub rate_hz: f64,
    /// Length of a log [s].
    pub length_s: f64,
    /// How long after its goal a row's position is read [s].
    pub read_after_s: f64,
    /// Train logs, and logs held out.
    pub logs: [usize; 2],
    /// How far joints swing [rad].
    pub swing_rad: f64,
}

impl Default for Recording {
    fn default() -> Self {
        Self { rate_hz: 50.0, length_s: 40.0, read_after_s: 0.006, logs: [8, 4], swing_rad: 0.8 }
    }
}

/// A servo of the kind of hobby arms, with friction that differs by a tenth from one to the next.
fn servo_joint(name: &str, random: &mut Pcg64Mcg) -> ArmJoint {
    let spread = Normal::new(1.0, 0.1).expect("a deviation above zero");
    let mut about = |value: f64| value * f64::clamp(spread.sample(random), 0.7, 1.3);
    ArmJoint {
        name: Some(name.to_owned()),
        axis: [0.0, 0.0, 1.0],
        armature: Some(about(0.02)),
        drive: Some(Drive {
            kind: DriveKind::PositionServo,
            torque_constant: Some(0.5),
            stiffness: Some(29.0),
            limit: Some(10.6),
            ..Drive::default()
        }),
        encoder: Some(Encoder { counts: 4096.0, side: EncoderSide::Joint }),
        friction: Some(ArmFriction {
            alpha0: Some(about(0.15)),
            alpha1: Some(0.0),
            stribeck_velocity: Some(0.1),
            alpha2: Some(about(1.2)),
            ..ArmFriction::default()
        }),
        ..ArmJoint::default()
    }
}

fn link(mass_kg: f64, com_m: [f64; 3]) -> LinkTable {
    let size = mass_kg * 4e-4;
    LinkTable {
        mass_kg: Some(mass_kg),
        com_m: Some(com_m),
        inertia_kg_m2: Some([size, 0.0, 0.0, size, 0.0, size]),
    }
}

fn upright(name: &str, joints: Vec<ArmJoint>) -> ArmFile {
    let mut file = ArmFile::default();
    file.name = Some(name.to_owned());
    file.gravity_m_s2 = [0.0, 0.0, -9.81];
    file.joints = joints;
    file
}

/// A pendulum of one servo about a horizontal axis, hanging at zero: a mass [kg] at a distance [m].
pub fn pendulum(seed: u64, mass_kg: f64, length_m: f64) -> ArmFile {
    let mut random = Pcg64Mcg::new(u128::from(seed));
    let joint = ArmJoint {
        axis: [0.0, -1.0, 0.0],
        link: link(mass_kg, [0.0, 0.0, -length_m]),
        ..servo_joint("swing", &mut random)
    };
    upright("pendulum", vec![joint])
}

/// A joint's name, its origin [m], its axis, its link's mass [kg] and centre [m].
type Place = (&'static str, [f64; 3], [f64; 3], f64, [f64; 3]);

/// An arm of six servos: turn, shoulder, elbow, wrist about three axes, 0.35 m long.
pub fn six_axes(seed: u64) -> ArmFile {
    let mut random = Pcg64Mcg::new(u128::from(seed));
    let places: [Place; 6] = [
        ("turn", [0.0, 0.0, 0.05], [0.0, 0.0, 1.0], 0.15, [0.0, 0.0, 0.03]),
        ("shoulder", [0.0, 0.0, 0.05], [0.0, 1.0, 0.0], 0.12, [0.06, 0.0, 0.0]),
        ("elbow", [0.12, 0.0, 0.0], [0.0, 1.0, 0.0], 0.11, [0.06, 0.0, 0.0]),
        ("pitch", [0.12, 0.0, 0.0], [0.0, 1.0, 0.0], 0.08, [0.03, 0.0, 0.0]),
        ("roll", [0.06, 0.0, 0.0], [1.0, 0.0, 0.0], 0.06, [0.02, 0.0, 0.0]),
        ("yaw", [0.04, 0.0, 0.0], [0.0, 0.0, 1.0], 0.05, [0.03, 0.0, 0.0]),
    ];
    let joints = places.into_iter().map(|(name, origin, axis, mass, centre)| ArmJoint {
        origin_xyz_m: origin,
        axis,
        link: link(mass, centre),
        ..servo_joint(name, &mut random)
    });
    upright("six-axes", joints.collect())
}

/// A goal over time: sines, or steps held for a while.
enum Motion {
    Sines([[f64; 3]; 3]),
    Steps(f64, Vec<f64>),
}

impl Motion {
    fn draw(recording: &Recording, random: &mut Pcg64Mcg) -> Self {
        let unit = Uniform::new(0.0, 1.0).expect("a range");
        let mut draw = || unit.sample(&mut *random);
        let swing = recording.swing_rad;
        if draw() < 0.6 {
            let mut sine = || {
                let frequency = 0.08 * 8.0_f64.powf(draw());
                [swing * (0.2 + 0.3 * draw()), std::f64::consts::TAU * frequency, 6.3 * draw()]
            };
            return Self::Sines([sine(), sine(), sine()]);
        }
        let hold = 0.7 + 2.0 * draw();
        let count = (recording.length_s / hold) as usize + 2;
        Self::Steps(hold, (0..count).map(|_| 0.8 * swing * (2.0 * draw() - 1.0)).collect())
    }

    fn at(&self, t: f64) -> f64 {
        match self {
            Self::Sines(parts) => parts.iter().map(|[a, w, p]| a * (w * t + p).sin()).sum(),
            Self::Steps(hold, goals) => goals[(t / hold) as usize],
        }
    }
}

/// Logs of joints under their servos, links without rotors; other seeds, other motions.
pub fn record(
    file: &ArmFile,
    links: &SerialChain<f64>,
    servos: &[ServoJoint],
    recording: &Recording,
    seed: u64,
) -> ArmCampaign {
    let mut random = Pcg64Mcg::new(u128::from(seed) ^ 0xfeed);
    let [train, held_out] = recording.logs;
    let of = |k: usize| ArmRecording {
        file: format!("motion-{:02}.csv", k + 1),
        role: if k < train { Role::Train } else { Role::Holdout },
        log: log(file, links, servos, recording, &mut random),
    };
    ArmCampaign { arm: file.clone(), recordings: (0..train + held_out).map(of).collect() }
}

fn log(
    file: &ArmFile,
    links: &SerialChain<f64>,
    servos: &[ServoJoint],
    recording: &Recording,
    random: &mut Pcg64Mcg,
) -> ArmLog {
    /// Steps of a row: 1 ms at 50 Hz.
    const STEPS: usize = 20;
    let motions: Vec<Motion> = servos.iter().map(|_| Motion::draw(recording, random)).collect();
    let rest = |motion: &Motion| State { q: motion.at(0.0), ..State::default() };
    let mut arm = Arm::of(links, servos, motions.iter().map(rest).collect());
    let h = 1.0 / recording.rate_hz / STEPS as f64;
    let read_at = (recording.read_after_s / h).round() as usize;
    let mut log = ArmLog { time_s: Vec::new(), joints: vec![ArmJointLog::default(); servos.len()] };
    // What is logged begins once the arm has sagged into its first goals.
    let settle = recording.rate_hz as usize;
    let rows = (recording.length_s * recording.rate_hz) as usize;
    for row in 0..rows + settle {
        let t = row.saturating_sub(settle) as f64 / recording.rate_hz;
        let goals: Vec<f64> = motions.iter().map(|motion| motion.at(t)).collect();
        for step in 0..STEPS {
            if step == read_at && row >= settle {
                push(&mut log, file, t, &goals, &arm.states);
            }
            arm.step(|joint| goals[joint], h, t + step as f64 * h);
        }
    }
    log
}

fn push(log: &mut ArmLog, file: &ArmFile, t: f64, goals: &[f64], states: &[State]) {
    log.time_s.push(t);
    for (joint, track) in log.joints.iter_mut().enumerate() {
        let step = file.joints[joint].count_step().unwrap_or(1e-6);
        track.command.push(goals[joint]);
        track.position.push((states[joint].q / step).round() * step);
    }
}

/// The links of a file without rotors.
///
/// # Panics
/// A file whose links are not known.
pub fn links_of(file: &ArmFile) -> SerialChain<f64> {
    without_rotors(&file.chain().expect("links that are known"))
}
