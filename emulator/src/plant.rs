//! What stands at the encoders and at the converter's outputs.

use simulation::arm::SimulatedArm;

/// An arm, a step of a millisecond at a time.
pub trait Plant {
    /// What the encoders have counted.
    fn counts(&self) -> [i32; 3];
    /// Lets voltages act for a step [V].
    fn advance(&mut self, volts: &[f64; 3]);
    /// The board begins anew: its encoders count from zero, and somebody moves each joint.
    fn board_was_reset(&mut self) {}
}

impl Plant for SimulatedArm {
    fn counts(&self) -> [i32; 3] {
        self.counts()
    }

    fn advance(&mut self, volts: &[f64; 3]) {
        self.advance(volts);
    }

    fn board_was_reset(&mut self) {
        self.turn_by_hand();
    }
}

/// An arm that does not move.
#[derive(Clone, Copy, Debug, Default)]
pub struct Still;

impl Plant for Still {
    fn counts(&self) -> [i32; 3] {
        [0; 3]
    }

    fn advance(&mut self, _: &[f64; 3]) {}
}
