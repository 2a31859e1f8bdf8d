//! Dual numbers: a value with its derivatives along `N` directions, so that any function of this
//! crate gives exact slopes in one pass (forward-mode differentiation).

use core::num::FpCategory;
use core::ops::{Add, Div, Mul, Neg, Rem, Sub};

use num_traits::float::FloatCore;
use num_traits::{Num, NumCast, One, ToPrimitive, Zero};

use crate::Real;

/// A value and its derivatives along `N` directions.
///
/// ```
/// use model::{Dual, Real};
///
/// let x = Dual::<1>::along(0.5, 0);
/// let y = (x * x).exp();
/// assert!((y.slope[0] - 2.0 * 0.5 * 0.25_f64.exp()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// Its derivative along each direction.
    pub slope: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A value that changes along no direction.
    pub fn fixed(value: f64) -> Self {
        Self { value, slope: [0.0; N] }
    }

    /// A value that is itself what changes along a direction (0 to `N` - 1).
    pub fn along(value: f64, direction: usize) -> Self {
        let mut slope = [0.0; N];
        slope[direction] = 1.0;
        Self { value, slope }
    }

    /// A function's value, by the chain rule with its derivative.
    #[inline]
    fn chain(self, value: f64, derivative: f64) -> Self {
        Self { value, slope: self.slope.map(|s| derivative * s) }
    }

    /// A function of two numbers, by the chain rule with its partial derivatives.
    #[inline]
    fn chain_of_two(self, other: Self, value: f64, partials: [f64; 2]) -> Self {
        let mut slope = self.slope;
        for (s, o) in slope.iter_mut().zip(other.slope) {
            *s = partials[0] * *s + partials[1] * o;
        }
        Self { value, slope }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.chain_of_two(other, self.value + other.value, [1.0, 1.0])
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.chain_of_two(other, self.value - other.value, [1.0, -1.0])
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        self.chain_of_two(other, self.value * other.value, [other.value, self.value])
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.chain_of_two(other, value, [1.0 / other.value, -value / other.value])
    }
}

impl<const N: usize> Rem for Dual<N> {
    type Output = Self;
    fn rem(self, other: Self) -> Self {
        let whole = libm::trunc(self.value / other.value);
        self.chain_of_two(other, self.value % other.value, [1.0, -whole])
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

impl<const N: usize> PartialEq for Dual<N> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<const N: usize> PartialOrd for Dual<N> {
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<const N: usize> Zero for Dual<N> {
    fn zero() -> Self {
        Self::fixed(0.0)
    }
    fn is_zero(&self) -> bool {
        self.value == 0.0
    }
}

impl<const N: usize> One for Dual<N> {
    fn one() -> Self {
        Self::fixed(1.0)
    }
}

impl<const N: usize> Num for Dual<N> {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        <f64 as Num>::from_str_radix(text, radix).map(Self::fixed)
    }
}

impl<const N: usize> ToPrimitive for Dual<N> {
    fn to_i64(&self) -> Option<i64> {
        self.value.to_i64()
    }
    fn to_u64(&self) -> Option<u64> {
        self.value.to_u64()
    }
    fn to_f64(&self) -> Option<f64> {
        Some(self.value)
    }
}

impl<const N: usize> NumCast for Dual<N> {
    fn from<T: ToPrimitive>(n: T) -> Option<Self> {
        n.to_f64().map(Self::fixed)
    }
}

impl<const N: usize> FloatCore for Dual<N> {
    fn infinity() -> Self {
        Self::fixed(f64::INFINITY)
    }
    fn neg_infinity() -> Self {
        Self::fixed(f64::NEG_INFINITY)
    }
    fn nan() -> Self {
        Self::fixed(f64::NAN)
    }
    fn neg_zero() -> Self {
        Self::fixed(-0.0)
    }
    fn min_value() -> Self {
        Self::fixed(f64::MIN)
    }
    fn min_positive_value() -> Self {
        Self::fixed(f64::MIN_POSITIVE)
    }
    fn epsilon() -> Self {
        Self::fixed(f64::EPSILON)
    }
    fn max_value() -> Self {
        Self::fixed(f64::MAX)
    }
    fn classify(self) -> FpCategory {
        self.value.classify()
    }
    #[inline]
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    #[inline]
    fn signum(self) -> Self {
        Self::fixed(FloatCore::signum(self.value))
    }
    fn to_degrees(self) -> Self {
        self.chain(self.value.to_degrees(), 1.0_f64.to_degrees())
    }
    fn to_radians(self) -> Self {
        self.chain(self.value.to_radians(), 1.0_f64.to_radians())
    }
    fn integer_decode(self) -> (u64, i16, i8) {
        FloatCore::integer_decode(self.value)
    }
}

impl<const N: usize> Real for Dual<N> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::fixed(value)
    }
    #[inline]
    fn from_i32(value: i32) -> Self {
        Self::fixed(<f64 as Real>::from_i32(value))
    }
    fn as_f64(self) -> f64 {
        self.value
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(self.value);
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline]
    fn exp(self) -> Self {
        let exp = Real::exp(self.value);
        self.chain(exp, exp)
    }
    #[inline]
    fn exp_m1(self) -> Self {
        let exp_m1 = Real::exp_m1(self.value);
        self.chain(exp_m1, exp_m1 + 1.0)
    }
    #[inline]
    fn sqrt(self) -> Self {
        let sqrt = Real::sqrt(self.value);
        self.chain(sqrt, 0.5 / sqrt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_robot::reference_robot;
    use crate::{Friction, FrictionState};

    /// What friction does along a motion that turns back, at its end [V].
    fn friction_at_the_end<T: Real>(friction: &Friction<T>) -> T {
        let mut state = FrictionState { deflection_rad: T::zero() };
        let mut last = T::zero();
        for k in 0..700 {
            let velocity = T::constant(0.4 * libm::cos(9e-3 * <f64 as Real>::from_i32(k)));
            last = state.step(friction, velocity, T::constant(1e-3));
        }
        last
    }

    #[test]
    fn slopes_of_friction_are_those_of_differences() {
        let values = reference_robot::<f64>().friction[1].to_array();
        let mut place = 0;
        let dual = Friction::from_array(values.map(|value| {
            place += 1;
            Dual::<6>::along(value, place - 1)
        }));
        let slope = friction_at_the_end(&dual).slope;
        for (parameter, slope) in slope.into_iter().enumerate() {
            let step = 1e-5 * values[parameter];
            let moved = |sign: f64| {
                let mut moved = values;
                moved[parameter] += sign * step;
                friction_at_the_end(&Friction::from_array(moved))
            };
            let difference = (moved(1.0) - moved(-1.0)) / (2.0 * step);
            assert!((slope - difference).abs() < 1e-5 * (1e-6 + difference.abs()), "{parameter}");
        }
    }

    #[test]
    fn products_quotients_and_sines_follow_their_rules() {
        let x = Dual::<1>::along(0.7, 0);
        let (sin, cos) = Real::sin_cos(x);
        let y = sin * cos / (x + Dual::one()) - Real::sqrt(x);
        let (s, c) = (libm::sin(0.7), libm::cos(0.7));
        let expected = (c * c - s * s) / 1.7 - s * c / (1.7 * 1.7) - 0.5 / libm::sqrt(0.7);
        assert!((y.slope[0] - expected).abs() < 1e-15);
    }
}
