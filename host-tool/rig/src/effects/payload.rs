//! A point mass at the tip.

use model::Robot;
use model::effects::with_payload;

use super::{Definition, Effect, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "payload",
    words: "a mass hangs at the tip",
    equation: "point mass m at the origin of frame 3",
    whole_robot: true,
    parameters: &[Parameter::new("mass_kg", 0.0, 50.0)],
    couples_joints: true,
    touches: Touches::BODY,
    search: Search::From(|_| vec![vec![0.1]]),
    size: Size::grows(|_| 5.0),
    experiment: "`rrr run excitation`, which accelerates the tip",
    build: |_, values| Box::new(Payload { mass_kg: values[0] }),
};

#[derive(Clone, Debug)]
struct Payload {
    mass_kg: f64,
}

impl Effect for Payload {
    fn change_robot(&self, robot: &mut Robot<f64>) {
        robot.base = with_payload(&robot.base, &robot.geometry, self.mass_kg);
    }
}
