//! Thresholds of what is used of the logs.

use super::table::criteria;

criteria! {
    /// Which logs are used, and how their motion is smoothed.
    LogCriteria {
        /// Other joints of an arm stand still if they move by less [rad].
        still_rad: f64 = 0.05,
        /// A log with a larger part of its commands at the limit is left out.
        most_at_limit: f64 = 0.5,
        /// A command within so many of its steps of the limit is at the limit.
        limit_steps: f64 = 1.5,
        /// An encoder that never changes is stuck where commands span so many times the friction
        /// of both directions.
        stuck_encoder_ratio: f64 = 1.5,
        /// Encoder steps below this part of the median step are rounding of the file.
        rounding_part: f64 = 1e-3,
        /// A jump is the wrap of an encoder if it is this close to a whole turn [rad].
        wrap_tolerance_rad: f64 = 0.5,
        /// A position is wrong that is off by so many encoder steps at least.
        least_wrong_steps: f64 = 4.0,
        /// Samples that miss an even clock by less than this part of a period count as even.
        even_part: f64 = 0.02,
        /// Samples were taken by an even clock, whatever their times say, if the motion is rough
        /// over that clock by less than this part of what it is over the times, for most joints;
        smoother_part: f64 = 0.7,
        /// such a clock keeps its rate for so long [s].
        clock_wander_s: f64 = 2.5,
        /// Angles of so many samples, the slowest, show how rough they are without jitter of the clock,
        slow_part: f64 = 0.3,
        /// and those above this part what it adds;
        fast_speeds_part: f64 = 0.6,
        /// where it adds less than this part of the former, the clock does not jitter.
        least_rough_growth: f64 = 0.5,
        /// Samples further apart than so many periods lack one between them. Under driven noise what
        /// was put out then is not known, and rows near by have no weight,
        missing_sample_periods: f64 = 1.6,
        /// unless filling it adds less than this part of Coulomb friction to the rows;
        most_bridged_part: f64 = 0.05,
        /// where fewer than this part of the rows would keep a weight, it ends the stretch.
        least_seen_part: f64 = 0.3,
        /// Gaps of fewer periods are filled; rows near longer ones have no weight,
        longest_gap_periods: f64 = 10.0,
        /// and those that are longer still end a stretch [s].
        longest_gap_s: f64 = 0.03,
        /// Shortest stretch that is used [s].
        shortest_s: f64 = 1.5,
        /// Part of each log that is held out where no log is.
        held_out_part: f64 = 0.3,
        /// Shortest stretch of which a part can be held out [s].
        shortest_to_part_s: f64 = 6.0,
        /// A remark is made where less than this part of a log can be used.
        remark_below_part: f64 = 0.9,
        /// Samples of faster logs are taken together up to this period [s] under broadband commands,
        shortest_period_s: f64 = 1e-3,
        /// up to this one without: rows see nothing above 60 Hz then,
        shortest_calm_period_s: f64 = 2e-3,
        /// angles behind a low-pass with its cut-off at this part of the slower rate.
        thinned_cutoff_part: f64 = 0.4,
        /// What is faster than this part of the sampling rate is hardly seen from sample to sample.
        fast_part: f64 = 0.2,
        /// A command is broadband if enough of it lies above this frequency [Hz].
        broadband_above_hz: f64 = 50.0,
        /// Enough of it: this part of its rms.
        broadband_part: f64 = 0.05,
        /// Highest cut-off of angles where they enter products and friction [Hz]: what encoder steps
        /// add to the velocity blurs friction around reversals.
        calm_cutoff_hz: f64 = 90.0,
        /// The same under broadband commands, where what a filter takes away is missed [Hz].
        broadband_cutoff_hz: f64 = 200.0,
        /// Lowest such cut-off [Hz].
        lowest_cutoff_hz: f64 = 8.0,
        /// The cut-off keeps what encoder steps add to the velocity to this part of it.
        velocity_noise_part: f64 = 0.01,
        /// A joint stands while its smoothed angle wavers by less than this part of what encoder steps add to that,
        /// rms: bristles relax with |v|, of which noise has some at rest. More delays every reversal.
        at_rest_part: f64 = 0.35,
        /// Rows count from where a joint has moved by so many times the largest bend of its bristles:
        /// its friction no longer depends on how they were bent before.
        settled_bends: f64 = 5.0,
        /// Commands are those of the instants of their rows where joints seem to be driven early by more than this part
        /// of a sample period: three deviations of what is known of it;
        least_early_part: f64 = 0.15,
        /// and the middle one by less than this: half of one, and what the friction of some machines adds;
        most_early_part: f64 = 0.7,
        /// that is, this part of the joints whose lag the logs tell.
        early_joints: f64 = 0.8,
    }
}
