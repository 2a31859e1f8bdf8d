//! Covariances that hold for residuals that are not white.
//!
//! The ordinary covariance counts every sample as new information. Residuals of
//! filtered signals repeat themselves, and so do those of an imperfect model: the
//! covariance between them is counted here block by block (a sandwich of batch means).

use nalgebra::{DMatrix, DVector};

/// Covariance of least-squares parameters when residuals correlate in time.
///
/// `unit_covariance` is (Phi^T Phi)^-1, `blocks` lists ranges of rows that belong
/// together: the scores Phi^T r are summed within a block and taken to be independent
/// from block to block. Blocks must be longer than the residuals' memory, and many more
/// than the parameters; the small-sample factor B / (B - 1) is applied.
pub fn clustered_covariance(
    rows: &DMatrix<f64>,
    residuals: &DVector<f64>,
    unit_covariance: &DMatrix<f64>,
    blocks: &[Vec<usize>],
) -> DMatrix<f64> {
    let number = blocks.len() as f64;
    let scores = score_covariance(rows, residuals, blocks);
    unit_covariance * scores * unit_covariance * (number / (number - 1.0).max(1.0))
}

/// Covariance of the scores Phi^T r, summed within each block of rows and independent
/// from block to block: the middle factor of a sandwich covariance, between two
/// (Phi^T Phi)^-1.
pub fn score_covariance(
    rows: &DMatrix<f64>,
    residuals: &DVector<f64>,
    blocks: &[Vec<usize>],
) -> DMatrix<f64> {
    let count = rows.ncols();
    let mut covariance = DMatrix::<f64>::zeros(count, count);
    for block in blocks {
        let mut score = DVector::<f64>::zeros(count);
        for &index in block {
            score.axpy(residuals[index], &rows.row(index).transpose(), 1.0);
        }
        covariance.ger(1.0, &score, &score, 1.0);
    }
    covariance
}

/// How many samples carry as much information as `residuals` do, from their own
/// autocorrelation up to the lag where it first falls below zero.
pub fn effective_samples(residuals: &[f64]) -> f64 {
    let power: f64 = residuals.iter().map(|r| r * r).sum();
    if power <= 0.0 {
        return residuals.len() as f64;
    }
    let correlation = |lag: usize| {
        let pairs = residuals.iter().zip(&residuals[lag..]);
        pairs.map(|(a, b)| a * b).sum::<f64>() / power
    };
    let memory: f64 = (1..residuals.len()).map(correlation).take_while(|&r| r > 0.0).sum();
    residuals.len() as f64 / (1.0 + 2.0 * memory)
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    /// First-order noise of unit variance whose samples correlate by `memory`.
    fn coloured(samples: usize, memory: f64, seed: u128) -> Vec<f64> {
        let mut random = Pcg64Mcg::new(seed);
        let mut last = 0.0;
        let innovation = (1.0 - memory * memory).sqrt();
        let mut next = || {
            let deviate: f64 = StandardNormal.sample(&mut random);
            last = memory * last + innovation * deviate;
            last
        };
        (0..samples).map(|_| next()).collect()
    }

    #[test]
    fn correlated_samples_count_less() {
        // (1 - 0.8) / (1 + 0.8) = 1/9 of the samples.
        let effective = effective_samples(&coloured(20_000, 0.8, 5)) / 20_000.0;
        assert!((effective * 9.0 - 1.0).abs() < 0.2, "{effective}");
        assert!(effective_samples(&coloured(20_000, 0.0, 6)) > 0.9 * 20_000.0);
    }

    #[test]
    fn the_mean_of_correlated_noise_has_its_true_error() {
        let samples = 20_000;
        let rows = DMatrix::from_element(samples, 1, 1.0);
        let residuals = DVector::from_vec(coloured(samples, 0.8, 7));
        let unit = DMatrix::from_element(1, 1, 1.0 / samples as f64);
        let blocks: Vec<Vec<usize>> =
            (0..200).map(|block| (block * 100..(block + 1) * 100).collect()).collect();
        let covariance = clustered_covariance(&rows, &residuals, &unit, &blocks);
        let truth = 9.0 / samples as f64;
        assert!((covariance[(0, 0)] / truth - 1.0).abs() < 0.3, "{}", covariance[(0, 0)] / truth);
    }
}
