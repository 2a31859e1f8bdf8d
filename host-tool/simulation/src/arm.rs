//! The arm as a board sees it: counts that its encoders tell, volts that its amplifiers take.

use model::Robot;
use model::vector::Vector3;
use rig::effects::Effect;

use crate::sensor::counts;
use crate::{Settings, SimulatedRobot};

/// How long somebody turns the joints by hand after power-on [ticks].
const TURNING_TICKS: u16 = 1000;
/// How far [counts].
const TURNED_COUNTS: f64 = 10_000.0;

/// What the arm and its encoders are like.
#[derive(Clone, Debug)]
pub struct ArmSettings {
    /// The robot.
    pub robot: Robot<f64>,
    /// Where it is at rest at power-on [rad].
    pub position_rad: Vector3<f64>,
    /// Counts of each encoder in a turn.
    pub counts_per_turn: u32,
    /// Amplifier noise, one sample a tick [V rms].
    pub noise_v: f64,
    /// Same seed, same noise.
    pub seed: u64,
    /// The encoders count from zero at power-on, wherever the robot is; within the second after
    /// it somebody turns each joint by hand, and back.
    pub incremental_encoders: bool,
    /// Encoders that count nothing.
    pub dead_encoders: [bool; 3],
}

impl ArmSettings {
    /// A robot hanging down, with encoders that know where it is.
    pub fn new(robot: Robot<f64>) -> Self {
        let Settings { noise_v, seed, .. } = Settings::default();
        Self {
            robot,
            position_rad: model::HANGING_RAD,
            counts_per_turn: 655_360,
            noise_v,
            seed,
            incremental_encoders: false,
            dead_encoders: [false; 3],
        }
    }
}

/// A simulated robot behind its encoders, a step of 1 ms at a time.
#[derive(Debug)]
pub struct SimulatedArm {
    robot: SimulatedRobot,
    counts_per_turn: u32,
    /// Where the encoders count zero.
    zero: [i64; 3],
    dead: [bool; 3],
    /// Ticks until nobody turns the joints by hand any more.
    turning_ticks: u16,
}

impl SimulatedArm {
    /// The arm at rest, with these effects.
    pub fn new(settings: &ArmSettings, effects: Vec<Box<dyn Effect>>) -> Self {
        let simulation =
            Settings { noise_v: settings.noise_v, seed: settings.seed, ..Settings::default() };
        let (robot, at_rad) = (settings.robot, settings.position_rad);
        let robot = SimulatedRobot::with_effects(robot, effects, at_rad, &simulation);
        let mut arm = Self {
            robot,
            counts_per_turn: settings.counts_per_turn,
            zero: [0; 3],
            dead: settings.dead_encoders,
            turning_ticks: 0,
        };
        if settings.incremental_encoders {
            arm.zero = counts(&arm.robot.reading_rad(), arm.counts_per_turn);
            arm.turn_by_hand();
        }
        arm
    }

    /// What the encoders tell.
    pub fn counts(&self) -> [i32; 3] {
        let now = counts(&self.robot.reading_rad(), self.counts_per_turn);
        let turned = self.turned_by_hand();
        [0, 1, 2].map(|i| match self.dead[i] {
            true => 0,
            false => (now[i] - self.zero[i] + turned) as i32,
        })
    }

    /// Lets these voltages act for a tick.
    pub fn advance(&mut self, command_v: &Vector3<f64>) {
        self.robot.advance(command_v);
        self.turning_ticks = self.turning_ticks.saturating_sub(1);
    }

    /// Somebody turns each joint by hand in the next second, and back.
    pub fn turn_by_hand(&mut self) {
        self.turning_ticks = TURNING_TICKS;
    }

    /// The robot itself.
    pub fn robot(&self) -> &SimulatedRobot {
        &self.robot
    }

    /// How far a hand has turned each joint [counts].
    fn turned_by_hand(&self) -> i64 {
        let phase = f64::from(self.turning_ticks) / f64::from(TURNING_TICKS);
        (TURNED_COUNTS * (std::f64::consts::PI * phase).sin().powi(2)) as i64
    }
}
