//! A first-order lag from command to torque.

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "actuator_lag",
    words: "the current follows the command as a first-order lag",
    equation: "T du'/dt + u' = u",
    whole_robot: false,
    parameters: &[Parameter::new("time_constant_s", Kind::TimeConstant, 1e-5, 0.1)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|_| vec![vec![5e-4], vec![2e-3], vec![6e-3], vec![0.02]]),
    size: Size::grows(|_| 0.02),
    draw: |_, random| vec![random.log_uniform(1e-3, 1e-2)],
    confused_with: &[Confusion::effect(
        "delay",
        "below 1/(10 T) both turn the phase alike; they differ in the second order",
        "noise up to 200 Hz in the command (`rrr run driven-noise`)",
    )
    .compared()
    .never_paired()],
    compensation: Compensation::None("undoing a lag would amplify the noise of the command"),
    experiment: "noise up to 200 Hz in the command (`rrr run driven-noise`)",
    build: |joint, values| {
        Box::new(ActuatorLag {
            joint: usize::from(joint) - 1,
            time_constant_s: values[0],
            share: 0.0,
            mean: 0.0,
            current_v: 0.0,
        })
    },
};

#[derive(Clone, Debug)]
struct ActuatorLag {
    joint: usize,
    time_constant_s: f64,
    /// How much of the way to the command the current goes in a step.
    share: f64,
    /// How much of that way it has gone on average over the step.
    mean: f64,
    current_v: f64,
}

impl Effect for ActuatorLag {
    fn set_step(&mut self, step_s: f64) {
        let steps = step_s / self.time_constant_s;
        self.share = -(-steps).exp_m1();
        self.mean = 1.0 - self.share / steps;
    }

    /// The exact solution for a command that is constant over the step, averaged.
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        let way_v = command_v[self.joint] - self.current_v;
        command_v[self.joint] = self.current_v + self.mean * way_v;
        self.current_v += self.share * way_v;
    }
}
