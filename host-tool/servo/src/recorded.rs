//! Servo arms recorded: goals drawn, the whole arm simulated, positions as encoders read them.

use files::{ArmFile, ArmJointLog, ArmLog, Role};
use model::chain::SerialChain;
use rand_pcg::Pcg64Mcg;
use recordings::{ArmCampaign, ArmRecording};

use crate::arm_replay::Arm;
use crate::goals::Motion;
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

/// An arm as it is, which may not be as its file says.
#[derive(Clone, Debug)]
pub struct Truth {
    /// The links without rotors.
    pub links: SerialChain<f64>,
    /// The joints.
    pub servos: Vec<ServoJoint>,
    /// A force that always acts on the tip, base frame [N].
    pub force_n: [f64; 3],
}

impl Truth {
    /// An arm without a force on its tip.
    pub fn of(links: SerialChain<f64>, servos: Vec<ServoJoint>) -> Self {
        Self { links, servos, force_n: [0.0; 3] }
    }
}

/// Logs of an arm under its servos, `file` for encoders and ranges; other seeds, other motions.
pub fn record(file: &ArmFile, truth: &Truth, recording: &Recording, seed: u64) -> ArmCampaign {
    // Other numbers than those that an arm of the same seed was drawn by.
    let mut random = Pcg64Mcg::new((0xfeed_u128 << 64) | (u128::from(seed) << 1) | 1);
    let [train, held_out] = recording.logs;
    let of = |k: usize| ArmRecording {
        file: format!("motion-{:02}.csv", k + 1),
        role: if k < train { Role::Train } else { Role::Holdout },
        log: Recorder::new(file, truth, recording, k, &mut random).log(),
    };
    ArmCampaign { arm: file.clone(), recordings: (0..train + held_out).map(of).collect() }
}

/// Steps of a row: 1 ms at 50 Hz.
const STEPS: usize = 20;

/// Whether a joint swings in a log or steps: of any five logs in a row it steps in two, so that logs to
/// fit to hold what logs to confirm on ask for.
fn is_sines(log: usize, joint: usize) -> bool {
    (2 * log + joint) % 5 < 3
}

/// A recording under way.
struct Recorder<'a> {
    file: &'a ArmFile,
    truth: &'a Truth,
    recording: &'a Recording,
    motions: Vec<Motion>,
    arm: Arm<'a>,
    /// Positions behind the joints' play.
    behind: Vec<f64>,
    log: ArmLog,
}

impl<'a> Recorder<'a> {
    fn new(
        file: &'a ArmFile,
        truth: &'a Truth,
        recording: &'a Recording,
        number: usize,
        random: &mut Pcg64Mcg,
    ) -> Self {
        let of = |(index, joint)| {
            let (swing, length_s) = (recording.swing_rad, recording.length_s);
            Motion::draw(joint, swing, length_s, is_sines(number, index), random)
        };
        let motions: Vec<Motion> = file.joints.iter().enumerate().map(of).collect();
        let start: Vec<f64> = motions.iter().map(|motion| motion.at(0.0)).collect();
        let rest = |q: &f64| State { q: *q, ..State::default() };
        let mut arm = Arm::of(&truth.links, &truth.servos, start.iter().map(rest).collect());
        arm.force_n = truth.force_n;
        let joints = vec![ArmJointLog::default(); start.len()];
        let log = ArmLog { time_s: Vec::new(), joints };
        Self { file, truth, recording, motions, arm, behind: start, log }
    }

    /// What is logged begins a second on, when the arm has sagged into its first goals.
    fn log(mut self) -> ArmLog {
        let rate_hz = self.recording.rate_hz;
        let h = 1.0 / rate_hz / STEPS as f64;
        let read_at = ((self.recording.read_after_s / h).round() as usize).min(STEPS - 1);
        let settle = rate_hz as usize;
        let rows = (self.recording.length_s * rate_hz) as usize;
        for row in 0..rows + settle {
            let t = row.saturating_sub(settle) as f64 / rate_hz;
            for step in 0..STEPS {
                if step == read_at && row >= settle {
                    self.push(t);
                }
                let now = t + step as f64 * h;
                let goals = self.goals(now);
                self.arm.step(|joint| goals[joint], h, now);
            }
        }
        self.log
    }

    /// The goals that act at a time [s]: those of the row that was sent last, late where a joint's
    /// goals act late.
    fn goals(&self, now: f64) -> Vec<f64> {
        let rate_hz = self.recording.rate_hz;
        let of = |(motion, servo): (&Motion, &ServoJoint)| {
            let late_s = (-servo.read_after_s).max(0.0);
            motion.at((((now - late_s) * rate_hz + 1e-6).floor() / rate_hz).max(0.0))
        };
        self.motions.iter().zip(&self.truth.servos).map(of).collect()
    }

    /// A row: what the encoders read behind their play.
    fn push(&mut self, t: f64) {
        self.log.time_s.push(t);
        for (joint, track) in self.log.joints.iter_mut().enumerate() {
            let step = self.file.joints[joint].count_step().unwrap_or(1e-6);
            let (q, half) = (self.arm.states[joint].q, 0.5 * self.truth.servos[joint].gap);
            let read = &mut self.behind[joint];
            *read = read.clamp(q - half, q + half);
            track.command.push(self.motions[joint].at(t));
            track.position.push((*read / step).round() * step);
        }
    }
}
