//! A constant force on the tip.

use firmware::compensation::limits;
use model::vector::Vector3;

use crate::effects::{
    ArmLoad, Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search,
    Size, Touches,
};
use crate::plant::Plant;

const COMPONENT: Parameter = Parameter::of_board("force_N", Kind::Force, limits::TIP_FORCE_N);

pub(super) const DEFINITION: Definition = Definition {
    name: "tip_force",
    words: "the surroundings push the tip with a constant force",
    equation: "torque + J^T F, F in the base frame",
    whole_robot: true,
    parameters: &[COMPONENT, COMPONENT, COMPONENT],
    couples_joints: true,
    touches: Touches::DRIVE,
    search: Search::From(|_| {
        // One direction alone promises nothing of forces across it.
        [[1.0, 1.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|force_n| force_n.to_vec())
            .to_vec()
    }),
    size: Size::grows(|_| 50.0),
    draw: |_, random| {
        // In any direction.
        let (size_n, up) = (random.log_uniform(1.0, 8.0), random.uniform(-1.0, 1.0));
        let (sine, cosine) = random.phase_rad().sin_cos();
        let level = (1.0 - up * up).sqrt();
        vec![size_n * level * cosine, size_n * level * sine, size_n * up]
    },
    confused_with: &[Confusion::effect(
        "base_tilt",
        "a horizontal force and a lean both turn joint 1 by a sine of its angle",
        "motion of joint 1 over a whole turn, the arm stretched and folded",
    )],
    compensation: Compensation::Model(add_force),
    experiment: "motion of all joints (`rrr run excitation`)",
    build: |_, values| Box::new(TipForce { force_n: [values[0], values[1], values[2]] }),
};

/// Forces add up, as long as the board takes their sum.
fn add_force(load: &mut ArmLoad, values: &[f64]) -> Result<(), &'static str> {
    let sum = [0, 1, 2].map(|axis| load.tip_force_n[axis] + values[axis]);
    let taken = COMPONENT.lowest..=COMPONENT.highest;
    if !sum.iter().all(|force_n| taken.contains(force_n)) {
        return Err("the forces on the tip add up to more than the board takes");
    }
    load.tip_force_n = sum;
    Ok(())
}

#[derive(Clone, Debug)]
struct TipForce {
    force_n: Vector3<f64>,
}

impl Effect for TipForce {
    fn add_torque(&self, state: &JointState, plant: &Plant, torque_nm: &mut [f64]) {
        plant.body.add_tip_force(state.q_rad, &self.force_n, torque_nm);
    }
}
