//! Mass matrix: the composite rigid body algorithm, RBDA Table 6.2.

use super::body::Body;
use super::serial_chain::SerialChain;
use crate::Real;

impl<T: Real> SerialChain<T> {
    /// D_ij = S_j . F_i with F_i = I^c_i S_i carried down to joint j, I^c_i the body of all links
    /// from i on; n x n row by row, rotors on the diagonal.
    #[inline]
    pub(super) fn composite_bodies(&self, q: &[T], mass: &mut [T]) {
        let (joints, places) = (self.placed(), self.places(q));
        let n = joints.len();
        let mut composite = Body::zero();
        for index in (0..n).rev() {
            composite = composite.plus(&joints[index].joint.body);
            let mut force = composite.times(&joints[index].subspace);
            mass[index * n + index] = joints[index].along(&force) + joints[index].joint.armature;
            for before in (0..index).rev() {
                force = places[before + 1].force_out_of(&force);
                let entry = joints[before].along(&force);
                mass[index * n + before] = entry;
                mass[before * n + index] = entry;
            }
            composite = composite.out_of(&places[index]);
        }
    }
}
