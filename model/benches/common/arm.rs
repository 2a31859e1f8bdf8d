//! An arm to measure costs on.

use model::chain::{Body, Joint, SerialChain, Transform, rotation_of_rpy};
use model::mechanism::JointKind;

/// An arm of revolute joints with axes and links in general position.
pub fn arm(joints: usize) -> SerialChain<f64> {
    let joint = |k: usize| {
        let k = k as f64;
        Joint {
            kind: JointKind::Revolute,
            origin: Transform {
                rotation: rotation_of_rpy([1.5 - 0.3 * k, 0.2 * k, -1.0 + 0.4 * k]),
                position: [0.1, -0.05 * k, 0.3],
            },
            axis: [0.0, 0.0, 1.0],
            body: Body::about_centre(
                8.0 - k,
                [0.02, 0.1, -0.05],
                [0.05, 0.001, 0.002, 0.04, -0.003, 0.03],
            ),
            armature: 0.1,
        }
    };
    let joints: Vec<_> = (0..joints).map(joint).collect();
    SerialChain::new([0.0, 0.0, -9.81], &joints).expect("a chain")
}
