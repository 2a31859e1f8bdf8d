//! Friction that grows with the load on the bearing.

use model::friction::FrictionScale;

use crate::effects::{
    Compensation, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "load_friction",
    words: "friction grows with the load on the joint",
    equation: "gamma + b |c + h|",
    whole_robot: false,
    parameters: &[Parameter::new("coefficient_V_per_Nm", Kind::Coefficient, 0.0, 1.0)],
    couples_joints: false,
    touches: Touches::FRICTION,
    search: Search::From(|typical| vec![vec![0.1 * typical.friction_v / typical.load_nm]]),
    size: Size::grows(|typical| typical.friction_v / typical.load_nm),
    draw: |context, random| {
        // In parts of the load in volts, so that joints are alike.
        let k_t = context.robot.torque_constant_nm_per_v[context.joint];
        vec![random.log_uniform(0.03, 0.3) / k_t]
    },
    confused_with: &[],
    compensation: Compensation::None("the board does not compute the load's part of friction"),
    experiment: "`rrr run slow` in other postures or with a payload",
    build: |joint, values| {
        Box::new(LoadFriction { joint: usize::from(joint) - 1, coefficient_v_per_nm: values[0] })
    },
};

/// On an arm of any kind, whose commands may be newtons or amperes.
pub(super) const OF_ARM: Definition = Definition {
    parameters: &[Parameter::new("coefficient_V_per_Nm", Kind::Coefficient, 0.0, 1000.0)],
    ..DEFINITION
};

#[derive(Clone, Debug)]
struct LoadFriction {
    joint: usize,
    coefficient_v_per_nm: f64,
}

impl Effect for LoadFriction {
    fn feels_load(&self) -> bool {
        true
    }

    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        scale[self.joint].added_v += self.coefficient_v_per_nm * state.load_nm[self.joint].abs();
    }
}
