//! A gap between motor and link.

use crate::effects::{
    Compensation, Definition, Effect, Kind, Parameter, Search, Size, Touches, Transmission, Typical,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "backlash",
    words: "motor and link meet only beyond a gap",
    equation: "spring and damper beyond a gap of gap_rad in all",
    whole_robot: false,
    parameters: &[
        Parameter::new("gap_rad", Kind::Gap, 0.0, 0.5),
        Parameter::new("stiffness_Nm_per_rad", Kind::Stiffness, 1.0, 1e6),
        Parameter::new("damping_Nm_s_per_rad", Kind::Damping, 0.0, 1e3),
        Parameter::new("motor_inertia_kg_m2", Kind::Inertia, 1e-5, 10.0),
    ],
    couples_joints: true,
    touches: Touches::BODY,
    search: Search::From(starts),
    size: Size::grows(|_| 0.03),
    draw: |context, random| {
        let gap_rad = random.log_uniform(5e-4, 5e-3);
        [&[gap_rad], &context.spring(random, 20.0, 60.0)[..]].concat()
    },
    confused_with: &[],
    compensation: Compensation::None("the encoder sees the motor, not the link"),
    experiment: "slow motion and noise in the command, which reverse the torque (`rrr run slow` and `rrr run driven-noise`)",
    build: |joint, values| {
        let transmission = Transmission {
            gap_rad: values[0],
            stiffness_nm_per_rad: values[1],
            damping_nm_s_per_rad: values[2],
            motor_inertia_kg_m2: values[3],
        };
        Box::new(Backlash { joint: usize::from(joint) - 1, transmission })
    },
};

/// Gaps from half a mrad to what a worn gear has, and a stiff spring beyond.
fn starts(typical: &Typical) -> Vec<Vec<f64>> {
    let mut starts = Vec::new();
    for gap_rad in [5e-4, 2e-3, 8e-3, 3e-2] {
        for resonance_hz in [12.0, 20.0, 35.0] {
            let [stiffness, damping, inertia] = typical.spring(resonance_hz, 0.13);
            starts.push(vec![gap_rad, stiffness, damping, inertia]);
        }
    }
    starts
}

#[derive(Clone, Debug)]
struct Backlash {
    joint: usize,
    transmission: Transmission,
}

impl Effect for Backlash {
    fn transmission(&self) -> Option<(usize, Transmission)> {
        Some((self.joint, self.transmission))
    }
}
