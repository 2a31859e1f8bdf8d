//! A table with fewer knots.

use super::curve::Table;

impl Table {
    /// The same with at most `most` knots, but at least its two ends, and by how much it differs
    /// at most [V].
    ///
    /// Knots go one after the other, each time the one that the curve through its neighbours
    /// misses least.
    pub fn coarsened(&self, most: usize) -> (Self, f64) {
        let mut coarse = self.clone();
        while coarse.knots.len() > most.max(2) {
            let missed_v = |place: &usize| coarse.missed_without_v(*place);
            let inner = 1..coarse.knots.len() - 1;
            let least = inner.min_by(|a, b| missed_v(a).total_cmp(&missed_v(b)));
            let Some(place) = least else { break };
            coarse.knots.remove(place);
            coarse.values_v.remove(place);
        }
        // Two curves of straight pieces differ most at a knot of one of them.
        let both = self.knots.iter().zip(&self.values_v);
        let missed = both.map(|(knot, value_v)| (coarse.value_v(*knot) - value_v).abs());
        let most_v = missed.fold(0.0, f64::max);
        (coarse, most_v)
    }

    /// By how much the straight line between the neighbours of an inner knot misses it [V].
    fn missed_without_v(&self, place: usize) -> f64 {
        let (before, after) = (place - 1, place + 1);
        let knots = [self.knots[before], self.knots[after]];
        let values_v = [self.values_v[before], self.values_v[after]];
        let straight_v = model::effects::table_v(&knots, &values_v, self.knots[place]);
        (straight_v - self.values_v[place]).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::super::axis::TableAxis;
    use super::*;

    fn of(curve: impl Fn(f64) -> f64, count: u32) -> Table {
        let knots: Vec<f64> = (0..count).map(|k| f64::from(k) / f64::from(count - 1)).collect();
        let values_v = knots.iter().map(|x| curve(*x)).collect();
        Table { joint: 1, axis: TableAxis::Velocity, knots, values_v }
    }

    #[test]
    fn knots_on_a_straight_line_go_without_a_loss() {
        let bent = of(|x| (x - 0.5).abs(), 41);
        let (coarse, missed_v) = bent.coarsened(3);
        assert_eq!(coarse.knots, [0.0, 0.5, 1.0]);
        assert!(missed_v < 1e-12, "{missed_v}");
    }

    #[test]
    fn what_a_coarser_curve_misses_is_known() {
        let wave = of(|x| 0.1 * (9.0 * x).sin(), 64);
        let (coarse, missed_v) = wave.coarsened(20);
        let seen = (0..10_000).map(|k| f64::from(k) / 9999.0);
        let worst = seen.map(|x| (wave.value_v(x) - coarse.value_v(x)).abs()).fold(0.0, f64::max);
        assert_eq!(coarse.knots.len(), 20);
        assert!(worst <= missed_v + 1e-12 && missed_v < 0.01, "{worst} {missed_v}");
        assert_eq!(wave.coarsened(64), (wave, 0.0));
    }
}
