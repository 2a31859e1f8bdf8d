//! The most that a tone could explain: one frequency in all train logs, as of a supply that hums.
//!
//! What a hum adds to the command moves the joint, so that command and acceleration are bound at its
//! frequency by one gain and one phase. A delay or a lag makes such a phase, and seems to explain the tone.

use nalgebra::Complex;
use realfft::RealFftPlanner;

use super::ceiling::excess_left_v2;
use super::knots::quantile;
use crate::criteria::SelectionCriteria;
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, Rows};
use signal::rms;

/// Whether an effect (the one at `index` of a model) takes what the strongest tone on its joint takes.
///
/// Only a lag or a delay can fail, and only where most of the joint's gap and most of what the effect takes lie at
/// the tone's frequency: what takes something elsewhere as well is more than a tone.
pub fn reaches_tone(
    subject: &Subject,
    without: &FittedModel,
    with: &FittedModel,
    index: usize,
) -> bool {
    let policy = &subject.criteria.selection;
    let effect = &with.linear.hypothesis.effects[index];
    let Some(joint) = usize::from(effect.joint).checked_sub(1).filter(|_| effect.is_late()) else {
        return true;
    };
    let [before, after] = [without, with].map(|model| excess_left_v2(subject, model, joint));
    let Some([tone, left_of_tone]) = strongest_tone(without, with, joint, policy) else {
        return true;
    };
    let taken = before - after;
    before <= 0.0
        || taken >= policy.least_of_ceiling * tone
        || tone < policy.most_at_tone * before
        || tone - left_of_tone < policy.most_at_tone * taken
}

/// Squares that the strongest tone of a joint takes without an effect, and that the same one takes
/// with it [V^2]; none where no frequency stands out.
fn strongest_tone(
    without: &FittedModel,
    with: &FittedModel,
    joint: usize,
    policy: &SelectionCriteria,
) -> Option<[f64; 2]> {
    let piece_s = policy.tone_piece_s;
    let squares =
        |model: &FittedModel| squares_v2(&model.evidence, &model.left_out_v, joint, piece_s);
    let before = squares(without);
    let place = strongest(&before, &parts_of_motion(&without.evidence, joint, piece_s))?;
    let is_line = before[place] >= policy.tone_above_others * most_of_others(&before);
    is_line.then_some([before[place], *squares(with).get(place)?])
}

/// What 98 % of frequencies stay below: two lines as a window smears them are fewer than the rest [V^2].
fn most_of_others(squares_v2: &[f64]) -> f64 {
    let mut sorted = squares_v2.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    quantile(&sorted, 0.98).unwrap_or(0.0)
}

/// The place of the largest squares that are not of a frequency of the motion itself, one that holds half of
/// it: what a sine of a motion leaves has its frequency. A window smears it over the places about.
fn strongest(squares_v2: &[f64], of_motion: &[f64]) -> Option<usize> {
    const MOST_OF_MOTION: f64 = 0.5;
    let motion: Vec<usize> =
        (0..of_motion.len()).filter(|place| of_motion[*place] >= MOST_OF_MOTION).collect();
    let is_own = |place: &usize| motion.iter().all(|other| other.abs_diff(*place) > FINER);
    let places = (0..squares_v2.len()).filter(is_own);
    places.max_by(|a, b| squares_v2[*a].total_cmp(&squares_v2[*b]))
}

/// The part of a joint's squared velocity that lies at each frequency, as [`squares_v2`] has them.
fn parts_of_motion(evidence: &Evidence, joint: usize, piece_s: f64) -> Vec<f64> {
    let velocity = |s: usize| {
        let signal = &evidence.stretches[s].motion.qd_rad_per_s[joint];
        evidence.filter(joint, s).rows(signal)
    };
    let mut rows = evidence.no_rows();
    rows[joint] = (0..evidence.train_stretches()).flat_map(velocity).collect();
    let whole = rows[joint].len() as f64 * rms(&rows[joint]).powi(2);
    let squares = squares_v2(evidence, &rows, joint, piece_s);
    squares.into_iter().map(|square| square / whole.max(f64::MIN_POSITIVE)).collect()
}

/// Squares that a sine of each frequency takes of a joint's train rows, above those of most
/// frequencies, with an amplitude and a phase for each piece of a log; from 0 in steps of a
/// quarter of a piece's own [V^2].
///
/// None below two periods in a piece: what is that slow is a drift.
fn squares_v2(evidence: &Evidence, rows_v: &Rows, joint: usize, piece_s: f64) -> Vec<f64> {
    let mut sum = Vec::new();
    let ranges = evidence.ranges(joint).into_iter().enumerate();
    for (s, range) in ranges.take(evidence.train_stretches()) {
        let period_s = evidence.filter(joint, s).row_period_s();
        let samples = (piece_s / period_s).round().max(1.0) as usize;
        for piece in pieces(&rows_v[joint][range], samples) {
            add_squares(&mut sum, piece, samples);
        }
    }
    sum.iter_mut().take(2 * FINER).for_each(|square| *square = 0.0);
    above_median(sum)
}

