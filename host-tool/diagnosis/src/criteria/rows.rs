//! Thresholds of rows and noise.

use super::table::criteria;

criteria! {
    /// Rows and the noise in them.
    RowCriteria {
        /// Rows per second of motion without broadband commands.
        calm_rows_per_s: f64 = 200.0,
        /// Rows per second under broadband commands.
        broadband_rows_per_s: f64 = 500.0,
        /// Cut-off of the rows' low-pass in parts of their rate.
        cutoff_part: f64 = 0.3,
        /// What the ends of a stretch lose [s].
        margin_s: f64 = 0.25,
        /// Lowest corner of the filter that makes rows white [Hz].
        lowest_corner_hz: f64 = 2.0,
        /// Highest, in parts of the sampling rate.
        highest_corner_part: f64 = 0.4,
        /// Part of a command too fast for the sampling that is not accounted for, per second between
        /// samples: how the joint moves meanwhile is not known, nor what its friction does.
        between_samples_per_s: f64 = 10.0,
        /// The square of a row counts half where, after a step of the command, bristles may feel so many times its noise between
        /// two samples: a row averages that down to a sixth. At three a delay of 1.8 ms was taken for a lag.
        kick_over_noise: f64 = 6.0,
        /// A joint that would lose more than this part of a log to such steps keeps all of its rows there.
        most_kicked_part: f64 = 0.5,
        /// Length of the pieces in which noise is looked for [s].
        noise_piece_s: f64 = 0.4,
        /// Fewest such pieces.
        fewest_noise_pieces: usize = 8,
        /// Lowest frequency at which noise is looked for [Hz].
        lowest_noise_hz: f64 = 7.0,
        /// Highest, in parts of the sampling rate.
        highest_noise_part: f64 = 0.2,
        /// A frequency with so many times the power of noise carries a hum.
        hum_ratio: f64 = 3.0,
        /// Speeds at which the size of what a model leaves may change, in parts of the rows below
        /// them: friction is worst known around standstill.
        speed_classes: [f64; 4] = [0.04, 0.1, 0.25, 0.6],
        /// A class of a log takes its size from so many rows of the whole log too.
        pooled_rows: f64 = 30.0,
        /// Most rows of a log that say something of their own about what is systematic: a law of friction that
        /// is not the machine's is wrong alike in every swing, and a log has some hundred.
        most_systematic_rows: f64 = 200.0,
        /// Fewest rows of a log that count as independent.
        fewest_independent_rows: usize = 20,
        /// Sample periods that differ by a smaller part are one rate.
        same_rate_part: f64 = 0.05,
    }
}

impl RowCriteria {
    /// How far the low-pass of rows reaches to either side [s].
    pub fn reach_s(&self, broadband: bool) -> f64 {
        let rows_per_s = if broadband { self.broadband_rows_per_s } else { self.calm_rows_per_s };
        0.5 / (self.cutoff_part * rows_per_s)
    }
}
