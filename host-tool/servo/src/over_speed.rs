//! Friction over speed by a table, where it is of no formula.

/// Where the table has values, in parts of its top speed: closer where friction bends most.
pub const SPEEDS: [f64; 5] = [0.005, 0.02, 0.06, 0.2, 0.5];

/// Friction more than Coulomb's and viscous: straight between values, nothing at rest and from the top speed on,
/// which Coulomb's level and the viscous coefficient are free to fit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OverSpeed {
    /// The speed from which on it says nothing [rad/s; m/s]; zero where there is no table.
    pub top: f64,
    /// Values at [`SPEEDS`] [V].
    pub more: [f64; SPEEDS.len()],
}

impl OverSpeed {
    /// What it adds to the level of friction at a speed [V].
    #[inline]
    pub fn at(&self, speed: f64) -> f64 {
        let part = speed / self.top;
        let (mut from, mut low) = (0.0, 0.0);
        for (to, high) in SPEEDS.into_iter().zip(self.more).chain([(1.0, 0.0)]) {
            if part < to {
                return low + (high - low) * (part - from) / (to - from);
            }
            (from, low) = (to, high);
        }
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_straight_between_its_values_and_nothing_at_rest_and_from_its_top_on() {
        let table = OverSpeed { top: 10.0, more: [0.1, 0.2, 0.3, 0.4, 0.5] };
        let at = |speed: f64| (1e6 * table.at(speed)).round() / 1e6;
        assert_eq!([0.0, 0.025, 0.05, 0.4, 2.0].map(at), [0.0, 0.05, 0.1, 0.25, 0.4]);
        assert_eq!([7.5, 10.0, 20.0].map(at), [0.25, 0.0, 0.0]);
        let none = OverSpeed { top: 0.0, ..table };
        assert_eq!([0.0, 1.0].map(|speed| none.at(speed)), [0.0, 0.0]);
    }
}