/// A stretch in even pieces of about so many values.
fn pieces(rows: &[f64], samples: usize) -> impl Iterator<Item = &[f64]> {
    let count = ((rows.len() as f64 / samples as f64).round() as usize).max(1);
    rows.chunks(rows.len().div_ceil(count).max(1))
}

/// A piece is transformed as if it were so many times as long.
const FINER: usize = 4;

/// Adds the squares of a piece of about so many `samples`; one below a quarter of that says too little.
fn add_squares(sum: &mut Vec<f64>, piece: &[f64], samples: usize) {
    if 4 * piece.len() < samples || samples < 8 {
        return;
    }
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(FINER * samples);
    let mut input = transform.make_input_vec();
    input[..piece.len()].copy_from_slice(piece);
    let mut spectrum: Vec<Complex<f64>> = transform.make_output_vec();
    if transform.process(&mut input, &mut spectrum).is_err() {
        return;
    }
    spectrum.pop();
    sum.resize(sum.len().max(spectrum.len()), 0.0);
    let scale = 2.0 / piece.len() as f64;
    sum.iter_mut().zip(&spectrum).for_each(|(sum, value)| *sum += scale * value.norm_sqr());
}

/// Squares less their median, which noise takes at any frequency.
fn above_median(mut squares_v2: Vec<f64>) -> Vec<f64> {
    let mut sorted = squares_v2.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let median = quantile(&sorted, 0.5).unwrap_or(0.0);
    squares_v2.iter_mut().for_each(|square| *square = (*square - median).max(0.0));
    squares_v2
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    fn squares(rows: &[f64]) -> Vec<f64> {
        let mut sum = Vec::new();
        pieces(rows, 1000).for_each(|piece| add_squares(&mut sum, piece, 1000));
        above_median(sum)
    }

    fn sine(amplitude: f64, periods: f64, count: usize) -> Vec<f64> {
        (0..count).map(|k| amplitude * (TAU * periods * k as f64 / 1000.0 + 0.4).sin()).collect()
    }

    fn whole(rows: &[f64]) -> f64 {
        rows.iter().map(|v| v * v).sum()
    }

    #[test]
    fn a_sine_takes_its_own_squares_wherever_its_frequency_lies() {
        for (periods, count) in [(40.0, 1000), (40.13, 2440), (7.4, 800), (40.0, 300)] {
            let rows = sine(0.3, periods, count);
            let squares = squares(&rows);
            let place = strongest(&squares, &[]).unwrap();
            assert!((place as f64 / FINER as f64 - periods).abs() < 0.3, "{periods}: {place}");
            assert!((squares[place] / whole(&rows) - 1.0).abs() < 0.08, "{periods}");
        }
        assert!(squares(&sine(0.3, 40.0, 200)).is_empty());
    }

    #[test]
    fn the_strongest_of_noise_is_no_line() {
        let line = |amplitude: f64, seed: u128| {
            let mut random = Pcg64Mcg::new(seed);
            let mut noise = |v: &f64| -> f64 {
                let drawn: f64 = StandardNormal.sample(&mut random);
                v + drawn
            };
            let rows: Vec<f64> = sine(amplitude, 40.0, 8000).iter().map(&mut noise).collect();
            let squares = squares(&rows);
            squares[strongest(&squares, &[]).unwrap()] / most_of_others(&squares)
        };
        let above = SelectionCriteria::default().tone_above_others;
        for seed in 0..20 {
            assert!(line(0.0, seed) < above / 1.5, "{seed}: {}", line(0.0, seed));
            assert!(line(0.3, seed) > 1.5 * above, "{seed}: {}", line(0.3, seed));
        }
    }

    #[test]
    fn what_the_motion_is_made_of_is_no_tone() {
        let left: Vec<f64> =
            sine(0.3, 5.0, 2000).iter().zip(sine(0.1, 90.0, 2000)).map(|(a, b)| a + b).collect();
        assert_eq!(strongest(&squares(&left), &[]), Some(5 * FINER));
        let velocity = sine(2.0, 5.1, 2000);
        let of_motion: Vec<f64> =
            squares(&velocity).into_iter().map(|square| square / whole(&velocity)).collect();
        assert_eq!(strongest(&squares(&left), &of_motion), Some(90 * FINER));
    }
}
