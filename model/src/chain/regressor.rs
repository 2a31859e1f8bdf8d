//! The regressor of all links in one pass (Atkeson, An and Hollerbach 1986).

use super::body::BODY_PARAMETERS;
use super::motion::LinkMotion;
use super::serial_chain::{MAX_JOINTS, SerialChain};
use super::spatial::Motion;
use crate::Real;
use crate::mechanism::JointKind;
use crate::vector::{Matrix3, Vector3, add, cross, dot, multiply_transposed, product, skew};

/// Parameters of a link: the ten of its body, and the rotor.
pub const LINK_PARAMETERS: usize = BODY_PARAMETERS + 1;

/// The name of a link's parameter, 0 to [`LINK_PARAMETERS`] - 1.
#[inline]
pub fn link_parameter_name(kind: JointKind, index: usize) -> &'static str {
    const NAMES: [&str; BODY_PARAMETERS] = [
        "mass_kg",
        "mx_kg_m",
        "my_kg_m",
        "mz_kg_m",
        "ixx_kg_m2",
        "ixy_kg_m2",
        "ixz_kg_m2",
        "iyy_kg_m2",
        "iyz_kg_m2",
        "izz_kg_m2",
    ];
    match (NAMES.get(index), kind) {
        (Some(name), _) => name,
        (None, JointKind::Revolute) => "armature_kg_m2",
        (None, JointKind::Prismatic) => "armature_kg",
    }
}

/// The force on a body as a linear function of its ten parameters, less the blocks that are zero.
struct BodyRegressor<T> {
    /// By the mass: the acceleration of the origin [m/s^2].
    mass: Vector3<T>,
    /// Force by the first moment: skew(wd) + skew(w)^2; its moment is -skew(mass).
    moment: Matrix3<T>,
    /// Moment by the inertia xx xy xz yy yz zz, one column each.
    inertia: [Vector3<T>; 6],
}

impl<T: Real> BodyRegressor<T> {
    #[inline]
    fn of(link: &LinkMotion<T>) -> Self {
        let (w, wd) = (&link.velocity.angular, &link.acceleration.angular);
        let turn = skew(w);
        let mass = add(&link.acceleration.linear, &cross(w, &link.velocity.linear));
        let square = product(&turn, &turn);
        let slope = skew(wd);
        let moment = [0, 1, 2].map(|i| add(&slope[i], &square[i]));
        Self { mass, moment, inertia: inertia_columns(w, wd) }
    }

    /// Power at a motion of the body by each parameter: a row of the regressor.
    #[inline]
    fn along(&self, motion: &Motion<T>) -> [T; BODY_PARAMETERS] {
        let (w, v) = (&motion.angular, &motion.linear);
        let pushed = multiply_transposed(&self.moment, v);
        let [x, y, z] = add(&pushed, &cross(&self.mass, w));
        let [xx, xy, xz, yy, yz, zz] = [0, 1, 2, 3, 4, 5].map(|k| dot(w, &self.inertia[k]));
        [dot(v, &self.mass), x, y, z, xx, xy, xz, yy, yz, zz]
    }
}

/// I wd + w x I w by the entries of I.
#[inline]
fn inertia_columns<T: Real>(w: &Vector3<T>, wd: &Vector3<T>) -> [Vector3<T>; 6] {
    let [x, y, z] = *w;
    let [dx, dy, dz] = *wd;
    [
        [dx, x * z, -x * y],
        [dy - x * z, dx + y * z, x * x - y * y],
        [dz + x * y, z * z - x * x, dx - y * z],
        [-y * z, dy, x * y],
        [y * y - z * z, dz - x * y, dy + x * z],
        [y * z, -x * z, dz],
    ]
}

impl<T: Real> SerialChain<T> {
    /// Link i moves under joint j <= i by S_j, carried into the frame of link i: row j holds its
    /// scalar product with the force on body i. n x 11 n, row by row.
    #[inline]
    pub(super) fn rows(&self, q: &[T], qd: &[T], qdd: &[T], rows: &mut [T]) {
        let links = self.link_motions(q, qd, qdd);
        let width = LINK_PARAMETERS * self.placed().len();
        rows[..width * self.placed().len()].fill(T::zero());
        let mut axes = [Motion::zero(); MAX_JOINTS];
        for (index, placed) in self.placed().iter().enumerate() {
            let (link, first) = (&links[index], LINK_PARAMETERS * index);
            let body = BodyRegressor::of(link);
            axes[index] = placed.subspace;
            for (joint, axis) in axes[..=index].iter_mut().enumerate() {
                if joint < index {
                    *axis = link.place.motion_into(axis);
                }
                let at = joint * width + first;
                rows[at..at + BODY_PARAMETERS].copy_from_slice(&body.along(axis));
            }
            rows[index * width + first + BODY_PARAMETERS] = qdd[index];
        }
    }
}
