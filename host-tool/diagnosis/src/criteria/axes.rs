//! Thresholds of what the gap varies with.

use super::table::criteria;

criteria! {
    /// What the gap varies with: which axes are named, and with which words.
    AxisCriteria {
        /// Shares of the gap below this are left out.
        least_share: f64 = 0.02,
        /// Fewest samples of a joint.
        fewest_samples: usize = 100,
        /// Most axes that are taken off one joint's gap, one after the other.
        most_axes: usize = 5,
        /// Folds of the cross-validation.
        folds: usize = 5,
        /// Longest pieces that are left out together [s].
        longest_piece_s: f64 = 2.5,
        /// Fewest pieces in all logs.
        fewest_pieces: f64 = 15.0,
        /// A noise floor is known no better than to this part of its square.
        floor_uncertainty: f64 = 0.05,
        /// Below this part of the rms velocity a joint counts as turning around.
        standstill_part: f64 = 0.02,
        /// A shape is named if it explains this part of a fitted function's square.
        clear_part: f64 = 0.8,
        /// A function that vanishes with its variable is preferred if it gains this part of what it
        /// gains beside a constant.
        without_constant_part: f64 = 0.95,
        /// A constant in each log must gain so many times what a common one gains.
        each_log_ratio: f64 = 1.4,
        /// Even and odd parts over velocity are fitted together if the weaker gains this part of the
        /// stronger.
        both_parities_part: f64 = 0.1,
        /// Limits of the command that are tried.
        command_limits: usize = 40,
        /// Most samples beyond a limit, in parts of all.
        most_beyond_limit: f64 = 0.4,
        /// Highest order per revolution that is looked for.
        highest_order: usize = 100,
        /// The lowest order goes through so many periods in the range of the angle.
        least_periods: f64 = 1.5,
        /// Most orders that are named.
        most_orders: usize = 4,
        /// An order explains at least this part of the excess.
        least_order_part: f64 = 0.02,
        /// Orders, or what is slow over the angle, are named from this part of both together on.
        named_angle_part: f64 = 0.25,
        /// A carrier of orders must gain so many times what none gains.
        carrier_ratio: f64 = 1.3,
        /// Length of the segments of the spectrum [s].
        segment_s: f64 = 4.0,
        /// Longest segment [samples].
        longest_segment: usize = 8192,
        /// The band of the motion ends where this part of the velocity's power lies below.
        motion_part: f64 = 0.99,
        /// Most lines of the spectrum that are named.
        most_lines: usize = 4,
        /// A line has so many times the median density about it.
        line_ratio: f64 = 10.0,
        /// In the band of the motion it must stand out so many times more than the motion does.
        line_over_motion: f64 = 5.0,
        /// Lines and bands below this part of all of them are not named.
        least_line_part: f64 = 0.15,
        /// A band wider than this part of all frequencies is none.
        widest_band_part: f64 = 0.7,
        /// A band in that of the motion counts only where other axes explain less than this part.
        explained_elsewhere: f64 = 0.3,
    }
}
