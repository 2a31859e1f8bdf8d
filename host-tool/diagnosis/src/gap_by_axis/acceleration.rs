//! What varies with acceleration.

use super::curve::curve;
use super::found::Found;
use super::samples::Samples;
use super::shape::{explained, spread};
use crate::quantity::{number, volts};
use crate::result::Axis;

/// A function of acceleration.
pub(super) fn find(samples: &Samples) -> Option<Found> {
    let acceleration = &samples.acceleration_rad_per_s2;
    let found = curve(samples, acceleration, None);
    let (share, slope) = explained(&found.fitted_v, |k| acceleration[k]);
    let detail = if share > samples.criteria.clear_part {
        format!("proportional to acceleration, {} mV s^2/rad", number(1e3 * slope))
    } else {
        format!("varies with acceleration by {}", volts(spread(&found.fitted_v)))
    };
    Some(Found {
        axis: Axis::Acceleration,
        energy_v2: found.energy_v2,
        detail,
        fitted_v: found.fitted_v,
    })
}
