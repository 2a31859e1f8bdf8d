//! The simulated arm with its encoders, which may jump.

use model::reference_robot::reference_robot;
use simulation::sensor::counts;
use simulation::{Settings, SimulatedRobot};

/// Encoder counts of a turn.
pub const COUNTS_PER_TURN: u32 = 655_360;

/// The arm.
#[derive(Debug)]
pub struct Arm {
    robot: SimulatedRobot,
    /// What jumps have added to each encoder.
    jumped: [i64; 3],
}

impl Arm {
    /// Hanging at rest.
    pub fn hanging(seed: u64) -> Self {
        // Friction takes its exact step, so a quarter of a tick is fine enough for a soak.
        let settings = Settings { substeps: 4, seed, ..Settings::default() };
        let start = [0.0, -std::f64::consts::FRAC_PI_2, 0.0];
        Self { robot: SimulatedRobot::at_rest(reference_robot(), start, &settings), jumped: [0; 3] }
    }

    /// Counts since power-on, wrapping at 32 bits as the board's do.
    pub fn counts(&self) -> [i32; 3] {
        let counts = counts(self.robot.q_rad(), COUNTS_PER_TURN);
        [0, 1, 2].map(|i| (counts[i] + self.jumped[i]) as i32)
    }

    /// Where the encoders say the joints are, within half a turn of zero [rad].
    pub fn seen_rad(&self) -> [f32; 3] {
        self.counts().map(|count| {
            let turn = COUNTS_PER_TURN as i32;
            let within = (count + turn / 2).rem_euclid(turn) - turn / 2;
            within as f32 / COUNTS_PER_TURN as f32 * std::f32::consts::TAU
        })
    }

    /// Lets an encoder jump.
    pub fn jump(&mut self, joint: usize, by_counts: i64) {
        self.jumped[joint] += by_counts;
    }

    /// Takes the jumps back.
    pub fn forget_jumps(&mut self) {
        self.jumped = [0; 3];
    }

    /// Lets voltages act for a tick.
    pub fn advance(&mut self, command_v: [f64; 3]) {
        self.robot.advance(&command_v);
    }
}
