//! An encoder disc that runs out of true.

use crate::effects::{
    Compensation, Confusion, Definition, Effect, Kind, Parameter, Search, Size, Touches,
};
use crate::plant::Gear;

pub(super) const DEFINITION: Definition = Definition {
    name: "encoder_eccentricity",
    words: "the encoder's disc is out of centre",
    equation: "reads q + a sin(q + phi)",
    whole_robot: false,
    parameters: &[
        Parameter::new("amplitude_rad", Kind::Amplitude, 0.0, 0.2),
        Parameter::new("phase_rad", Kind::Phase, -6.3, 6.3),
    ],
    couples_joints: true,
    touches: Touches::READING,
    search: Search::From(|_| [0.0, 1.5, 3.0, -1.5].map(|phase_rad| vec![2e-3, phase_rad]).to_vec()),
    size: Size::grows(|_| 0.05),
    draw: |_, random| vec![random.log_uniform(3e-3, 1.5e-2), random.phase_rad()],
    confused_with: &[Confusion::model(
        "coupling inertias",
        "slow turns leave little of it, and a smooth error of acceleration is an inertia's",
        "fast turns: its error grows with the square of speed",
    )],
    compensation: Compensation::None("the board takes its encoders for true"),
    experiment: "fast motion over whole turns (`rrr run excitation`)",
    build: |joint, values| {
        Box::new(EncoderEccentricity {
            joint: usize::from(joint) - 1,
            amplitude_rad: values[0],
            phase_rad: values[1],
            encoder_turns: 1.0,
        })
    },
};

#[derive(Clone, Debug)]
struct EncoderEccentricity {
    joint: usize,
    amplitude_rad: f64,
    phase_rad: f64,
    /// Turns of the encoder's shaft per turn of the joint.
    encoder_turns: f64,
}

impl Effect for EncoderEccentricity {
    fn set_gears(&mut self, gears: &[Gear]) {
        self.encoder_turns = gears[self.joint].encoder;
    }

    fn change_reading(&self, q_rad: &mut [f64]) {
        let angle = self.encoder_turns * q_rad[self.joint] + self.phase_rad;
        q_rad[self.joint] += self.amplitude_rad / self.encoder_turns * angle.sin();
    }
}
