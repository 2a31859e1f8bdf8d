//! Thresholds of the verdict and its figures.

use super::table::criteria;

criteria! {
    /// What the search amounts to.
    VerdictCriteria {
        /// A gap is explained if every log is left with at most so many times the noise,
        explained_ratio: f64 = 3.0,
        /// or with this part of what it was left with before;
        explained_part: f64 = 0.03,
        /// the same with a spring: how motor and link bounce between samples is not known, nor what
        /// friction does meanwhile;
        explained_spring_ratio: f64 = 6.0,
        /// likewise the part;
        explained_spring_part: f64 = 0.08,
        /// and if the causes take away this part of the excess.
        explained_excess: f64 = 0.9,
        /// What no effect explains is no gap if it is below so many times the noise.
        no_gap_ratio: f64 = 2.0,
        /// Independent observations in a set of logs, for the confidence: neighbouring rows say the
        /// same.
        independent_observations: f64 = 60.0,
        /// Weight of the prior penalty in the log-likelihood of the confidence.
        prior_weight: f64 = 0.125,
        /// Highest confidence: the part of the causes named without a rival that were right in blind
        /// trials (docs/blind-trial.md).
        highest_confidence: f64 = 0.98,
        /// Lowest confidence of an alternative that is named.
        least_confidence: f64 = 0.02,
        /// A refitted model that leaves a larger part of a command is that of another robot.
        another_robot_part: f64 = 0.2,
        /// Squared correlation from which two effects are not told apart.
        alike_correlation: f64 = 0.995,
        /// Most steps of the fit without one of several causes.
        without_cause_steps: usize = 4,
        /// Length of the pieces from which the interval of the shrinkage is drawn [s].
        shrinkage_piece_s: f64 = 0.5,
        /// How often it is drawn.
        shrinkage_draws: usize = 400,
        /// Length of the windows in which the predicted motion drifts [s].
        drift_window_s: f64 = 0.25,
        /// Commands before such a window that fill lags and delays [s].
        drift_before_s: f64 = 0.1,
        /// The sentence mentions the refit where the model as given leaves so many times what it leaves.
        worth_refitting: f64 = 1.5,
    }
}
