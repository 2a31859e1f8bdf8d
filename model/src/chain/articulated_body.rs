//! Inertia of an articulated body (RBDA 7.1): a symmetric 6 x 6 matrix in blocks of 3 x 3.

use super::body::Body;
use super::spatial::{Force, Motion, Transform};
use crate::Real;
use crate::vector::{
    Matrix3, Vector3, add, add_scaled, cross, multiply, multiply_transposed, product, scale, skew,
    transposed,
};

/// [[inertia, coupling], [coupling^T, mass]]: force = this times acceleration, plus a bias.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArticulatedBody<T> {
    inertia: Matrix3<T>,
    coupling: Matrix3<T>,
    mass: Matrix3<T>,
}

impl<T: Real> ArticulatedBody<T> {
    /// A rigid body's, eq. (2.63).
    #[inline]
    pub(super) fn of(body: &Body<T>) -> Self {
        let (zero, m) = (T::zero(), body.mass_kg);
        Self {
            inertia: body.inertia_matrix(),
            coupling: skew(&body.moment_kg_m),
            mass: [[m, zero, zero], [zero, m, zero], [zero, zero, m]],
        }
    }

    /// Sum.
    #[inline]
    pub(super) fn plus(&self, other: &Self) -> Self {
        let sum = |a, b| add_scaled(a, b, T::one());
        Self {
            inertia: sum(&self.inertia, &other.inertia),
            coupling: sum(&self.coupling, &other.coupling),
            mass: sum(&self.mass, &other.mass),
        }
    }

    /// The force of an acceleration.
    #[inline]
    pub(super) fn times(&self, motion: &Motion<T>) -> Force<T> {
        let (w, v) = (&motion.angular, &motion.linear);
        Force {
            moment: add(&multiply(&self.inertia, w), &multiply(&self.coupling, v)),
            force: add(&multiply_transposed(&self.coupling, w), &multiply(&self.mass, v)),
        }
    }

    /// What is left when a joint gives way: this - f f^T / d, eq. (7.23).
    #[inline]
    pub(super) fn released(&self, force: &Force<T>, d: T) -> Self {
        let factor = -T::one() / d;
        let less = |block: &Matrix3<T>, a: &Vector3<T>, b: &Vector3<T>| {
            let row = |i: usize| add(&block[i], &scale(b, a[i] * factor));
            [row(0), row(1), row(2)]
        };
        Self {
            inertia: less(&self.inertia, &force.moment, &force.moment),
            coupling: less(&self.coupling, &force.moment, &force.force),
            mass: less(&self.mass, &force.force, &force.force),
        }
    }

    /// From a frame's coordinates into its parent's: X^T I X, with M' = R M R^T,
    /// H' = R H R^T + skew(r) M', I' = R I R^T - R H R^T skew(r) + skew(r) H'^T.
    #[inline]
    pub(super) fn out_of(&self, frame: &Transform<T>) -> Self {
        let (turn, r) = (&frame.rotation, &frame.position);
        let (mass, near) = (turned(turn, &self.mass), turned(turn, &self.coupling));
        // M' is symmetric: its rows are its columns.
        let lever = transposed(&across(r, &mass));
        let coupling = add_scaled(&near, &lever, T::one());
        // Row by row, a skew(r) is a x r, which is -r x a.
        let own = turned(turn, &self.inertia);
        let moved = add_scaled(&own, &across(r, &near), T::one());
        let far = transposed(&across(r, &coupling));
        Self { inertia: add_scaled(&moved, &far, T::one()), coupling, mass }
    }
}

/// R block R^T.
#[inline]
fn turned<T: Real>(turn: &Matrix3<T>, block: &Matrix3<T>) -> Matrix3<T> {
    let half = product(turn, block);
    [multiply(turn, &half[0]), multiply(turn, &half[1]), multiply(turn, &half[2])]
}

/// r x each row.
#[inline]
fn across<T: Real>(r: &Vector3<T>, rows: &Matrix3<T>) -> Matrix3<T> {
    [cross(r, &rows[0]), cross(r, &rows[1]), cross(r, &rows[2])]
}
