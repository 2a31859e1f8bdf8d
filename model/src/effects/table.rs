//! A curve given by its knots.

use crate::Real;

/// A curve at `x`: linear between its knots, constant beyond the first and the last.
///
/// `knots` increase; each has its value in `values_v` [V]. A curve without knots is 0 V. The work
/// is a binary search: it grows with the logarithm of the number of knots.
#[inline]
pub fn table_v<T: Real>(knots: &[T], values_v: &[T], x: T) -> T {
    let after = knots.partition_point(|&knot| knot <= x);
    let knot = |place: usize| Some((*knots.get(place)?, *values_v.get(place)?));
    match (after.checked_sub(1).and_then(knot), knot(after)) {
        (Some((from, low_v)), Some((to, high_v))) => {
            low_v + (high_v - low_v) * ((x - from) / (to - from))
        }
        (Some((_, end_v)), None) | (None, Some((_, end_v))) => end_v,
        (None, None) => T::zero(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KNOTS: [f64; 3] = [-1.0, 0.0, 2.0];
    const VALUES_V: [f64; 3] = [0.3, -0.1, 0.7];

    #[test]
    fn a_curve_goes_through_its_knots_and_is_straight_between_them() {
        let at = |x| table_v(&KNOTS, &VALUES_V, x);
        for (knot, value_v) in KNOTS.into_iter().zip(VALUES_V) {
            assert_eq!(at(knot), value_v);
        }
        assert!((at(-0.5) - 0.1).abs() < 1e-15);
        assert!((at(0.5) - 0.1).abs() < 1e-15);
    }

    #[test]
    fn a_curve_is_constant_beyond_its_ends() {
        for (x, end_v) in [(-9.0, 0.3), (f64::NEG_INFINITY, 0.3), (2.1, 0.7), (f64::INFINITY, 0.7)]
        {
            assert_eq!(table_v(&KNOTS, &VALUES_V, x), end_v);
        }
    }

    #[test]
    fn no_knots_are_no_voltage() {
        assert_eq!(table_v::<f32>(&[], &[], 1.0), 0.0);
        assert_eq!(table_v(&KNOTS, &[], 1.0), 0.0);
    }
}
