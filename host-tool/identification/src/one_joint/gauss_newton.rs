//! The Gauss-Newton equations of a likelihood of innovations, in blocks of time.

use nalgebra::{DMatrix, DVector};

use super::dynamics::MAX_PARAMETERS;
use super::noise::Innovation;
use super::sandwich;

/// Sums of J'J / S and J' innovation / S, block by block.
#[derive(Clone, Debug)]
pub struct GaussNewton {
    hessian: [[f64; MAX_PARAMETERS]; MAX_PARAMETERS],
    score: [f64; MAX_PARAMETERS],
    count: usize,
    blocks: Vec<(DMatrix<f64>, DVector<f64>)>,
}

impl GaussNewton {
    /// No equations for `count` parameters.
    pub fn new(count: usize) -> Self {
        let hessian = [[0.0; MAX_PARAMETERS]; MAX_PARAMETERS];
        Self { hessian, score: [0.0; MAX_PARAMETERS], count, blocks: Vec::new() }
    }

    /// Adds an innovation with the predicted angle's derivatives by the parameters.
    pub fn add(&mut self, derivatives: &[f64], innovation: &Innovation) {
        for (m, derivative) in derivatives.iter().enumerate() {
            let weighted = derivative / innovation.variance_rad2;
            self.score[m] += weighted * innovation.value_rad;
            for n in 0..=m {
                self.hessian[m][n] += weighted * derivatives[n];
            }
        }
    }

    /// Ends a block; the next one begins empty.
    pub fn end_block(&mut self) {
        let symmetric = |m: usize, n: usize| self.hessian[m.max(n)][m.min(n)];
        let hessian = DMatrix::from_fn(self.count, self.count, symmetric);
        let score = DVector::from_column_slice(&self.score[..self.count]);
        let blocks = std::mem::take(&mut self.blocks);
        *self = Self::new(self.count);
        self.blocks = blocks;
        self.blocks.push((hessian, score));
    }

    fn total(&self) -> (DMatrix<f64>, DVector<f64>) {
        let empty = (DMatrix::zeros(self.count, self.count), DVector::zeros(self.count));
        self.blocks.iter().fold(empty, |(h, g), (hessian, score)| (h + hessian, g + score))
    }

    /// The step of the parameters; `None` where they are not determined.
    pub fn step(&self) -> Option<DVector<f64>> {
        let (hessian, score) = self.total();
        Some(sandwich::scaled_inverse(&hessian, &hessian)? * score)
    }

    /// Covariance of the parameters by leaving out blocks in turn.
    pub fn covariance(&self) -> DMatrix<f64> {
        sandwich::jackknife(&self.total().0, self.blocks.iter().cloned())
    }
}
