//! Joints and links from a URDF, read by the crate `urdf-rs`.

use std::path::Path;

use model::chain::{Body, Joint, Transform};
use model::mechanism::JointKind;

use super::joint::{ArmJoint, LinkTable};
use super::urdf_tree::Tree;
use crate::bytes;
use crate::error::{FileError, Problem};

/// The joints of a URDF in the order of the names, base to tip; without names all that move.
///
/// A link with the links fixed to it is one body; so is a branch whose joints are not named, as it
/// stands at zero. A body without mass is unknown.
pub(super) fn joints(path: &Path, names: &[Option<String>]) -> Result<Vec<ArmJoint>, FileError> {
    let text = bytes::text(path, bytes::read(path)?)?;
    of_text(&text, names).map_err(|what| Problem::Urdf(what).in_file(path))
}

fn of_text(text: &str, names: &[Option<String>]) -> Result<Vec<ArmJoint>, String> {
    let robot = urdf_rs::read_from_string(text).map_err(|error| one_line(&error.to_string()))?;
    let tree = Tree::of(&robot)?;
    let chain = if names.is_empty() { tree.moving()? } else { tree.named(names)? };
    (0..chain.len()).map(|place| joint(&tree, &chain, place)).collect()
}

fn one_line(words: &str) -> String {
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn joint(tree: &Tree, chain: &[usize], place: usize) -> Result<ArmJoint, String> {
    let given = &tree.joints()[chain[place]];
    let before = place.checked_sub(1).map(|before| chain[before]);
    let (origin, is_direct) = tree.origin(chain[place], before)?;
    let kind = match given.joint_type {
        urdf_rs::JointType::Prismatic => JointKind::Prismatic,
        _ => JointKind::Revolute,
    };
    let limit = &given.limit;
    let has_limits =
        given.joint_type != urdf_rs::JointType::Continuous && limit.lower < limit.upper;
    let joint = ArmJoint {
        name: Some(given.name.clone()),
        kind,
        origin_xyz_m: origin.position,
        origin_rpy_rad: if is_direct { given.origin.rpy.0 } else { rpy_of(&origin) },
        axis: given.axis.xyz.0,
        link: link_of(&tree.body(chain[place], chain)?),
        limits: has_limits.then_some([limit.lower, limit.upper]),
        ..ArmJoint::default()
    };
    finite(&joint).then_some(joint).ok_or_else(|| {
        format!("joint \"{}\" or its link has a value that is no finite number", given.name)
    })
}

fn finite(joint: &ArmJoint) -> bool {
    let Joint { origin, axis, body, .. } = joint.of_chain();
    let places = origin.position.into_iter().chain(origin.rotation.into_iter().flatten());
    let limits = joint.limits.unwrap_or_default();
    places.chain(axis).chain(body.to_array()).chain(limits).all(f64::is_finite)
}

/// A body's mass, centre and central inertia; unknown without mass.
fn link_of(body: &Body<f64>) -> LinkTable {
    if body.mass_kg <= 0.0 {
        return LinkTable::default();
    }
    let com = body.moment_kg_m.map(|moment| moment / body.mass_kg);
    let steiner = Body::point(body.mass_kg, com).inertia_kg_m2;
    let inertia = std::array::from_fn(|k| body.inertia_kg_m2[k] - steiner[k]);
    LinkTable { mass_kg: Some(body.mass_kg), com_m: Some(com), inertia_kg_m2: Some(inertia) }
}

/// Roll, pitch and yaw of a rotation; roll is 0 where pitch is a quarter turn.
fn rpy_of(frame: &Transform<f64>) -> [f64; 3] {
    let r = &frame.rotation;
    let level = r[0][0].hypot(r[1][0]);
    let pitch = (-r[2][0]).atan2(level);
    if level < 1e-12 {
        return [0.0, pitch, (-r[0][1]).atan2(r[1][1])];
    }
    [r[2][1].atan2(r[2][2]), pitch, r[1][0].atan2(r[0][0])]
}
