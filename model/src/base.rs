//! The 16 base parameters, in the names of Khalil and Dombre.

use serde::{Deserialize, Serialize};

use crate::parameter::{ParameterError, named};
use crate::{Geometry, Posture, Real, vector};

/// How many base parameters there are, eq. (4).
pub const COUNT: usize = 16;

/// The base parameters' names, in the order of [`BaseParameters::to_array`].
pub const NAMES: [&str; COUNT] = [
    "zz1r", "xx2r", "xy2r", "xz2r", "yz2r", "zz2r", "mx2r", "my2r", //
    "xx3r", "xy3r", "xz3r", "yz3r", "zz3r", "mx3r", "my3r", "ia3",
];

/// The base parameters of eq. (4): first moments in kg m, inertias in kg m^2.
///
/// Jm,1 is inside `zz1r`, Jm,2 inside `zz2r`; `ia3` is Jm,3.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
#[serde(deny_unknown_fields)]
pub struct BaseParameters<T> {
    pub zz1r: T,
    pub xx2r: T,
    pub xy2r: T,
    pub xz2r: T,
    pub yz2r: T,
    pub zz2r: T,
    pub mx2r: T,
    pub my2r: T,
    pub xx3r: T,
    pub xy3r: T,
    pub xz3r: T,
    pub yz3r: T,
    pub zz3r: T,
    pub mx3r: T,
    pub my3r: T,
    pub ia3: T,
}

impl<T: Real> BaseParameters<T> {
    /// The parameters as the vector p of eq. (4), in the order of [`NAMES`].
    pub fn to_array(&self) -> [T; COUNT] {
        [
            self.zz1r, self.xx2r, self.xy2r, self.xz2r, self.yz2r, self.zz2r, self.mx2r, self.my2r,
            self.xx3r, self.xy3r, self.xz3r, self.yz3r, self.zz3r, self.mx3r, self.my3r, self.ia3,
        ]
    }

    /// The parameters from the vector p of eq. (4), in the order of [`NAMES`].
    pub fn from_array(p: [T; COUNT]) -> Self {
        let [zz1r, xx2r, xy2r, xz2r, yz2r, zz2r, mx2r, my2r, ..] = p;
        let [.., xx3r, xy3r, xz3r, yz3r, zz3r, mx3r, my3r, ia3] = p;
        Self {
            zz1r,
            xx2r,
            xy2r,
            xz2r,
            yz2r,
            zz2r,
            mx2r,
            my2r, //
            xx3r,
            xy3r,
            xz3r,
            yz3r,
            zz3r,
            mx3r,
            my3r,
            ia3,
        }
    }

    /// The same parameters in another number type.
    pub fn cast<U: Real>(&self) -> BaseParameters<U> {
        BaseParameters::from_array(self.to_array().map(|p| U::constant(p.as_f64())))
    }

    /// Checks that all are finite and that the mass matrix is positive definite
    /// in every posture.
    pub fn check(&self, geometry: &Geometry<T>) -> Result<(), ParameterError> {
        for (name, value) in NAMES.into_iter().zip(self.to_array()) {
            named(name, value).finite()?;
        }
        let worst = self.smallest_minors(geometry);
        const MUST: &str = "make the mass matrix positive definite in every posture";
        named("zz3r + ia3", worst[0]).require(worst[0] > T::zero(), MUST)?;
        named("zz2r (minor of joints 2 and 3)", worst[1]).require(worst[1] > T::zero(), MUST)?;
        named("zz1r (determinant)", worst[2]).require(worst[2] > T::zero(), MUST)?;
        Ok(())
    }

    /// The smallest value over all postures of the three minors of D that joint 3,
    /// joints 3 and 2, and all three make: a grid, then a search around its lowest point.
    fn smallest_minors(&self, geometry: &Geometry<T>) -> [T; 3] {
        [0, 1, 2].map(|order| {
            let minor = |q2: T, q3: T| {
                let d = Posture::new(q2, q3).mass_matrix(self, geometry);
                let reversed = [
                    [d[2][2], d[2][1], d[2][0]],
                    [d[1][2], d[1][1], d[1][0]],
                    [d[0][2], d[0][1], d[0][0]],
                ];
                vector::leading_minors(&reversed)[order]
            };
            smallest_over_a_turn(minor)
        })
    }
}

/// The smallest value of `f` over a full turn of both arguments.
///
/// The minors are trigonometric polynomials of low degree: 32 points a turn find
/// the right valley and halving the step eleven times finds its bottom.
fn smallest_over_a_turn<T: Real>(f: impl Fn(T, T) -> T) -> T {
    const POINTS: i32 = 32;
    let mut step = T::constant(core::f64::consts::TAU) / T::whole(POINTS);
    let mut lowest = (f(T::zero(), T::zero()), T::zero(), T::zero());
    let try_point = |lowest: &mut (T, T, T), x: T, y: T| {
        let value = f(x, y);
        // A NaN is taken, then kept since nothing is below it, and fails the check.
        if value < lowest.0 || value.is_nan() {
            *lowest = (value, x, y);
        }
    };
    for index in 0..POINTS * POINTS {
        let at = |i: i32| T::whole(i) * step;
        try_point(&mut lowest, at(index / POINTS), at(index % POINTS));
    }
    for _ in 0..11 {
        step = step / T::constant(2.0);
        for index in 0..9 {
            let (_, x, y) = lowest;
            let offset = |i: i32| T::whole(i - 1) * step;
            try_point(&mut lowest, x + offset(index / 3), y + offset(index % 3));
        }
    }
    lowest.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bottom_between_the_grid_points_is_found() {
        let valley = |x: f64, y: f64| 2.0 - (x - 1.0).cos() - (y + 2.0).cos();
        let lowest = smallest_over_a_turn(valley);
        assert!(lowest < 1e-8, "{lowest:e}");
    }

    #[test]
    fn a_posture_without_a_number_is_not_passed_over() {
        let hole = |x: f64, y: f64| if x > 1.0 && y > 1.0 && x < 1.2 { f64::NAN } else { 1.0 };
        assert!(smallest_over_a_turn(hole).is_nan());
    }
}
