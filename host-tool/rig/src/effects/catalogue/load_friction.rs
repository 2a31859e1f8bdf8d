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
    experiment: "slow motion in other postures, or with a load at the tip",
    build: |joint, values| {
        Box::new(LoadFriction {
            joint: usize::from(joint) - 1,
            coefficient_v_per_nm: values[0],
            by_motor_torque: false,
        })
    },
};

/// On an arm of any kind, whose commands may be newtons or amperes: by the load on the joint, as a bearing's, or by all
/// that the motor gives, as a gear's, whose teeth also carry what accelerates and what friction takes.
pub(super) const OF_ARM: Definition = Definition {
    equation: "gamma + b |c + h|, or gamma + b |k_t u|",
    parameters: &[
        Parameter::new("coefficient_V_per_Nm", Kind::Coefficient, 0.0, 1000.0),
        Parameter::new("by_motor_torque", Kind::Choice, 0.0, 1.0).optional(),
    ],
    search: Search::From(|typical| {
        let by = |load_nm: f64| 0.1 * typical.friction_v / load_nm;
        vec![vec![by(typical.load_nm), 0.0], vec![by(typical.motor_nm), 1.0]]
    }),
    build: |joint, values| {
        Box::new(LoadFriction {
            joint: usize::from(joint) - 1,
            coefficient_v_per_nm: values[0],
            by_motor_torque: values[1] >= 0.5,
        })
    },
    ..DEFINITION
};

#[derive(Clone, Debug)]
struct LoadFriction {
    joint: usize,
    coefficient_v_per_nm: f64,
    /// Whether it is the motor's torque that loads, and not gravity and Coriolis torques alone.
    by_motor_torque: bool,
}

impl Effect for LoadFriction {
    fn feels_load(&self) -> bool {
        !self.by_motor_torque
    }

    fn feels_motor_torque(&self) -> bool {
        self.by_motor_torque
    }

    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        let loads_nm = if self.by_motor_torque { state.motor_nm } else { state.load_nm };
        scale[self.joint].added_v += self.coefficient_v_per_nm * loads_nm[self.joint].abs();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_grows_by_the_joints_load_or_by_the_motors_torque_and_by_nothing_between() {
        let built = |by_motor_torque: f64| OF_ARM.on_one_of(1, 1, &[0.1, by_motor_torque]);
        let state = JointState {
            time_s: 0.0,
            q_rad: &[0.0],
            qd_rad_per_s: &[1.0],
            load_nm: &[-2.0],
            motor_nm: &[5.0],
        };
        let added_v = |by_motor_torque: f64| {
            let mut scale = [FrictionScale::unchanged()];
            built(by_motor_torque).unwrap().change_friction(&state, &mut scale);
            scale[0].added_v
        };
        assert_eq!([added_v(0.0), added_v(1.0)], [0.1 * 2.0, 0.1 * 5.0]);
        let refused = built(0.3).unwrap_err().to_string();
        assert!(refused.contains("is 0.3, but must be 0 or 1"), "{refused}");
    }
}
