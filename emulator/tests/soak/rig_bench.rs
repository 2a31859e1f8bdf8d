//! The arm, its amplifiers and its encoder cables, with switches for what goes wrong.

use std::cell::Cell;
use std::rc::Rc;

use emulator::plant::Plant;
use model::reference_robot::reference_robot;
use simulation::arm::{ArmSettings, SimulatedArm};

/// What a soak switches, and where the arm is.
#[derive(Debug)]
pub struct Switches {
    /// The amplifiers pass the voltage on.
    pub amplifiers: Cell<bool>,
    /// What each encoder has counted without having moved.
    pub jumped: Cell<[i32; 3]>,
    /// Somebody turns each joint by hand, once.
    pub turn_by_hand: Cell<bool>,
    /// Where the joints are [rad].
    pub position_rad: Cell<[f64; 3]>,
    /// How fast they are [rad/s].
    pub speed_rad_per_s: Cell<[f64; 3]>,
}

/// The arm behind its switches.
pub struct RigBench {
    arm: SimulatedArm,
    switches: Rc<Switches>,
}

impl RigBench {
    /// An arm that hangs at rest.
    pub fn new() -> (Self, Rc<Switches>) {
        let mut settings = ArmSettings::new(reference_robot());
        settings.incremental_encoders = true;
        let switches = Rc::new(Switches {
            amplifiers: Cell::new(true),
            jumped: Cell::default(),
            turn_by_hand: Cell::default(),
            position_rad: Cell::new(settings.position_rad),
            speed_rad_per_s: Cell::default(),
        });
        let arm = SimulatedArm::new(&settings, Vec::new());
        (Self { arm, switches: switches.clone() }, switches)
    }
}

impl Plant for RigBench {
    fn counts(&self) -> [i32; 3] {
        let (counts, jumped) = (self.arm.counts(), self.switches.jumped.get());
        [0, 1, 2].map(|i| counts[i].wrapping_add(jumped[i]))
    }

    fn advance(&mut self, volts: &[f64; 3]) {
        let volts = if self.switches.amplifiers.get() { *volts } else { [0.0; 3] };
        if self.switches.turn_by_hand.take() {
            self.arm.turn_by_hand();
        }
        self.arm.advance(&volts);
        self.switches.position_rad.set(*self.arm.robot().q_rad());
        self.switches.speed_rad_per_s.set(*self.arm.robot().qd_rad_per_s());
    }

    fn board_was_reset(&mut self) {
        self.arm.turn_by_hand();
    }
}
