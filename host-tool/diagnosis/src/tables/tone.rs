//! The most that a tone could explain: one frequency in all train logs, as of a supply that hums.
//!
//! A command that holds one frequency above what the model needs, and moves the joint with it, is
//! bound to the joint's acceleration at that frequency by one gain and one phase. A delay or a lag
//! makes such a phase, so that it seems to explain the tone.

use nalgebra::Complex;
use realfft::RealFftPlanner;

use super::ceiling::{excess_left_v2, part_taken};
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, Rows};
use signal::rms;

/// Whether an effect (the one at `index` of a model) takes what a tone on its joint takes, or pays
/// beside that tone.
pub fn reaches_tone(
    subject: &Subject,
    without: &FittedModel,
    with: &FittedModel,
    index: usize,
) -> bool {
    let policy = &subject.criteria.selection;
    let effect = &with.linear.hypothesis.effects[index];
    let Some(joint) = usize::from(effect.joint).checked_sub(1) else { return true };
    let piece_s = policy.tone_piece_s;
    let squares =
        |model: &FittedModel| squares_v2(&model.evidence, &model.left_out_v, joint, piece_s);
    let before = squares(without);
    let Some(tone) = strongest(&before, &squares_of_motion(&without.evidence, joint, piece_s))
    else {
        return true;
    };
    let left = [without, with].map(|model| excess_left_v2(subject, model, joint));
    let by_tone = before[tone] / left[0].max(f64::MIN_POSITIVE);
    let beside = [left[0] - before[tone], left[1] - squares(with)[tone]];
    part_taken(subject, without, with, joint) >= policy.least_of_ceiling * by_tone
        || beside[0] - beside[1] > policy.least_beside_table * beside[0].max(0.0)
}

/// The frequency, by its place, of the largest squares that is not most of the motion itself: what a
/// sine of a motion leaves has its frequency.
fn strongest(squares_v2: &[f64], of_motion: &[f64]) -> Option<usize> {
    const MOST_OF_MOTION: f64 = 0.5;
    let is_own = |place: &usize| of_motion.get(*place).is_none_or(|part| *part < MOST_OF_MOTION);
    let places = (0..squares_v2.len()).filter(is_own);
    places.max_by(|a, b| squares_v2[*a].total_cmp(&squares_v2[*b]))
}

/// The part of a joint's squared velocity that lies at each frequency, as [`squares_v2`] has them.
fn squares_of_motion(evidence: &Evidence, joint: usize, piece_s: f64) -> Vec<f64> {
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

/// Squares that a sine of each frequency takes of a joint's train rows, with an amplitude and a
/// phase for each piece of a log; from 0 in steps of a quarter of a piece's own [V^2].
///
/// None below two periods in a piece: what is that slow is a drift.
fn squares_v2(evidence: &Evidence, rows_v: &Rows, joint: usize, piece_s: f64) -> Vec<f64> {
    let mut sum = Vec::new();
    let ranges = evidence.ranges(joint).into_iter().enumerate();
    for (s, range) in ranges.take(evidence.train_stretches()) {
        let period_s = evidence.filter(joint, s).row_period_s();
        let samples = (piece_s / period_s).round().max(1.0) as usize;
        for piece in rows_v[joint][range].chunks(samples) {
            add_squares(&mut sum, piece, samples);
        }
    }
    sum.iter_mut().take(2 * FINER).for_each(|square| *square = 0.0);
    sum
}

/// A piece is transformed as if it were so many times as long.
const FINER: usize = 4;

/// Adds the squares of a piece, of at most `samples` values; a short rest says too little.
fn add_squares(sum: &mut Vec<f64>, piece: &[f64], samples: usize) {
    if 2 * piece.len() < samples || samples < 8 {
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

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn squares(piece: &[f64]) -> Vec<f64> {
        let mut sum = Vec::new();
        add_squares(&mut sum, piece, 1000);
        sum
    }

    fn sine(amplitude: f64, periods: f64, count: usize) -> Vec<f64> {
        (0..count).map(|k| amplitude * (TAU * periods * k as f64 / 1000.0 + 0.4).sin()).collect()
    }

    #[test]
    fn a_sine_takes_its_own_squares_wherever_its_frequency_lies() {
        for (periods, count) in [(40.0, 1000), (40.13, 1000), (7.4, 800)] {
            let piece = sine(0.3, periods, count);
            let squares = squares(&piece);
            let whole: f64 = piece.iter().map(|v| v * v).sum();
            let place = strongest(&squares, &[]).unwrap();
            assert!((place as f64 / FINER as f64 - periods).abs() < 0.2, "{periods}: {place}");
            assert!((squares[place] / whole - 1.0).abs() < 0.07, "{periods}");
        }
        assert!(squares(&sine(0.3, 40.0, 400)).is_empty());
    }

    #[test]
    fn what_the_motion_is_made_of_is_no_tone() {
        let left = squares(&sine(0.3, 5.0, 1000));
        let mut of_motion = vec![0.0; left.len()];
        let place = strongest(&left, &of_motion).unwrap();
        assert_eq!(place, 5 * FINER);
        of_motion[place - 2..=place + 2].fill(0.9);
        assert_ne!(strongest(&left, &of_motion), Some(place));
    }
}
