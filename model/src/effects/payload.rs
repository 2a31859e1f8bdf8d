//! A point mass at the tip.

use crate::links::{Link, base_parameters};
use crate::{BaseParameters, Geometry, Real};

/// The base parameters of an arm with a point mass at the origin of frame 3.
///
/// Base parameters are sums over masses, so those of the mass alone are added.
pub fn with_payload<T: Real>(
    base: &BaseParameters<T>,
    geometry: &Geometry<T>,
    mass_kg: T,
) -> BaseParameters<T> {
    let none = [T::zero(); 3];
    let nothing = Link {
        mass_kg: T::zero(),
        centre_m: none,
        inertia_diagonal_kg_m2: none,
        inertia_products_kg_m2: none,
    };
    let links = [nothing, nothing, Link { mass_kg, ..nothing }];
    let added = base_parameters(&links, &none, geometry).to_array();
    let mut sum = base.to_array();
    for (parameter, more) in sum.iter_mut().zip(added) {
        *parameter = *parameter + more;
    }
    BaseParameters::from_array(sum)
}
