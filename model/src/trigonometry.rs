//! Sine and cosine in pure `f32`.
//!
//! libm's `sinf` is exact but computes in `f64` (1250 instructions on a
//! Cortex-M4F), micromath's is short but 1e-3 wrong. Between them stands this
//! pair of minimax polynomials on a quarter turn: largest error 1.25e-7, which the
//! tests below hold. The coefficients are those of the Cephes library's
//! single-precision `sinf` and `cosf`.

use core::f32::consts::FRAC_PI_2;

/// Largest absolute error of [`sin_cos_turn`], and of [`sin_cos_radians`] up to 100 rad.
pub const LARGEST_ERROR: f32 = 1.25e-7;

/// Sine and cosine of `turn` / 2^32 of a full turn.
///
/// An integer that wraps once a turn needs no argument reduction and loses no
/// precision after many turns: this is what the tick uses.
#[inline]
pub fn sin_cos_turn(turn: i32) -> (f32, f32) {
    const RADIANS_PER_UNIT: f32 = FRAC_PI_2 / (1 << 30) as f32;
    let quadrant = (turn as u32).wrapping_add(1 << 29) >> 30;
    let rest = turn.wrapping_sub((quadrant << 30) as i32);
    rotate(quadrant, rest as f32 * RADIANS_PER_UNIT)
}

/// The sine alone of `turn` / 2^32 of a full turn: one polynomial on half a turn.
///
/// Minimax coefficients, wrong by 4.6e-9 before rounding, by 1.3e-7 after it.
#[inline]
pub fn sin_turn(turn: i32) -> f32 {
    const RADIANS_PER_UNIT: f32 = FRAC_PI_2 / (1 << 30) as f32;
    // Above a quarter turn in magnitude the sine is that of the angle mirrored there.
    let beyond = (turn ^ (turn << 1)) < 0;
    let folded = if beyond { i32::MIN.wrapping_sub(turn) } else { turn };
    let x = folded as f32 * RADIANS_PER_UNIT;
    let square = x * x;
    let tail = (2.600_054_5e-6 * square - 1.980_661_5e-4) * square + 8.333_017e-3;
    x + x * square * (tail * square - 1.666_665_7e-1)
}

/// Sine and cosine of an angle in radians, best below 100 rad.
///
/// Beyond, the error grows with the angle, as the angle's own spacing does; beyond
/// 4e6 rad the result means nothing.
// Not inlined: with two calls side by side the host's compiler packs both angles into
// one vector, and reads them from where they were stored singly: 15 ns of waiting,
// half of an inverse dynamics.
#[inline(never)]
pub fn sin_cos_radians(angle_rad: f32) -> (f32, f32) {
    // pi/2 in three parts, the first two short enough that their multiples are exact.
    const HIGH: f32 = 1.570_312_5;
    const MIDDLE: f32 = 4.837_513e-4;
    const LOW: f32 = 7.549_79e-8;
    // Adding 1.5 * 2^23 rounds to a whole number, which then stands in the lowest bits:
    // no conversion, whose saturation makes the host compare and branch.
    const ROUNDING: f32 = 12_582_912.0;
    let rounded = angle_rad * core::f32::consts::FRAC_2_PI + ROUNDING;
    let n = rounded - ROUNDING;
    rotate(rounded.to_bits(), ((angle_rad - n * HIGH) - n * MIDDLE) - n * LOW)
}

/// Sine and cosine of `quadrant` quarter turns plus `rest` in [-pi/4, pi/4].
#[inline]
fn rotate(quadrant: u32, rest_rad: f32) -> (f32, f32) {
    let (sine, cosine) = (sine_polynomial(rest_rad), cosine_polynomial(rest_rad));
    let (sine, cosine) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let negated_if = |bit_1: u32, x: f32| f32::from_bits(x.to_bits() ^ ((bit_1 & 2) << 30));
    (negated_if(quadrant, sine), negated_if(quadrant.wrapping_add(1), cosine))
}

#[inline]
fn sine_polynomial(x: f32) -> f32 {
    let square = x * x;
    let tail = (-1.951_529_6e-4 * square + 8.332_161e-3) * square - 1.666_665_5e-1;
    x + x * square * tail
}

#[inline]
fn cosine_polynomial(x: f32) -> f32 {
    let square = x * x;
    let tail = (2.443_315_7e-5 * square - 1.388_731_6e-3) * square + 4.166_664_6e-2;
    1.0 - 0.5 * square + square * square * tail
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worst(pairs: impl Iterator<Item = ((f32, f32), f64)>) -> f64 {
        pairs
            .map(|((sine, cosine), angle)| {
                let (s, c) = libm::sincos(angle);
                (f64::from(sine) - s).abs().max((f64::from(cosine) - c).abs())
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn turn_error_is_as_documented() {
        let scale = core::f64::consts::TAU / 4_294_967_296.0;
        let turns = (0..4_000_000u32).map(|i| i.wrapping_mul(1073) as i32);
        let error = worst(turns.map(|t| (sin_cos_turn(t), f64::from(t) * scale)));
        assert!(error < f64::from(LARGEST_ERROR), "{error:e}");
        assert!(error > 0.3 * f64::from(LARGEST_ERROR), "document the smaller error {error:e}");
    }

    #[test]
    fn the_sine_alone_is_as_documented() {
        let scale = core::f64::consts::TAU / 4_294_967_296.0;
        let turns = (0..4_000_000u32).map(|i| i.wrapping_mul(1073) as i32);
        let error = |t: i32| (f64::from(sin_turn(t)) - libm::sin(f64::from(t) * scale)).abs();
        let worst = turns.map(error).fold(0.0, f64::max);
        assert!(worst < 1.3e-7, "{worst:e}");
        assert_eq!([0, 1 << 30, i32::MIN, -1 << 30].map(sin_turn), [0.0, 1.0, 0.0, -1.0]);
    }

    #[test]
    fn radian_error_is_as_documented() {
        let angles = (-1_000_000..1_000_000).map(|i| i as f32 * 1e-4);
        let error = worst(angles.map(|a| (sin_cos_radians(a), f64::from(a))));
        assert!(error < f64::from(LARGEST_ERROR), "{error:e}");
    }

    /// The multiples of the first two parts of pi/2 are still exact.
    #[test]
    fn after_a_thousand_turns_radians_are_still_good() {
        let angles = (-1_000_000..1_000_000).map(|i| i as f32 * 1e-2);
        let error = worst(angles.map(|a| (sin_cos_radians(a), f64::from(a))));
        assert!(error < 2.0 * f64::from(LARGEST_ERROR), "{error:e}");
    }

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(sin_cos_turn(0), (0.0, 1.0));
        assert_eq!(sin_cos_turn(1 << 30), (1.0, 0.0));
        assert_eq!(sin_cos_turn(i32::MIN), (0.0, -1.0));
    }
}
