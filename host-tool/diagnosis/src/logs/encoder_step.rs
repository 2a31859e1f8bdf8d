//! The encoder's step where no file tells it: the smallest step that the angles make.

use crate::criteria::LogCriteria;
use recordings::Trace;

/// The smallest step that any of these joints' angles make; none where nothing moves.
pub fn smallest(traces: &[Trace], numbers: &[u8], criteria: &LogCriteria) -> Option<f64> {
    let columns = traces.iter().flat_map(|trace| &trace.joints);
    let columns = columns.filter(|joint| numbers.contains(&joint.number));
    let steps = columns.filter_map(|joint| smallest_step(&joint.q_rad, criteria.rounding_part));
    steps.min_by(f64::total_cmp)
}

/// The smallest step from sample to sample that is no rounding, of the median step; `None` where nothing moves.
fn smallest_step(q_rad: &[f64], rounding_part: f64) -> Option<f64> {
    let steps = q_rad.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let mut steps: Vec<f64> = steps.filter(|&step| step > 1e-12 && step.is_finite()).collect();
    let middle = steps.len() / 2;
    if steps.is_empty() {
        return None;
    }
    let usual = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    steps.into_iter().filter(|&step| step > rounding_part * usual).min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coarse_encoder_shows_its_step() {
        let step = std::f64::consts::TAU / 4096.0;
        let rounded = |k: u32| {
            ((2.0 * (0.02 * f64::from(k)).sin() / step).round() * step * 1e8).round() / 1e8
        };
        let q: Vec<f64> = (0..2000).map(rounded).collect();
        assert!((smallest_step(&q, 1e-3).unwrap() / step - 1.0).abs() < 1e-4);
        assert_eq!(smallest_step(&[0.5; 9], 1e-3), None);
    }
}
