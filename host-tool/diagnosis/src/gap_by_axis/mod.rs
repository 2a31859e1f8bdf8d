//! Where the gap lies, without any hypothesis of its cause.
//!
//! For each joint and axis, a function of that axis alone is fitted to the residuals of the
//! refitted model. What it takes off stretches of the logs that it was not fitted to, in parts
//! of what all joints leave above the noise floor, is its share. The axis that explains most
//! comes first, the next one explains what the first has left, and so on: shares of a joint do
//! not overlap.

mod acceleration;
mod angle;
mod command;
mod curve;
mod fit;
mod found;
mod frequency;
mod load;
mod nodes;
mod offset;
pub mod orders;
mod position;
mod samples;
mod shape;
mod spectrum;
#[cfg(test)]
mod tests;
mod time;
mod velocity;

use rayon::prelude::*;

pub use angle::Carrier;
pub use samples::Samples;
pub use spectrum::{Spectrum, spectrum};

use crate::criteria::AxisCriteria;
use crate::result::{GapShare, LogResiduals};
use found::Found;

/// Where the gap of the refitted model lies, largest share first; small shares are left out.
///
/// Empty where no joint leaves more than its noise floor.
pub fn gap_by_axis(logs: &[LogResiduals], criteria: &AxisCriteria) -> Vec<GapShare> {
    gap_by_axis_of(&Samples::of_joints(logs, criteria, |joint| &joint.refitted_v), criteria)
}

/// The same of any residuals, joint by joint.
pub fn gap_by_axis_of(samples: &[Samples], criteria: &AxisCriteria) -> Vec<GapShare> {
    let whole_v2: f64 = samples.iter().map(Samples::excess_v2).sum();
    if whole_v2 <= 0.0 {
        return Vec::new();
    }
    let of_joint = |samples: &Samples| -> Vec<GapShare> {
        let limit_v2 = samples.excess_v2();
        let share = |found: Found| GapShare {
            joint: samples.joint,
            axis: found.axis,
            share: (found.energy_v2.min(limit_v2) / whole_v2).clamp(0.0, 1.0),
            detail: found.detail,
        };
        found(samples).into_iter().map(share).collect()
    };
    let mut shares: Vec<GapShare> = samples.par_iter().flat_map(of_joint).collect();
    shares.retain(|share| share.share >= criteria.least_share);
    shares.sort_by(|a, b| b.share.total_cmp(&a.share));
    shares
}

/// What the axes explain of one joint's residual one after the other, the strongest first;
/// frequencies come last, for they are looked for in what the other axes leave.
fn found(samples: &Samples) -> Vec<Found> {
    let (whole_v2, criteria) = (samples.excess_v2(), &samples.criteria);
    let mut all: Vec<Found> = Vec::new();
    if whole_v2 <= 0.0 || samples.len() < criteria.fewest_samples {
        return all;
    }
    let mut left = samples.clone();
    while all.len() < criteria.most_axes && left.excess_v2() > 0.0 {
        let least_v2 = criteria.least_share * whole_v2;
        let Some(next) = strongest(&left).filter(|f| f.energy_v2 > least_v2) else { break };
        left.residual_v.iter_mut().zip(&next.fitted_v).for_each(|(left, f)| *left -= f);
        all.push(next);
    }
    let explained_v2: f64 = all.iter().map(|found| found.energy_v2).sum();
    all.extend(frequency::find(&left, explained_v2 / whole_v2));
    merged(all)
}

/// The axis that explains most.
fn strongest(samples: &Samples) -> Option<Found> {
    type Find = fn(&Samples) -> Option<Found>;
    const ALL: [Find; 7] = [
        offset::find,
        position::find,
        velocity::find,
        acceleration::find,
        command::find,
        load::find,
        time::find,
    ];
    let found = ALL.par_iter().filter_map(|find| find(samples));
    found.max_by(|a, b| a.energy_v2.total_cmp(&b.energy_v2))
}

/// One entry per axis; what is found later on the same axis adds to its share.
fn merged(all: Vec<Found>) -> Vec<Found> {
    let mut merged: Vec<Found> = Vec::new();
    for found in all {
        match merged.iter_mut().find(|other| other.axis == found.axis) {
            Some(other) => other.energy_v2 += found.energy_v2,
            None => merged.push(found),
        }
    }
    merged
}
