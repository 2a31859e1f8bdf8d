//! The number types that the model computes in.

use num_traits::float::FloatCore;

/// `f32` or `f64`, with the few functions that the robot's mathematics needs.
///
/// `f32` uses [`crate::trigonometry`] for sines, because libm's `sinf` computes in
/// `f64`, which the board's processor lacks; the rest is libm's.
pub trait Real: FloatCore + core::fmt::Debug + 'static {
    /// A constant. Folded at compile time where `value` is a literal.
    fn constant(value: f64) -> Self;
    /// An integer, converted without `f64`, which the board lacks in hardware.
    fn from_i32(value: i32) -> Self;
    /// The value as `f64`, for messages and reports.
    fn as_f64(self) -> f64;
    /// Sine and cosine of an angle in radians.
    ///
    /// `f32`: absolute error below [`crate::trigonometry::LARGEST_ERROR`] up to 100 rad.
    fn sin_cos(self) -> (Self, Self);
    /// e to the power of `self`. `f32`: relative error below 7.2e-8 on [-80, 0].
    fn exp(self) -> Self;
    /// e to the power of `self`, minus one, good for small arguments too.
    /// `f32`: relative error below 7.2e-8 on [-60, 0].
    fn exp_m1(self) -> Self;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
}

impl Real for f32 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value as f32
    }
    #[inline]
    fn from_i32(value: i32) -> Self {
        value as f32
    }
    fn as_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        crate::trigonometry::sin_cos_radians(self)
    }
    #[inline]
    fn exp(self) -> Self {
        libm::expf(self)
    }
    #[inline]
    fn exp_m1(self) -> Self {
        libm::expm1f(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }
}

impl Real for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn from_i32(value: i32) -> Self {
        f64::from(value)
    }
    fn as_f64(self) -> f64 {
        self
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }
    #[inline]
    fn exp(self) -> Self {
        libm::exp(self)
    }
    #[inline]
    fn exp_m1(self) -> Self {
        libm::expm1(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
}
