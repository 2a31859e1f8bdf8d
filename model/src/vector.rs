//! Vectors and matrices of the three joints, as plain arrays.

use crate::Real;

/// A quantity per joint.
pub type Vector3<T> = [T; 3];
/// A quantity per pair of joints, row by row.
pub type Matrix3<T> = [[T; 3]; 3];

/// Scalar product.
#[inline]
pub fn dot<T: Real>(a: &Vector3<T>, b: &Vector3<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Matrix times vector.
#[inline]
pub fn multiply<T: Real>(m: &Matrix3<T>, v: &Vector3<T>) -> Vector3<T> {
    [dot(&m[0], v), dot(&m[1], v), dot(&m[2], v)]
}

/// The leading principal minors, all positive exactly when a symmetric `m` is positive definite.
#[inline]
pub fn leading_minors<T: Real>(m: &Matrix3<T>) -> [T; 3] {
    let two = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    let row = cross(&m[1], &m[2]);
    [m[0][0], two, dot(&m[0], &row)]
}

/// Vector product.
#[inline]
pub fn cross<T: Real>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Solves `m x = v` for a symmetric positive definite `m` by its adjugate.
///
/// `m` must not be singular: the checked construction of [`crate::Robot`] assures it
/// for mass matrices.
#[inline]
pub fn solve_symmetric<T: Real>(m: &Matrix3<T>, v: &Vector3<T>) -> Vector3<T> {
    let columns = [cross(&m[1], &m[2]), cross(&m[2], &m[0]), cross(&m[0], &m[1])];
    let scale = T::one() / dot(&m[0], &columns[0]);
    multiply(&columns, v).map(|x| x * scale)
}
