//! Thresholds of the verdict and its figures.

use super::table::criteria;

criteria! {
    /// What the search amounts to.
    VerdictCriteria {
        /// The verdict is `effect` if the causes named take this part of the gap's squares above the
        /// noise.
        explained: f64 = 0.9,
        /// What no effect explains is no gap if it is below so many times the noise.
        no_gap_ratio: f64 = 2.0,
        /// Nor is it none if the refitted model, its parameters within their doubt, leaves so many
        /// times the noise of the confirming logs.
        far_above_noise: f64 = 5.0,
        /// Where the confirming logs leave less than `no_gap_ratio` times the noise, it is none, too, if
        /// no train log leaves so many times its noise,
        most_in_one_log: f64 = 10.0,
        /// and the refitted parameters are not further off than this prior penalty.
        most_prior_penalty: f64 = 240.0,
        /// Weight of a log-likelihood in a probability: what a wrong effect leaves is structured, and
        /// counts as fewer independent deviations than its correlation tells.
        log_likelihood_weight: f64 = 0.1,
        /// Candidates that gain by chance what an effect gains.
        tried_by_chance: f64 = 2.0,
        /// A shrinkage of so many standard deviations is as good as sure. Effects that passed the search and shrank by
        /// 1.2 to 2 of them on the confirming logs were there in 16 of 22 cases, those by 2 to 3.7 in 21 of 22
        /// (diverse seeds 32038, 52525 and 38119).
        sure_deviations: f64 = 2.5,
        /// Highest probability: the part of the causes named without a rival that were right in blind
        /// trials (docs/blind-trial.md).
        highest_probability: f64 = 0.98,
        /// Least probability of a cause that is named.
        least_probability: f64 = 0.5,
        /// One that is less than twice as likely as not takes `most_of_left` of what is left without it.
        sure_probability: f64 = 2.0 / 3.0,
        /// Least excess that a share is taken of, in parts of the squares of noise: some hundred
        /// independent rows tell squares to a twentieth.
        least_excess: f64 = 0.05,
        /// A cause takes this share of the gap to be named,
        least_share: f64 = 0.1,
        /// and this part of what is left above the noise without it;
        least_part_of_left: f64 = 0.15,
        /// or, where its share is small, this part of what is left,
        most_of_left: f64 = 0.5,
        /// and this share at least: less is what large causes together leave.
        least_small_share: f64 = 0.01,
        /// A cause with that share is named whatever part it takes if it is as likely as this, and all causes take
        /// `least_share` of the arm's gap: on diverse seeds
        /// 36907, 84320 and 80925 all of 39 effects were there that were small and as likely (docs/trial-history.md).
        sure_of_small: f64 = 0.8,
        /// One with less than `least_small_share` is named from this probability on where it takes `least_part_of_left`
        /// and all causes take `explained` of the arm's gap, unless it changes friction or grows with speed, or is a
        /// load or a torque constant, for which masses and friction nearly make up: on diverse seeds up to 14507 all of
        /// 33 that were too small and 0.9 likely were there, on 94483 a load and a torque constant were not, nor, on
        /// geared arms of another engine, eleven peaks of friction and a drag.
        sure_of_faint: f64 = 0.95,
        /// A cause does this part of what goes with it on the confirming logs itself, or `no_gap_ratio` times the noise;
        /// fits with and without it share the rest out differently, by more where parameters can stand in for it.
        least_action: f64 = 0.1,
        /// One that does not is named all the same if it is as likely as this by all that goes with it,
        sure_of_idle: f64 = 0.95,
        /// and that is this share of the gap: on diverse seeds 32038, 14139, 82861 and 56086 all of six as likely were
        /// there, with 0.16 and more of it, while limits of arms that have none took 0.11 at most.
        most_with_idle: f64 = 0.15,
        /// A wave of voltage at the order of one of friction that is named on its joint is left by that where it takes less
        /// than this part of what that one takes. On diverse seed 60777 three that were not there took 0.08 to 0.30.
        most_by_wave: f64 = 0.5,
        /// Half the 95 % interval of a lag or delay is this part of it at most, but for what logs differ by by chance. Of
        /// ten that were there it was 0.13 at most, chance with it; of play that was told as one 0.33 and more without it.
        most_of_time: f64 = 0.2,
        /// Where no log of another motion is held out, half the 95 % interval of the stiffness of a spring between motor and
        /// link is this part of it at most. Of 26 springs and plays that were there it was 0.44 at most, of two narrow
        /// plays told as springs 0.77 and 1.2, on a pendulum that was pushed by hand 0.92.
        most_of_stiffness: f64 = 0.6,
        /// A spring, which can follow noise, is not named where the confirming logs show no gap. Elsewhere it leaves this
        /// part of their noise at least: where something structured comes in half of the pieces that noise is read
        /// off, its power is found 2.6 times too large.
        least_noise: f64 = 0.6,
        /// and this where the gap is far above the noise, which it then hides: a link that rings all the
        /// time is in every piece.
        least_noise_far: f64 = 0.4,
        /// Least probability of an alternative that is listed.
        least_alternative: f64 = 0.02,
        /// A gap without a name of so many times the noise is said to be another robot's, perhaps.
        another_robot_ratio: f64 = 20.0,
        /// A refitted model that leaves a larger part of a command is that of another robot.
        another_robot_part: f64 = 0.2,
        /// A parameter that the refit moved is listed from this share of the squares on,
        least_parameter_share: f64 = 0.02,
        /// and from so many half widths of its interval.
        sure_half_widths: f64 = 1.5,
        /// Squared correlation from which two effects are not told apart.
        alike_correlation: f64 = 0.995,
        /// Most steps of the fit without one of several causes.
        without_cause_steps: usize = 4,
        /// Part of itself by which each end of a share's interval is further out: of twelve intervals of diverse seed 81464
        /// that did not hold seven missed by 2 to 12 % of their end (docs/trial-history.md).
        share_error: f64 = 0.15,
        /// Length of the blocks from which intervals are drawn [s].
        block_s: f64 = 0.5,
        /// They are shorter where what an effect explains lies in fewer blocks than these: one drawing
        /// in exp(8) then misses it,
        differing_blocks: f64 = 8.0,
        /// but not shorter than this, for neighbouring rows say the same [s].
        shortest_block_s: f64 = 0.05,
        /// How often they are drawn.
        draws: usize = 400,
        /// Length of the windows in which the predicted motion drifts [s].
        drift_window_s: f64 = 0.25,
        /// Commands before such a window that fill lags and delays [s].
        drift_before_s: f64 = 0.1,
        /// The sentence mentions the refit where the model as given leaves so many times what it leaves.
        worth_refitting: f64 = 1.5,
    }
}
