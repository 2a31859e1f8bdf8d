//! What a cause is worth by what models leave with and without it.

use super::blocks::Blocks;
use crate::criteria::VerdictCriteria;

/// A cause's worth on the confirming logs, with 95 % intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worth {
    /// Part of the gap's squares above the noise; all of it where the model leaves more without this
    /// one of several causes than without any.
    pub share: f64,
    /// Its interval.
    pub share_interval: [f64; 2],
    /// Part of the same that is left with all causes, between nothing and all of it.
    pub remainder: f64,
    /// Part of what is left above the noise without it.
    pub part_of_left: f64,
    /// 1 - rms with it / rms without it.
    pub shrinkage: f64,
    /// Its interval.
    pub shrinkage_interval: [f64; 2],
}

impl Worth {
    /// Of blocks of what three models leave: without the cause, with it, and without any.
    pub fn of(blocks: &Blocks, criteria: &VerdictCriteria) -> Self {
        let of_gap = |part_v2: f64, gap: f64, noise: f64| {
            let excess = (gap - noise).max(criteria.least_excess * noise);
            (part_v2 / excess.max(f64::MIN_POSITIVE)).min(1.0)
        };
        let share = |sums: &[f64]| match sums {
            [without, with, gap, noise] => of_gap(without - with, *gap, *noise),
            _ => 0.0,
        };
        let left = |sums: &[f64]| match sums {
            [_, with, gap, noise] => of_gap(with - noise, *gap, *noise).max(0.0),
            _ => 0.0,
        };
        let shrinkage = |sums: &[f64]| match sums {
            [without, with, ..] if *without > 0.0 => 1.0 - (with / without).sqrt(),
            _ => 0.0,
        };
        let part = |sums: &[f64]| match sums {
            [without, with, _, noise] if without > noise => (without - with) / (without - noise),
            _ => 0.0,
        };
        let (part_of_left, _) = blocks.figure(1, part);
        let (share, share_interval) = blocks.figure(criteria.draws, share);
        let (shrinkage, shrinkage_interval) = blocks.figure(criteria.draws, shrinkage);
        let (remainder, _) = blocks.figure(1, left);
        Self { share, share_interval, remainder, part_of_left, shrinkage, shrinkage_interval }
    }
}

/// Whether a cause does a part of what goes with it itself, or stands out of the noise; blocks of what models leave
/// without it and with it, of what it does, all else unchanged, and of noise.
pub fn does_it_itself(blocks: &Blocks, criteria: &VerdictCriteria) -> bool {
    let stands_out = criteria.no_gap_ratio.powi(2);
    let beyond = |sums: &[f64]| match sums {
        [without, with, action, noise] => {
            action - (criteria.least_action * (without - with)).min(stands_out * noise)
        }
        _ => 0.0,
    };
    blocks.figure(1, beyond).0 >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criteria;

    /// Ten blocks of each of two joints: one that is quiet but for a cause, which takes nearly all of it, and one
    /// on which it does nothing, with what is left and the noise in units of both.
    fn blocks(quiet_unit_v2: f64, loud_unit_v2: f64) -> Blocks {
        let quiet = [1.0e-4, 0.12e-4, 1.0e-4, 0.1e-4].map(|v2| v2 / quiet_unit_v2);
        let loud =
            |k: usize| [40.0, 39.9 + 0.02 * k as f64, 40.0, 1.0].map(|v2| v2 * 1e-4 / loud_unit_v2);
        Blocks::made((0..10).flat_map(|k| [quiet.to_vec(), loud(k).to_vec()]).collect())
    }

    #[test]
    fn what_goes_with_a_limit_that_no_command_comes_near_to_is_not_its_own() {
        let criteria = Criteria::default().verdict;
        let blocks = |action_v2: f64| {
            Blocks::made((0..4).map(|_| vec![3e-6, 2e-6, action_v2, 1e-6]).collect())
        };
        assert!(!does_it_itself(&blocks(0.0), &criteria));
        assert!(!does_it_itself(&blocks(0.05e-6), &criteria));
        assert!(does_it_itself(&blocks(0.9e-6), &criteria));
    }

    /// A stiff spring: driven noise of the train logs bends inertias without it.
    #[test]
    fn what_stands_out_of_the_noise_acts_however_far_parameters_are_bent_without_it() {
        let criteria = Criteria::default().verdict;
        let blocks = |action_v2: f64| {
            Blocks::made((0..4).map(|_| vec![4e-3, 12e-6, action_v2, 1e-6]).collect())
        };
        assert!(!does_it_itself(&blocks(3e-6), &criteria));
        assert!(does_it_itself(&blocks(40e-6), &criteria));
    }

    #[test]
    fn a_cause_that_takes_all_of_a_quiet_joint_counts_beside_a_loud_one() {
        let criteria = Criteria::default().verdict;
        let in_volts = Worth::of(&blocks(1.0, 1.0), &criteria);
        let in_units = Worth::of(&blocks(0.12e-4, 40.0e-4), &criteria);
        assert!(in_volts.share < 0.05, "{in_volts:?}");
        assert!(in_units.share > 0.7 && in_units.share_interval[0] > 0.5, "{in_units:?}");
    }
}
