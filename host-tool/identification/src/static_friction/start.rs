//! Starting values of the search: sliding by linear least squares, the rest from a grid.

use model::Friction;
use nalgebra::DVector;

use crate::one_joint::grey_box;
use crate::one_joint::parameters::{LINEAR, to_logarithms};
use crate::one_joint::rows::Rows;
use crate::one_joint::sliding::Sliding;

/// A coarse grid over the parameters that sliding does not determine, the best point first.
pub fn grid(rows: &Rows, sliding: &Sliding) -> Vec<DVector<f64>> {
    const JITTER_RAD_PER_S: f64 = 2e-4;
    let mut tried: Vec<(f64, DVector<f64>)> = Vec::new();
    for breakaway in [0.5, 1.0, 1.3] {
        for sigma0 in [100.0, 250.0, 700.0, 2000.0] {
            let friction = Friction {
                alpha0_v: sliding.alpha0_v,
                alpha1_v: (breakaway - 1.0) * sliding.alpha0_v,
                stribeck_velocity_rad_per_s: 0.004,
                alpha2_v_s_per_rad: sliding.alpha2_v_s_per_rad,
                sigma0_v_per_rad: sigma0,
                sigma1_v_s_per_rad: 3.0,
            };
            let logarithms = to_logarithms(&friction).into_iter().chain([JITTER_RAD_PER_S.ln()]);
            let start = DVector::from_iterator(
                LINEAR + sliding.factors.len(),
                logarithms.chain(sliding.factors.iter().copied()),
            );
            tried.push((grey_box::rms(&rows.data, &start), start));
        }
    }
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    tried.into_iter().map(|(_, start)| start).collect()
}
