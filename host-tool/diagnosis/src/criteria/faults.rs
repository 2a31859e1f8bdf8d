//! Thresholds of faults of the model as given.

use super::table::criteria;

criteria! {
    /// Which faults of the model are tried, and when one is said.
    FaultCriteria {
        /// Faults are tried where a refitted model leaves so many times the noise in some log.
        least_ratio: f64 = 3.0,
        /// They are not where so few causes leave noise alone: what a fault explains, nothing else
        /// explains so simply, but for commands that come late, which are delays of all joints. Once so many leave
        /// more than noise, a sure one ends the search.
        few_causes: usize = 2,
        /// They are tried on so much of each train log [s].
        part_s: f64 = 12.0,
        /// Most steps of a fit.
        steps: usize = 3,
        /// Most steps of a fault's size.
        size_steps: usize = 6,
        /// A fault is said if it explains this part of the squares above the noise (lengths that explain this part of what
        /// an effect of the whole robot does leave it without a name),
        explained: f64 = 0.9,
        /// and leaves no more than so many times what the causes found leave.
        as_good: f64 = 1.2,
        /// or than this part of the gap, which is sure, for several causes can always make up for one fault.
        sure: f64 = 0.01,
        /// Doubt about a length, in parts of it.
        length_part: f64 = 0.1,
        /// Least length that such a part is taken of [m].
        least_length_m: f64 = 0.05,
        /// Doubt about a home position [rad].
        home_rad: f64 = 0.2,
        /// Doubt about when commands act on all joints: a bus and its drives take some cycles [s].
        late_s: f64 = 2e-3,
    }
}
