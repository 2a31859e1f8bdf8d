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

/// Sum.
#[inline]
pub fn add<T: Real>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Difference, a - b.
#[inline]
pub fn subtract<T: Real>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// A vector times a number.
#[inline]
pub fn scale<T: Real>(v: &Vector3<T>, factor: T) -> Vector3<T> {
    [v[0] * factor, v[1] * factor, v[2] * factor]
}

/// The transposed matrix times a vector.
#[inline]
pub fn multiply_transposed<T: Real>(m: &Matrix3<T>, v: &Vector3<T>) -> Vector3<T> {
    let along = |k: usize| m[0][k] * v[0] + m[1][k] * v[1] + m[2][k] * v[2];
    [along(0), along(1), along(2)]
}

/// Product of two matrices.
#[inline]
pub fn product<T: Real>(a: &Matrix3<T>, b: &Matrix3<T>) -> Matrix3<T> {
    [multiply_transposed(b, &a[0]), multiply_transposed(b, &a[1]), multiply_transposed(b, &a[2])]
}

/// The transposed matrix.
#[inline]
pub fn transposed<T: Real>(m: &Matrix3<T>) -> Matrix3<T> {
    let column = |k: usize| [m[0][k], m[1][k], m[2][k]];
    [column(0), column(1), column(2)]
}

/// Entry-wise a + factor b.
#[inline]
pub fn add_scaled<T: Real>(a: &Matrix3<T>, b: &Matrix3<T>, factor: T) -> Matrix3<T> {
    let row = |i: usize| add(&a[i], &scale(&b[i], factor));
    [row(0), row(1), row(2)]
}

/// The matrix of the vector product: skew(a) b = a x b.
#[inline]
pub fn skew<T: Real>(a: &Vector3<T>) -> Matrix3<T> {
    let zero = T::zero();
    [[zero, -a[2], a[1]], [a[2], zero, -a[0]], [-a[1], a[0], zero]]
}
