//! A pure delay from command to torque.

use std::collections::VecDeque;

use crate::effects::{
    Compensation, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "delay",
    words: "the command acts later than it is given",
    equation: "u(t - d)",
    whole_robot: false,
    parameters: &[Parameter::new("delay_s", Kind::Delay, 0.0, 0.1)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|_| vec![vec![8e-4], vec![2.5e-3], vec![6e-3], vec![0.02]]),
    size: Size::grows(|_| 0.02),
    draw: |_, random| vec![random.log_uniform(1e-3, 6e-3)],
    confused_with: &[],
    compensation: Compensation::None("no command can act before it is given"),
    experiment: "noise up to 200 Hz in the command (`rrr run driven-noise`)",
    build: |joint, values| {
        Box::new(Delay {
            joint: usize::from(joint) - 1,
            delay_s: values[0],
            fraction: 0.0,
            waiting_v: VecDeque::new(),
        })
    },
};

#[derive(Clone, Debug)]
struct Delay {
    joint: usize,
    delay_s: f64,
    /// The part of a step that the delay has beyond whole ones.
    fraction: f64,
    /// Commands on their way, the oldest first.
    waiting_v: VecDeque<f64>,
}

impl Effect for Delay {
    fn set_step(&mut self, step_s: f64) {
        let steps = self.delay_s / step_s;
        self.fraction = steps.fract();
        self.waiting_v = VecDeque::from(vec![0.0; steps as usize + 1]);
    }

    /// The mean over the step of the delayed command, which changes once within it.
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        self.waiting_v.push_back(command_v[self.joint]);
        let older_v = self.waiting_v.pop_front().unwrap_or_default();
        let newer_v = self.waiting_v.front().copied().unwrap_or_default();
        command_v[self.joint] = self.fraction * older_v + (1.0 - self.fraction) * newer_v;
    }
}
