//! First guess: the FRF of one joint, eq. (12), by linear least squares on its inverse.
//!
//! Biased by noise and by the neighbours' motion, but near enough for the fit to begin.

use nalgebra::{Complex, Matrix3, Vector3};

use super::linear::hold;
use super::record::Record;

/// Inertia, damping and stiffness of the FRF, eq. (12), in volts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// J / k_t [V s^2/rad].
    pub inertia: f64,
    /// sigma_1 + alpha_2 [V s/rad].
    pub damping: f64,
    /// sigma_0 and gravity [V/rad].
    pub stiffness: f64,
}

/// The guess over the band's bins; `inertia` [V s^2/rad] is kept where it is known.
///
/// `None` where the equations have no solution with positive values.
pub fn start(record: &Record, bins: &[usize], inertia: Option<f64>) -> Option<Start> {
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for &bin in bins {
        let frequency_hz = record.spectra.frequency_hz[bin];
        let s = Complex::new(0.0, std::f64::consts::TAU * frequency_hz);
        let coherence = record.coherence(bin).min(0.99);
        let weight = coherence / (1.0 - coherence);
        let gain = record.frf(bin) / hold(frequency_hz, record.period_s);
        let columns = [s * s * gain, s * gain, gain];
        for part in [|z: Complex<f64>| z.re, |z: Complex<f64>| z.im] {
            let row = Vector3::from(columns.map(part));
            normal += row * row.transpose() * weight;
            right += row * (weight * part(Complex::from(1.0)));
        }
    }
    if let Some(inertia) = inertia {
        let firm = 1e6 * normal[(0, 0)];
        normal[(0, 0)] += firm;
        right[0] += firm * inertia;
    }
    let [inertia, damping, stiffness]: [f64; 3] = solve_scaled(normal, right)?.into();
    let damping = if damping > 0.0 { damping } else { 0.3 * (inertia * stiffness).sqrt() };
    let start = Start { inertia, damping, stiffness };
    (inertia > 0.0 && stiffness > 0.0 && damping.is_finite()).then_some(start)
}

/// Solves normal equations whose columns have very different units.
fn solve_scaled(mut normal: Matrix3<f64>, mut right: Vector3<f64>) -> Option<Vector3<f64>> {
    let scale: Vector3<f64> = normal.diagonal().map(|x| 1.0 / x.sqrt());
    for row in 0..3 {
        right[row] *= scale[row];
        for column in 0..3 {
            normal[(row, column)] *= scale[row] * scale[column];
        }
    }
    Some(normal.cholesky()?.solve(&right).component_mul(&scale))
}
