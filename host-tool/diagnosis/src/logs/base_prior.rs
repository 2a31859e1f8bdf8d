//! How far base parameters may be from the model as given.

use model::BaseParameters;
use model::base::COUNT;

use crate::criteria::PriorCriteria;

/// Standard deviations of the closed form's base parameters.
pub fn of_closed_form(base: &BaseParameters<f64>, prior: &PriorCriteria) -> [f64; COUNT] {
    let (values, scales) = (base.to_array(), base_scales(base));
    std::array::from_fn(|k| prior.relative * values[k].abs() + prior.of_largest * scales[k])
}

/// The largest parameter of each one's kind: inertias and first moments, link by link.
fn base_scales(base: &BaseParameters<f64>) -> [f64; COUNT] {
    let (first, second) = (base.zz1r.abs().min(1e3), base.zz2r.abs().min(1e3));
    let third = (base.zz3r + base.ia3).abs();
    let moment2 = base.mx2r.hypot(base.my2r);
    let moment3 = match base.mx3r.hypot(base.my3r) {
        // A balanced link may yet be slightly off balance: its scale is that of its inertia at 1 m.
        0.0 => third,
        moment => moment,
    };
    BaseParameters {
        zz1r: first,
        xx2r: second,
        xy2r: second,
        xz2r: second,
        yz2r: second,
        zz2r: second,
        mx2r: moment2,
        my2r: moment2,
        xx3r: third,
        xy3r: third,
        xz3r: third,
        yz3r: third,
        zz3r: third,
        mx3r: moment3,
        my3r: moment3,
        ia3: third,
    }
    .to_array()
}
