//! A point mass at the tip.

use model::links::{Link, base_parameters};
use model::{BaseParameters, Robot};

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
    /// Base parameters are sums over masses, so those of the mass alone are added.
    fn change_robot(&self, robot: &mut Robot<f64>) {
        let nothing = Link {
            mass_kg: 0.0,
            centre_m: [0.0; 3],
            inertia_diagonal_kg_m2: [0.0; 3],
            inertia_products_kg_m2: [0.0; 3],
        };
        let links = [nothing, nothing, Link { mass_kg: self.mass_kg, ..nothing }];
        let added = base_parameters(&links, &[0.0; 3], &robot.geometry).to_array();
        let mut sum = robot.base.to_array();
        for (parameter, more) in sum.iter_mut().zip(added) {
            *parameter += more;
        }
        robot.base = BaseParameters::from_array(sum);
    }
}
