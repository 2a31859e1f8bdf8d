//! A base that does not stand level.

use firmware::compensation::limits;
use model::effects::Tilt;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};
use crate::plant::Plant;

pub(super) const DEFINITION: Definition = Definition {
    name: "base_tilt",
    words: "the base leans, so gravity does not point along the first axis",
    equation: "gravity g (sin b, -sin a cos b, -cos a cos b) in the base frame",
    whole_robot: true,
    parameters: &[
        Parameter::new("tilt_x_rad", Kind::Rotation, -0.5, 0.5),
        Parameter::new("tilt_y_rad", Kind::Rotation, -0.5, 0.5),
        Parameter::of_board(
            "hidden_moment_reach_kg_m",
            Kind::FirstMoment,
            limits::HIDDEN_MOMENT_KG_M,
        )
        .optional(),
        Parameter::of_board(
            "hidden_moment_side_kg_m",
            Kind::FirstMoment,
            limits::HIDDEN_MOMENT_KG_M,
        )
        .optional(),
    ],
    couples_joints: true,
    touches: Touches::DRIVE,
    search: Search::From(|_| {
        // Along either axis and between them, and with what no base parameter holds.
        vec![
            vec![0.02, 0.02, 0.1, 0.1],
            vec![0.02, 0.0, 0.0, 0.0],
            vec![0.0, 0.02, 0.0, 0.0],
            vec![0.02, -0.02, 0.1, -0.1],
            vec![0.02, 0.02, -0.3, 0.3],
        ]
    }),
    size: Size::grows(|_| 0.2),
    draw: |_, random| {
        let size_rad = random.log_uniform(0.01, 0.1);
        let (sine, cosine) = random.phase_rad().sin_cos();
        let hidden_kg_m = [random.uniform(-1.0, 2.0), random.uniform(-0.5, 0.5)];
        vec![size_rad * cosine, size_rad * sine, hidden_kg_m[0], hidden_kg_m[1]]
    },
    confused_with: &[Confusion::model(
        "moments that a level base hides",
        "the first moments of link 1 and those along joint axis 2 are not among the 16 \
         parameters; they show on joint 1 only when the base leans",
        "slow motion of joint 1 over a whole turn",
    )],
    compensation: Compensation::Model(|load, values| {
        if load.tilt.is_some() {
            return Err("the board knows one tilt, and the model holds two");
        }
        load.tilt = Some(tilt(values));
        Ok(())
    }),
    experiment: "motion of joint 1 over a whole turn",
    build: |_, values| Box::new(BaseTilt { tilt: tilt(values) }),
};

/// On an arm of any kind, whose links hold all moments.
pub(super) const OF_ARM: Definition = Definition {
    words: "the base leans, so gravity comes from another side",
    equation: "gravity (0, 0, -g) becomes g (sin b, -sin a cos b, -cos a cos b) in the base frame",
    parameters: &[
        Parameter::new("tilt_x_rad", Kind::Rotation, -0.5, 0.5),
        Parameter::new("tilt_y_rad", Kind::Rotation, -0.5, 0.5),
    ],
    search: Search::From(|_| {
        [[0.02, 0.02], [0.02, 1e-4], [1e-4, 0.02], [0.02, -0.02]].map(|tilt| tilt.to_vec()).to_vec()
    }),
    compensation: Compensation::None("the board drives another arm"),
    build: |_, values| Box::new(BaseTilt { tilt: Tilt::new(values[0], values[1], [0.0; 2]) }),
    ..DEFINITION
};

fn tilt(values: &[f64]) -> Tilt<f64> {
    Tilt::new(values[0], values[1], [values[2], values[3]])
}

#[derive(Clone, Debug)]
struct BaseTilt {
    tilt: Tilt<f64>,
}

impl Effect for BaseTilt {
    /// What gravity does beyond what it does to a level base.
    fn add_torque(&self, state: &JointState, plant: &Plant, torque_nm: &mut [f64]) {
        plant.body.add_tilt(state.q_rad, &self.tilt, torque_nm);
    }
}
