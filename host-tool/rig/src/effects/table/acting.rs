//! What a table does to the simulated robot.

use super::axis::TableAxis;
use super::curve::Table;
use crate::effects::effect::{Effect, JointState};

impl Table {
    fn add_to(&self, state: &JointState, voltage_v: &mut [f64]) {
        let voltage_v = &mut voltage_v[self.index()];
        *voltage_v += self.value_v(self.abscissa(state, *voltage_v));
    }
}

impl Effect for Table {
    /// A curve over the command acts here, before any voltage is added: what it lies over is the
    /// command as the effects before it leave it.
    fn change_command(&mut self, state: &JointState, command_v: &mut [f64]) {
        if self.axis == TableAxis::Command {
            self.add_to(state, command_v);
        }
    }

    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        if self.axis != TableAxis::Command {
            self.add_to(state, voltage_v);
        }
    }

    fn feels_load(&self) -> bool {
        self.axis == TableAxis::Load
    }
}
