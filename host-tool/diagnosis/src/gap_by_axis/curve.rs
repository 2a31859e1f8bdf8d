//! A function of one variable that vanishes with it.

use super::fit::{Design, Fit};
use super::nodes::Nodes;
use super::samples::Samples;
use super::shape::centred;

/// A fitted function.
pub(super) struct Curve {
    /// What it takes off the sum of squares [V^2].
    pub energy_v2: f64,
    /// Its value at every sample [V].
    pub fitted_v: Vec<f64>,
}

/// The function of `variable` that fits the residual, times `carrier`.
///
/// It is zero where the variable is; where a constant beside it fits clearly better, that
/// constant is not the function's.
pub(super) fn curve(samples: &Samples, variable: &[f64], carrier: Option<&[f64]>) -> Curve {
    let nodes = Nodes::of(variable.iter().copied());
    let rest = nodes.weights(0.0);
    let design = Design::of(samples.len(), 1 + nodes.len(), |k, row| {
        let factor = carrier.map_or(1.0, |carrier| carrier[k]);
        row.push((0, 1.0));
        row.extend(nodes.weights(variable[k]).map(|(node, w)| (1 + node, w * factor)));
        row.extend(rest.map(|(node, w)| (1 + node, -w * factor)));
    });
    let fit = Fit::of(&design, &samples.residual_v, &samples.fold);
    let all: Vec<usize> = (0..=nodes.len()).collect();
    let (alone_v2, beside_v2) = (fit.gain(&[], &all[1..]), fit.gain(&[0], &all));
    if alone_v2 > samples.criteria.without_constant_part * beside_v2 {
        let fitted_v = design.times(&fit.coefficients(&all[1..]));
        return Curve { energy_v2: alone_v2, fitted_v };
    }
    let fitted_v = centred(&design.times(&fit.coefficients(&all)));
    Curve { energy_v2: beside_v2, fitted_v }
}
