//! Thresholds and efforts of the search for candidates.

use super::table::criteria;

criteria! {
    /// How candidates are found.
    SearchCriteria {
        /// Highest harmonic per turn that is tried.
        highest_harmonic: usize = 100,
        /// Squares, twice the log-likelihood, that a wave between two whole orders takes more than the best whole one:
        /// its order is a choice more, and most waves are of magnets and teeth, which are whole.
        least_between_orders: f64 = 60.0,
        /// An order that is not whole is told if so many of its periods were passed: of fewer, any smooth curve over the
        /// angle, such as a cable's that hardens, has the shape.
        least_periods_of_fractional_order: f64 = 2.0,
        /// Harmonics that are followed up, of those that gain most.
        harmonics: usize = 3,
        /// Starts of one effect on one joint that are searched from.
        starts: usize = 2,
        /// Starts that promise less than this part of the best one's gain on their joint are not
        /// searched: a joint that hardly fits has few independent rows, and little to gain by numbers.
        least_of_best_gain: f64 = 0.08,
        /// Nor are those that promise to take away fewer weighted squares: an effect is accepted for
        /// 15 units of log-likelihood, which is half of 30, and a search finds more than its start.
        least_promise: f64 = 12.0,
        /// Most Levenberg-Marquardt steps of a search.
        steps: usize = 8,
        /// The same for springs, whose values are far from linear.
        spring_steps: usize = 14,
        /// A step that gains a smaller part of the squares ends a search.
        converged_part: f64 = 1e-3,
        /// Backlash must leave less than this part of the squares: a link that the measured torque
        /// corrects hides up to two fifths of whatever the model lacks.
        left_by_backlash: f64 = 0.6,
        /// How often a start for backlash is exchanged for one near it before it is searched from.
        play_scans: usize = 6,
        /// Steps from each of them before the best are told.
        first_play_steps: usize = 4,
        /// Most effects that are searched although others promised more, once those are refused.
        overlooked: usize = 10,
        /// Steps of their search.
        overlooked_steps: usize = 3,
        /// On arms of so many joints causes of different joints that one round found are added one after the other
        /// without a round for each,
        apart_from_joints: usize = 3,
        /// those that gain so many times what an effect must,
        runner_up_gain: f64 = 2.0,
        /// where they still gain this part of that beside the ones before.
        runner_up_keeps: f64 = 0.5,
        /// Most effects that are sought as if every row said something of its own, beside the others,
        by_independent_rows: usize = 5,
        /// where so many neighbouring rows or more say the same: less is what filters and friction leave.
        lasting_rows: f64 = 5.0,
        /// How often a search for backlash restarts from near where it ended.
        restarts: usize = 3,
        /// How many of the starts of such a search are followed up.
        restarts_followed: usize = 4,
        /// Steps of such a search.
        restart_steps: usize = 8,
        /// A restart must gain this part of the squares.
        least_restart_gain: f64 = 0.05,
        /// Nothing is restarted where no log is left with more than so many times the noise.
        good_ratio: f64 = 3.0,
    }
}
