//! Stretches of a log in which no sample is missing.

use std::ops::Range;

/// Ranges of samples whose neighbours are at most `longest_gap_s` apart.
pub fn unbroken(time_s: &[f64], longest_gap_s: f64) -> Vec<Range<usize>> {
    let mut ranges = Vec::new();
    let mut begin = 0;
    for k in 1..=time_s.len() {
        if k == time_s.len() || time_s[k] - time_s[k - 1] > longest_gap_s {
            ranges.push(begin..k);
            begin = k;
        }
    }
    ranges
}
