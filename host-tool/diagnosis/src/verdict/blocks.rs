//! Squares of the confirming rows block by block, and intervals by drawing blocks again.

use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;

use crate::rows::evidence::{Evidence, Rows};
use files::Role;

/// Blocks of the confirming rows of some joints: what each of several models leaves of them, and
/// noise last [V^2].
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks(Vec<Vec<f64>>);

impl Blocks {
    /// Of what models leave [V], and of noise, rms in a stretch by joint [V].
    pub fn of(
        evidence: &Evidence,
        joints: &[usize],
        models: &[&Rows],
        noise_v: impl Fn(usize, usize) -> f64,
    ) -> Self {
        Self::in_units(evidence, joints, models, noise_v, |_| 1.0)
    }

    /// The same with each joint in a unit of its own [V].
    ///
    /// What an effect explains may lie in a second of the logs, a command at its limit say. Blocks are
    /// as short as it takes to have what the first two models differ by in several of them, for blocks
    /// drawn again would miss it else.
    pub fn in_units(
        evidence: &Evidence,
        joints: &[usize],
        models: &[&Rows],
        noise_v: impl Fn(usize, usize) -> f64,
        unit_v: impl Fn(usize) -> f64,
    ) -> Self {
        let criteria = &evidence.criteria.verdict;
        let mut block_s = criteria.block_s;
        let mut blocks = Self::as_long_as(block_s, evidence, joints, models, (&noise_v, &unit_v));
        while blocks.differing() < criteria.differing_blocks && block_s > criteria.shortest_block_s
        {
            block_s *= 0.5;
            blocks = Self::as_long_as(block_s, evidence, joints, models, (&noise_v, &unit_v));
        }
        blocks
    }

    fn as_long_as(
        block_s: f64,
        evidence: &Evidence,
        joints: &[usize],
        models: &[&Rows],
        (noise_v, unit_v): (&impl Fn(usize, usize) -> f64, &impl Fn(usize) -> f64),
    ) -> Self {
        let mut blocks = Vec::new();
        for &joint in joints {
            let per_unit = unit_v(joint).powi(-2);
            for (s, range) in evidence.ranges(joint).into_iter().enumerate() {
                if evidence.stretches[s].role != Role::Holdout {
                    continue;
                }
                let length = block_rows(block_s, evidence, joint, s);
                let starts = range.clone().step_by(length);
                blocks.extend(starts.map(|start| {
                    let rows = start..(start + length).min(range.end);
                    let square = |rows: &[f64]| rows.iter().map(|row| row * row).sum::<f64>();
                    let left = models.iter().map(|model| square(&model[joint][rows.clone()]));
                    let in_stretch = rows.start - range.start..rows.end - range.start;
                    let used = evidence.used_between(joint, s, in_stretch) as f64;
                    let noise_v2 = used * noise_v(joint, s).powi(2);
                    left.chain([noise_v2]).map(|v2| v2 * per_unit).collect()
                }));
            }
        }
        Self(blocks)
    }

    /// Of squares made by hand.
    #[cfg(test)]
    pub fn made(squares_v2: Vec<Vec<f64>>) -> Self {
        Self(squares_v2)
    }

    /// In how many blocks the first two models differ: (sum d)^2 / sum d^2.
    fn differing(&self) -> f64 {
        let difference = |block: &Vec<f64>| match block[..] {
            [first, second, _, ..] => (first - second).abs(),
            _ => 1.0,
        };
        let sum: f64 = self.0.iter().map(difference).sum();
        let squares: f64 = self.0.iter().map(|block| difference(block).powi(2)).sum();
        if squares > 0.0 { sum * sum / squares } else { f64::INFINITY }
    }

    /// A figure of the summed squares, with its 95 % interval.
    pub fn figure(&self, draws: usize, figure: impl Fn(&[f64]) -> f64) -> (f64, [f64; 2]) {
        let value = figure(&self.sum(0..self.0.len()));
        let Ok(any) = Uniform::new(0, self.0.len()) else { return (0.0, [0.0; 2]) };
        let mut random = Pcg64Mcg::new(1);
        let mut drawn: Vec<f64> = (0..draws)
            .map(|_| figure(&self.sum((0..self.0.len()).map(|_| any.sample(&mut random)))))
            .collect();
        drawn.sort_by(f64::total_cmp);
        let quantile = |part: f64| drawn[(part * (draws - 1) as f64).round() as usize];
        (value, [quantile(0.025), quantile(0.975)])
    }

    fn sum(&self, indices: impl Iterator<Item = usize>) -> Vec<f64> {
        let columns = self.0.first().map_or(0, Vec::len);
        indices.fold(vec![0.0; columns], |mut sum, index| {
            sum.iter_mut().zip(&self.0[index]).for_each(|(sum, square)| *sum += square);
            sum
        })
    }
}

fn block_rows(block_s: f64, evidence: &Evidence, joint: usize, s: usize) -> usize {
    let row_period_s = evidence.filter(joint, s).row_period_s();
    (block_s / row_period_s).ceil().max(1.0) as usize
}

/// Root mean square of each joint's confirming rows [V].
pub fn confirming_rms_v(evidence: &Evidence, residual_v: &Rows) -> Vec<f64> {
    let rms = |&joint: &usize| {
        let ranges = evidence.ranges(joint).into_iter().enumerate();
        let (mut square_v2, mut count) = (0.0, 0);
        for (s, range) in ranges.filter(|(s, _)| evidence.stretches[*s].role == Role::Holdout) {
            square_v2 += residual_v[joint][range].iter().map(|row| row * row).sum::<f64>();
            count += evidence.used_rows(joint, s);
        }
        (square_v2 / count.max(1) as f64).sqrt()
    };
    evidence.joints.iter().map(rms).collect()
}
