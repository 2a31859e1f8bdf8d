//! What is constant.

use super::fit::{Design, Fit};
use super::found::Found;
use super::samples::Samples;
use crate::quantity::volts;
use crate::result::Axis;

/// A constant over all logs, or one for each.
pub(super) fn find(samples: &Samples) -> Option<Found> {
    let logs = samples.log.iter().max()? + 1;
    let design = Design::of(samples.len(), 1 + logs, |k, row| {
        row.extend([(0, 1.0), (1 + samples.log[k], 1.0)]);
    });
    let fit = Fit::of(&design, &samples.residual_v, &samples.fold);
    let each: Vec<usize> = (1..=logs).collect();
    let (common_v2, each_v2) = (fit.gain(&[], &[0]), fit.gain(&[], &each));
    if logs > 1 && each_v2 > samples.criteria.each_log_ratio * common_v2 {
        let levels = fit.coefficients(&each);
        let used = |log: &usize| samples.log.contains(log);
        let of_logs: Vec<f64> = (0..logs).filter(used).map(|log| levels[1 + log]).collect();
        let low = of_logs.iter().copied().fold(f64::INFINITY, f64::min);
        let high = of_logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let detail = format!("constant in each log, from {} to {}", volts(low), volts(high));
        let fitted_v = design.times(&levels);
        return Some(Found { axis: Axis::Offset, energy_v2: each_v2, detail, fitted_v });
    }
    let level = fit.coefficients(&[0]);
    let detail = format!("constant, {}", volts(level[0]));
    let fitted_v = design.times(&level);
    Some(Found { axis: Axis::Offset, energy_v2: common_v2, detail, fitted_v })
}
