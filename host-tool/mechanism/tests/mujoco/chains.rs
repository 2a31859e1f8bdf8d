//! Random chains as numbers, with what the project answers in random states.

use model::chain::{Body, Joint, SerialChain, Transform, rotation_of_rpy};
use model::mechanism::{JointKind, Mechanism};
use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;
use serde_json::{Value, json};

const STATES: usize = 10;

/// Chains of 1 to 7 joints in turn, every fourth joint or so prismatic.
pub fn with_answers(count: usize) -> Value {
    let mut random = Pcg64Mcg::new(7);
    (0..count).map(|number| chain(&mut random, 1 + number % 7)).collect()
}

fn within(random: &mut Pcg64Mcg, most: f64) -> f64 {
    Uniform::new_inclusive(-most, most).unwrap().sample(random)
}

fn vector(random: &mut Pcg64Mcg, most: f64) -> [f64; 3] {
    [0, 1, 2].map(|_| within(random, most))
}

/// One joint's numbers, with no use of the project's own conversions.
struct Numbers {
    is_prismatic: bool,
    xyz: [f64; 3],
    rpy: [f64; 3],
    axis: [f64; 3],
    mass: f64,
    centre: [f64; 3],
    /// About the centre: xx xy xz yy yz zz.
    inertia: [f64; 6],
    armature: f64,
}

impl Numbers {
    fn draw(random: &mut Pcg64Mcg) -> Self {
        let mass = 1.1 + within(random, 1.0);
        Self {
            is_prismatic: within(random, 1.0) > 0.5,
            xyz: vector(random, 0.5),
            rpy: vector(random, 3.0),
            axis: vector(random, 1.0),
            mass,
            centre: vector(random, 0.2),
            inertia: inertia(random, mass),
            armature: 0.1 + within(random, 0.1),
        }
    }

    fn joint(&self) -> Joint<f64> {
        Joint {
            kind: if self.is_prismatic { JointKind::Prismatic } else { JointKind::Revolute },
            origin: Transform { rotation: rotation_of_rpy(self.rpy), position: self.xyz },
            axis: self.axis,
            body: Body::about_centre(self.mass, self.centre, self.inertia),
            armature: self.armature,
        }
    }

    fn json(&self) -> Value {
        json!({
            "type": if self.is_prismatic { "slide" } else { "hinge" },
            "xyz": self.xyz, "rpy": self.rpy, "axis": self.axis, "mass": self.mass,
            "centre": self.centre, "inertia": self.inertia, "armature": self.armature,
        })
    }
}

/// The inertia of eight equal points, each at the centre's other side as well.
fn inertia(random: &mut Pcg64Mcg, mass: f64) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for _ in 0..4 {
        let [x, y, z] = vector(random, 0.2);
        let one = [y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z, x * x + y * y];
        sum.iter_mut().zip(one).for_each(|(sum, entry)| *sum += mass / 4.0 * entry);
    }
    sum
}

fn chain(random: &mut Pcg64Mcg, joints: usize) -> Value {
    let numbers: Vec<Numbers> = (0..joints).map(|_| Numbers::draw(random)).collect();
    let gravity = vector(random, 10.0);
    let all: Vec<_> = numbers.iter().map(Numbers::joint).collect();
    let chain = SerialChain::new(gravity, &all).unwrap();
    let states: Value = (0..STATES).map(|_| answers(random, &chain)).collect();
    let joints: Value = numbers.iter().map(Numbers::json).collect();
    json!({ "gravity": gravity, "joints": joints, "states": states })
}

/// A state, its torques, its mass matrix, and the fall under other torques.
fn answers(random: &mut Pcg64Mcg, chain: &SerialChain<f64>) -> Value {
    let n = chain.joints().count();
    let mut draw = |most: f64| -> Vec<f64> { (0..n).map(|_| within(random, most)).collect() };
    let [q, qd, qdd, push] = [3.0, 3.0, 10.0, 20.0].map(&mut draw);
    let (mut torque, mut fall, mut mass) = (vec![0.0; n], vec![0.0; n], vec![0.0; n * n]);
    chain.inverse_dynamics(&q, &qd, &qdd, &mut torque);
    chain.forward_dynamics(&q, &qd, &push, &mut fall);
    chain.mass_matrix(&q, &mut mass);
    json!({
        "q": q, "qd": qd, "qdd": qdd, "torque": torque, "push": push, "fall": fall, "mass": mass,
    })
}
