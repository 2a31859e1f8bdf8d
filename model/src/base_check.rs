//! What base parameters must be: finite, with a mass matrix that is positive definite.

use crate::base::NAMES;
use crate::parameter::{ParameterError, named};
use crate::{BaseParameters, Geometry, Posture, Real, vector};

impl<T: Real> BaseParameters<T> {
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
    let mut step = T::constant(core::f64::consts::TAU) / T::from_i32(POINTS);
    let mut lowest = (f(T::zero(), T::zero()), T::zero(), T::zero());
    let try_point = |lowest: &mut (T, T, T), x: T, y: T| {
        let value = f(x, y);
        // A NaN is taken, then kept since nothing is below it, and fails the check.
        if value < lowest.0 || value.is_nan() {
            *lowest = (value, x, y);
        }
    };
    for index in 0..POINTS * POINTS {
        let at = |i: i32| T::from_i32(i) * step;
        try_point(&mut lowest, at(index / POINTS), at(index % POINTS));
    }
    for _ in 0..11 {
        step = step / T::constant(2.0);
        for index in 0..9 {
            let (_, x, y) = lowest;
            let offset = |i: i32| T::from_i32(i - 1) * step;
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
