//! What friction has more of in one log than in another: grease thins as joints warm, and logs are recorded cold and warm.

use std::collections::BTreeMap;

/// How many values the warmth of a joint in a log has.
pub const WARMTH_VALUES: usize = 2;

/// Time in which a joint warms: what a log of a minute shows of it is not much else [s].
const TIME_CONSTANT_S: f64 = 30.0;

/// No joint loses more of its friction.
const LEAST_FACTOR: f64 = 0.1;

/// Warmth of joints (from 0) in logs, by both.
pub type Warmths = BTreeMap<(usize, usize), Warmth>;

/// Time after which the friction of a log counts where one has to do for all [s].
pub const USUAL_S: f64 = TIME_CONSTANT_S / 3.0;

/// By which part Coulomb and viscous friction of a joint in a log are larger than the model has them: where the log
/// begins, and by how much more after a long time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Warmth {
    /// The two parts.
    pub parts: [f64; WARMTH_VALUES],
}

impl Warmth {
    /// The factor on Coulomb and viscous friction so long after the log began [s].
    pub fn factor(self, time_s: f64) -> f64 {
        let both = self.parts.iter().zip(shape(time_s));
        (1.0 + both.map(|(part, shape)| part * shape).sum::<f64>()).max(LEAST_FACTOR)
    }
}

/// What the factor has of each of the two parts: 1, and 1 - exp(-t/T).
pub fn shape(time_s: f64) -> [f64; WARMTH_VALUES] {
    [1.0, -(-time_s / TIME_CONSTANT_S).exp_m1()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_goes_from_one_part_to_the_sum_of_both() {
        let warmth = Warmth { parts: [0.1, -0.3] };
        assert!((warmth.factor(0.0) - 1.1).abs() < 1e-12);
        assert!((warmth.factor(100.0 * TIME_CONSTANT_S) - 0.8).abs() < 1e-12);
        assert_eq!(Warmth::default().factor(7.0), 1.0);
    }
}
