//! Functions of one variable, linear between nodes.

/// Nodes in order; a function is its values at them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Nodes {
    at: Vec<f64>,
}

impl Nodes {
    /// Nodes where the data are, closer towards the ends, where knees are.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        const LEVELS: [f64; 13] =
            [0.0, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.98, 1.0];
        Self::at_levels(values, &LEVELS)
    }

    /// Nodes at these quantiles of the data.
    pub fn at_levels(values: impl Iterator<Item = f64>, levels: &[f64]) -> Self {
        let mut sorted: Vec<f64> = values.collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let last = sorted.len().saturating_sub(1);
        let quantile = |level: &f64| sorted.get((level * last as f64).round() as usize).copied();
        let mut at: Vec<f64> = levels.iter().filter_map(quantile).collect();
        at.dedup();
        Self { at }
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.at.len()
    }

    /// The two nodes about a value and their weights, which sum to 1.
    pub fn weights(&self, value: f64) -> [(usize, f64); 2] {
        let last = self.at.len().saturating_sub(1);
        let above = self.at.partition_point(|&node| node <= value).clamp(1.min(last), last);
        let below = above.saturating_sub(1);
        if above == below {
            return [(0, 1.0), (0, 0.0)];
        }
        let share = (value - self.at[below]) / (self.at[above] - self.at[below]);
        let share = share.clamp(0.0, 1.0);
        [(below, 1.0 - share), (above, share)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_lies_between_its_nodes() {
        let nodes = Nodes { at: vec![0.0, 1.0, 3.0] };
        assert_eq!(nodes.weights(2.5), [(1, 0.25), (2, 0.75)]);
        assert_eq!(nodes.weights(-5.0), [(0, 1.0), (1, 0.0)]);
        assert_eq!(nodes.weights(9.0), [(1, 0.0), (2, 1.0)]);
        assert_eq!(Nodes { at: vec![2.0] }.weights(7.0), [(0, 1.0), (0, 0.0)]);
    }
}
