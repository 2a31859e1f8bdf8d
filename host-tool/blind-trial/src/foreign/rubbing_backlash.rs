//! Play in a gear whose teeth rub on their way through the gap.

use super::definition::Definition;
use rig::effects::{Effect, Transmission};

/// The joint's inertia as far as springs are drawn by it [kg m^2]: the reference robot's.
const INERTIA_KG_M2: [f64; 3] = [1.2, 0.6, 0.07];

pub(super) const DEFINITION: Definition = Definition {
    name: "rubbing_backlash",
    words: "backlash, and dry friction between motor and link in the gap and out of it",
    resembles: &["backlash", "joint_elasticity"],
    equivalent: &["backlash", "joint_elasticity"],
    grows: true,
    parameters: &[
        "gap_rad",
        "stiffness_Nm_per_rad",
        "damping_Nm_s_per_rad",
        "motor_inertia_kg_m2",
        "friction_Nm",
    ],
    draw: |joint, random| {
        let motor = random.uniform(0.05, 0.3) * INERTIA_KG_M2[joint];
        let link = INERTIA_KG_M2[joint] - motor;
        let frequency = std::f64::consts::TAU * random.log_uniform(20.0, 60.0);
        let damping = 2.0 * random.log_uniform(0.02, 0.1) * link * frequency;
        let friction_nm = random.log_uniform(0.02, 0.3) * [2.0, 1.0, 0.3][joint];
        let gap_rad = random.log_uniform(5e-4, 5e-3);
        vec![gap_rad, link * frequency * frequency, damping, motor, friction_nm]
    },
    build: |joint, values| {
        let transmission = Transmission {
            gap_rad: values[0],
            stiffness_nm_per_rad: values[1],
            damping_nm_s_per_rad: values[2],
            motor_inertia_kg_m2: values[3],
        };
        Box::new(RubbingBacklash { joint, transmission, friction_nm: values[4] })
    },
};

#[derive(Clone, Debug)]
struct RubbingBacklash {
    joint: usize,
    transmission: Transmission,
    friction_nm: f64,
}

impl Effect for RubbingBacklash {
    fn transmission(&self) -> Option<(usize, Transmission)> {
        Some((self.joint, self.transmission))
    }

    fn transmission_friction_nm(&self) -> Option<(usize, f64)> {
        Some((self.joint, self.friction_nm))
    }
}
