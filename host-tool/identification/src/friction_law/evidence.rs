//! What a law of friction leaves of logs that it was not fitted to.

use model::Robot;
use rayon::prelude::*;
use serde::Serialize;

use super::halves::Fold;
use crate::base_parameters::FrictionEstimate;
use crate::reconstruction::reconstruct;
use crate::refinement::{self, refine};
use recordings::campaign::{Known, Trace};

/// Squares this far apart are independent, as the refinement takes them to be [s].
const BLOCK_S: f64 = 0.25;

/// How much better LuGre's law predicts a joint than static friction does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Evidence {
    /// What static friction leaves of the command that it was not fitted to, rms [V].
    #[serde(rename = "static_left_V")]
    pub static_left_v: f64,
    /// What LuGre's law leaves of it, rms [V].
    #[serde(rename = "lugre_left_V")]
    pub lugre_left_v: f64,
    /// Sum of the relative gains in squares, block by block, over the root of the sum of their
    /// squares.
    pub certainty: f64,
}

impl Evidence {
    /// From the squares that each law leaves, block by block; `None` without any.
    pub(super) fn of(lugre: &[Block], still: &[Block]) -> Option<Self> {
        let gain = |(lugre, still): (&Block, &Block)| {
            (still.sum_v2 - lugre.sum_v2) / (still.sum_v2 + lugre.sum_v2)
        };
        let gains = lugre.iter().zip(still).map(gain);
        let gains: Vec<f64> = gains.filter(|gain| gain.is_finite()).collect();
        let spread = gains.iter().map(|d| d * d).sum::<f64>().sqrt();
        let certainty = gains.iter().sum::<f64>() / spread;
        let (static_left_v, lugre_left_v) = (rms_v(still), rms_v(lugre));
        certainty.is_finite().then_some(Self { static_left_v, lugre_left_v, certainty })
    }

    /// The figures in words.
    pub fn words(&self) -> String {
        format!(
            "of what neither was fitted to, static friction leaves {:.1} mV and LuGre {:.1} mV, \
             certainty {:.1}",
            1e3 * self.static_left_v,
            1e3 * self.lugre_left_v,
            self.certainty
        )
    }
}

/// The squares of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Block {
    pub sum_v2: f64,
    pub rows: usize,
}

fn rms_v(blocks: &[Block]) -> f64 {
    let rows: usize = blocks.iter().map(|block| block.rows).sum();
    (blocks.iter().map(|block| block.sum_v2).sum::<f64>() / rows.max(1) as f64).sqrt()
}

/// A model fitted to one part, and what it leaves of the other, joint by joint.
pub(super) struct Fitted {
    pub robot: Robot<f64>,
    pub left: [Vec<Block>; 3],
}

/// Refines friction on each fold and predicts the other part; `None` where that cannot be done.
pub(super) fn carried_by(
    folds: &[Fold],
    known: &Known,
    friction: &[FrictionEstimate; 3],
) -> Option<Vec<Fitted>> {
    let one = |fold: &Fold| {
        let robot = fitted(&fold.fitted, known, friction)?;
        let left = left_by(&robot, &fold.predicted)?;
        Some(Fitted { robot, left })
    };
    folds.par_iter().map(one).collect()
}

fn fitted(traces: &[Trace], known: &Known, friction: &[FrictionEstimate; 3]) -> Option<Robot<f64>> {
    let traces: Vec<&Trace> = traces.iter().collect();
    let found = refine(&traces, known, friction, &refinement::Settings::default()).ok()?;
    Some(Robot {
        geometry: known.geometry?,
        base: found.base,
        torque_constant_nm_per_v: [1, 2, 3].map(|joint| known.torque_constant(joint)),
        friction: found.friction,
    })
}

/// The squares that a model leaves of each joint's command, block by block.
pub(super) fn left_by(robot: &Robot<f64>, traces: &[Trace]) -> Option<[Vec<Block>; 3]> {
    let settings = refinement::Settings::default().rows;
    let rows = (BLOCK_S / settings.row_period_s).round().max(1.0) as usize;
    let mut left = [Vec::new(), Vec::new(), Vec::new()];
    for trace in traces {
        for stretch in reconstruct(trace, robot, &settings).ok()? {
            for (blocks, joint) in left.iter_mut().zip(&stretch.joints) {
                let both = joint.measured_v.iter().zip(&joint.reconstructed_v);
                let squares: Vec<f64> = both.map(|(a, b)| (a - b).powi(2)).collect();
                let block = |rows: &[f64]| Block { sum_v2: rows.iter().sum(), rows: rows.len() };
                blocks.extend(squares.chunks(rows).map(block));
            }
        }
    }
    Some(left)
}

/// The blocks of a joint (0 to 2) over all folds.
pub(super) fn blocks_of(fitted: &[Fitted], joint: usize) -> Vec<Block> {
    fitted.iter().flat_map(|fitted| fitted.left[joint].iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blocks(squares: impl Iterator<Item = f64>) -> Vec<Block> {
        squares.map(|sum_v2| Block { sum_v2, rows: 25 }).collect()
    }

    #[test]
    fn a_gain_in_every_block_is_certain_and_one_by_turns_is_none() {
        let lugre = blocks((0..100).map(|_| 1.0));
        let worse = blocks((0..100).map(|_| 1.5));
        let evidence = Evidence::of(&lugre, &worse).unwrap();
        assert!((evidence.certainty - 10.0).abs() < 1e-9);
        let by_turns = blocks((0..100).map(|k| if k % 2 == 0 { 1.25 } else { 0.8 }));
        assert!(Evidence::of(&lugre, &by_turns).unwrap().certainty.abs() < 1e-9);
    }

    #[test]
    fn one_block_alone_is_never_certain() {
        let lugre = blocks([1.0; 40].into_iter());
        let mut still = lugre.clone();
        still[7].sum_v2 = 1000.0;
        let evidence = Evidence::of(&lugre, &still).unwrap();
        assert!(evidence.certainty < super::super::certainty::CERTAIN);
        assert!(Evidence::of(&lugre, &lugre).is_none());
    }
}
