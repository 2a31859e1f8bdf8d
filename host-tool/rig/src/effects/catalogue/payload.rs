//! A point mass at the tip.

use model::Robot;
use model::effects::with_payload;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, Kind, Parameter, Search, Size, Touches,
};

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
        "an upward force is a payload but for its inertia",
        "fast motion (`excitation`), which a force does not resist",
    )
    .never_paired()],
    compensation: Compensation::Model(|load, values| {
        load.payload_kg += values[0];
        Ok(())
    }),
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
