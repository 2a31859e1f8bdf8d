//! Something level that the tip pushes on: a table, a floor.

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size,
    Touches, Typical,
};
use crate::plant::Plant;

pub(super) const DEFINITION: Definition = Definition {
    name: "contact",
    words: "the tip pushes on something level, a table say",
    equation: "torque + J^T (0, 0, k max(0, h - z)), z the height of the tip in the base frame",
    whole_robot: true,
    parameters: &[
        Parameter::new("stiffness_N_per_m", Kind::Stiffness, 1.0, 1e6),
        Parameter::new("height_m", Kind::Place, -10.0, 10.0),
    ],
    couples_joints: true,
    touches: Touches::DRIVE,
    search: Search::From(starts),
    size: Size::grows(|typical| {
        let [lowest, highest] = typical.tip_height_m;
        typical.load_nm / (highest - lowest).max(1e-3).powi(2)
    }),
    draw: |_, random| vec![random.log_uniform(100.0, 1e4), random.uniform(-0.3, 0.0)],
    confused_with: &[
        Confusion::effect(
            "tip_force",
            "where the tip is always below the height both push it up",
            "motion whose greater part is free",
        ),
        Confusion::effect(
            "payload",
            "in the lowest postures both change what the joints hold, with opposite signs",
            "motion whose greater part is free",
        ),
    ],
    compensation: Compensation::None("what stands in the arm's way is to be taken away"),
    experiment: "the same motion free and in contact",
    build: |_, values| Box::new(Contact { stiffness_n_per_m: values[0], height_m: values[1] }),
};

/// Heights in the lower part of what the tip reaches, soft enough for a search to move them; none where
/// the tip stays level.
fn starts(typical: &Typical) -> Vec<Vec<f64>> {
    let [lowest, highest] = typical.tip_height_m;
    let range = highest - lowest;
    if range < 1e-3 {
        return Vec::new();
    }
    let stiffness = typical.load_nm / (range * range);
    [0.05, 0.2].map(|part| vec![stiffness, lowest + part * range]).to_vec()
}

#[derive(Clone, Debug)]
struct Contact {
    stiffness_n_per_m: f64,
    height_m: f64,
}

impl Effect for Contact {
    fn add_torque(&self, state: &JointState, plant: &Plant, torque_nm: &mut [f64]) {
        let depth_m = self.height_m - plant.body.tip_height_m(state.q_rad);
        if depth_m > 0.0 {
            let force_n = [0.0, 0.0, self.stiffness_n_per_m * depth_m];
            plant.body.add_tip_force(state.q_rad, &force_n, torque_nm);
        }
    }
}
