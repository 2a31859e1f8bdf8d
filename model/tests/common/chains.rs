//! Random chains, and the three-joint robot as a chain.

use model::chain::{Body, Joint, MAX_JOINTS, SerialChain, Transform, rotation_of_rpy};
use model::links::Link;
use model::mechanism::JointKind;
use proptest::array::uniform3;
use proptest::collection::vec;
use proptest::prelude::*;

use super::rigid_robot::{RigidRobot, link};

/// A chain with a state; all vectors have one entry per joint.
#[derive(Clone, Debug)]
pub struct Moving {
    pub chain: SerialChain<f64>,
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
}

/// A chain of 1 to 10 joints, one in three prismatic, in a random state.
pub fn moving_chain() -> impl Strategy<Value = Moving> {
    let gravity = uniform3(-10.0..10.0);
    let tip = uniform3(-0.3..0.3);
    (vec(joint(), 1..=MAX_JOINTS), gravity, tip).prop_flat_map(|(joints, gravity, tip)| {
        let (n, chain) = (joints.len(), SerialChain::new(gravity, &joints).unwrap().with_tip(tip));
        let state = [vec(-3.0..3.0, n), vec(-4.0..4.0, n), vec(-20.0..20.0, n)];
        state.prop_map(move |[q, qd, qdd]| Moving { chain, q, qd, qdd })
    })
}

fn joint() -> impl Strategy<Value = Joint<f64>> {
    let place = (uniform3(-0.5..0.5), uniform3(-3.0..3.0));
    let axis =
        uniform3(-1.0..1.0).prop_filter("an axis", |a| a.iter().any(|x: &f64| x.abs() > 0.1));
    (0..3, place, axis, link(), 0.0..0.2).prop_map(|(kind, (xyz, rpy), axis, link, armature)| {
        Joint {
            kind: if kind == 0 { JointKind::Prismatic } else { JointKind::Revolute },
            origin: Transform { rotation: rotation_of_rpy(rpy), position: xyz },
            axis,
            body: body_of(&link),
            armature,
        }
    })
}

/// A link in its own frame.
pub fn body_of(link: &Link<f64>) -> Body<f64> {
    let ([xx, yy, zz], [xy, xz, yz]) = (link.inertia_diagonal_kg_m2, link.inertia_products_kg_m2);
    Body::about_centre(link.mass_kg, link.centre_m, [xx, xy, xz, yy, yz, zz])
}

/// The robot of MODEL.md as a chain: joint i + 1 stands in link i where the distal
/// Denavit-Hartenberg frame i of Table 1 does, and so does the link.
pub fn chain_of(robot: &RigidRobot) -> SerialChain<f64> {
    let g = &robot.geometry;
    let frame =
        |position, twist| Transform { rotation: rotation_of_rpy([twist, 0.0, 0.0]), position };
    let distal = [
        frame([0.0, 0.0, g.d1_m], std::f64::consts::FRAC_PI_2),
        frame([g.a2_m, 0.0, g.d2_m], 0.0),
        frame([g.a3_m, 0.0, g.d3_m], 0.0),
    ];
    let joints = [0, 1, 2].map(|index| Joint {
        kind: JointKind::Revolute,
        origin: if index == 0 { Transform::identity() } else { distal[index - 1] },
        axis: [0.0, 0.0, 1.0],
        body: body_of(&robot.links[index]).out_of(&distal[index]),
        armature: robot.rotor_inertia_kg_m2[index],
    });
    let chain = SerialChain::new([0.0, 0.0, -g.gravity_m_s2], &joints).unwrap();
    chain.with_tip(distal[2].position)
}
