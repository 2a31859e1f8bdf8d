//! A rig's joints with their drives and friction, and the rigid body that they move.

use model::{Friction, Robot};

use super::body::Body;
use super::gear::Gear;
use super::linked::LinkedBody;

/// What stands behind the commands. Names tell the units of joints that turn and take volts; a joint
/// that slides has m, N and kg in place of rad, Nm and kg m^2, another drive A, Nm or N in place
/// of V.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// The rigid body.
    pub body: Body,
    /// Torque by command of every joint [Nm/V].
    pub torque_constant_nm_per_v: Vec<f64>,
    /// Friction of every joint.
    pub friction: Vec<Friction<f64>>,
    /// Turns of every joint's shafts.
    pub gears: Vec<Gear>,
}

impl Plant {
    /// The three-joint robot.
    pub fn of_robot(robot: &Robot<f64>) -> Self {
        Self {
            body: Body::of_robot(robot),
            torque_constant_nm_per_v: robot.torque_constant_nm_per_v.to_vec(),
            friction: robot.friction.to_vec(),
            gears: vec![Gear::DIRECT; 3],
        }
    }

    /// The three-joint robot again, where this is one.
    pub fn as_robot(&self) -> Option<Robot<f64>> {
        let rrr = self.body.as_rrr()?;
        let (k_t, friction) = (&self.torque_constant_nm_per_v, &self.friction);
        Some(Robot {
            geometry: rrr.geometry,
            base: rrr.base,
            torque_constant_nm_per_v: [k_t[0], k_t[1], k_t[2]],
            friction: [friction[0], friction[1], friction[2]],
        })
    }

    /// The chain with its coordinates, where this is one.
    pub fn as_chain(&self) -> Option<&LinkedBody> {
        match &self.body {
            Body::Chain(linked) => Some(linked),
            Body::Rrr(_) => None,
        }
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        self.friction.len()
    }

    /// A base parameter or coordinate of the rigid body.
    pub fn base(&self, index: usize) -> f64 {
        match &self.body {
            Body::Rrr(rrr) => rrr.base.to_array()[index],
            Body::Chain(linked) => linked.coordinates()[index],
        }
    }

    /// Sets it.
    pub fn set_base(&mut self, index: usize, to: f64) {
        match &mut self.body {
            Body::Rrr(rrr) => {
                let mut base = rrr.base.to_array();
                base[index] = to;
                rrr.base = model::BaseParameters::from_array(base);
            }
            Body::Chain(linked) => linked.set(index, to),
        }
    }

    /// How many base parameters or coordinates there are.
    pub fn base_count(&self) -> usize {
        match &self.body {
            Body::Rrr(_) => model::base::COUNT,
            Body::Chain(linked) => linked.coordinates().len(),
        }
    }
}
