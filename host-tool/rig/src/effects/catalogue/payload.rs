//! A point mass at the tip.

use model::vector::Vector3;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, Kind, Parameter, Search, Size, Touches,
};
use crate::plant::Plant;

pub(super) const DEFINITION: Definition = Definition {
    name: "payload",
    words: "a mass hangs at the tip",
    equation: "point mass m at the origin of frame 3",
    whole_robot: true,
    parameters: &[Parameter::new("mass_kg", Kind::Mass, 0.0, 50.0)],
    couples_joints: true,
    touches: Touches::BODY,
    search: Search::From(|_| vec![vec![0.1]]),
    size: Size::grows(|_| 5.0),
    draw: |_, random| vec![random.log_uniform(0.1, 1.0)],
    confused_with: &[Confusion::effect(
        "tip_force",
        "a downward force acts like a payload, except that it has no inertia",
        "fast motion (`rrr run excitation`): a force has no inertia",
    )
    .never_paired()],
    compensation: Compensation::Model(|load, values| {
        load.payload_kg += values[0];
        Ok(())
    }),
    experiment: "motion that accelerates the tip (`rrr run excitation`)",
    build: |_, values| Box::new(Payload { mass_kg: values[0], at_m: [0.0; 3] }),
};

/// On an arm of any kind: a mass anywhere in the last link's frame, negative where the model
/// carries more than the robot.
pub(super) const OF_ARM: Definition = Definition {
    equation: "point mass m at c in the frame of the last link",
    parameters: &[
        Parameter::new("mass_kg", Kind::Mass, -50.0, 50.0),
        PLACE.optional(),
        PLACE.optional(),
        PLACE.optional(),
    ],
    // Sizes are parts of what moves; places from the link's frame outwards, in every direction.
    search: Search::From(|_| {
        let places = [[0.05, 0.05, 0.05], [0.3, 0.02, 0.02], [0.02, 0.3, 0.02], [0.02, 0.02, 0.3]];
        let others = [[-0.3, 0.02, 0.02], [0.02, -0.3, 0.02], [0.02, 0.02, -0.3]];
        let start = |at: [f64; 3]| vec![0.1, at[0], at[1], at[2]];
        places.into_iter().chain(others).map(start).collect()
    }),
    compensation: Compensation::None("the board drives another arm"),
    build: |_, values| {
        Box::new(Payload { mass_kg: values[0], at_m: [values[1], values[2], values[3]] })
    },
    ..DEFINITION
};

/// A component of where the mass is.
const PLACE: Parameter = Parameter::new("com_m", Kind::Place, -2.0, 2.0);

#[derive(Clone, Debug)]
struct Payload {
    mass_kg: f64,
    /// Where it is in the frame of the last link.
    at_m: Vector3<f64>,
}

impl Effect for Payload {
    fn change_robot(&self, plant: &mut Plant) {
        plant.body.add_payload(self.mass_kg, self.at_m);
    }
}
