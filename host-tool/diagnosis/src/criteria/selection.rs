//! Thresholds of what is added to the model.

use super::table::criteria;

criteria! {
    /// Which candidates are added to the model, and when that ends.
    SelectionCriteria {
        /// Most effects that are added.
        most_effects: usize = 3,
        /// Most candidates that are refitted at a time.
        finalists: usize = 5,
        /// How often the next ones are refitted where none of those before is accepted.
        batches: usize = 4,
        /// A candidate is refitted together with the best if it gains this part of what that gains.
        finalist_gain: f64 = 0.4,
        /// Most Gauss-Newton steps of a finalist's fit.
        finalist_steps: usize = 2,
        /// The same for the one that is accepted.
        accepted_steps: usize = 4,
        /// The same where that is a spring, whose values are far from linear.
        accepted_spring_steps: usize = 10,
        /// Part of the excess that an effect must take away.
        least_of_excess: f64 = 0.2,
        /// Part of all squares, and of those held out, that it must take away: less is at the edge
        /// of what is an excess.
        least_of_squares: f64 = 0.05,
        /// An effect is accepted for the prior too, if it takes away this part of the prior penalty,
        least_of_prior_penalty: f64 = 0.5,
        /// and leaves at most so many times the squares, because the refit absorbed part of it,
        most_squares_for_prior: f64 = 1.15,
        /// and of those held out so many times.
        most_held_out_for_prior: f64 = 1.5,
        /// An effect is refused if it makes parameters implausible and their prior penalty so many
        /// times larger.
        most_prior_penalty_growth: f64 = 1.2,
        /// An effect is refused if it leaves less than this part of what encoder steps alone leave,
        /// for it takes noise for motion,
        least_of_encoder_noise: f64 = 0.7,
        /// where there was less than so many times that before.
        near_encoder_noise: f64 = 2.0,
        /// The search ends where no log is left with more than so many times the noise,
        done_ratio: f64 = 3.0,
        /// and this part of the refitted model's excess: effects that are not linear are not removed
        /// to the last.
        done_part: f64 = 5e-4,
        /// A spring leaves its motor this part of the joint's inertia, or it only smooths what the
        /// encoder reads.
        least_motor_inertia: f64 = 0.02,
        /// Backlash is wider than the deflection of its spring under this part of the largest torque.
        least_gap: f64 = 0.02,
    }
}
