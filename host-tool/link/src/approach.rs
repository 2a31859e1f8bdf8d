//! The approach: the motion from where the joints are to where a reference begins.

use firmware::link::Telemetry;
use firmware::reference::{Motion, Reference};
use firmware::{Angle, Mode, ParameterBlock};
use std::f32::consts::TAU;

use rig::joints;
use simulation::start_of;

/// Nearer than this, nothing is approached [rad].
const NEAR_RAD: f32 = 0.005;
/// Shortest approach [s].
const SHORTEST_S: f32 = 1.0;
/// The velocity of a quintic peaks at 15/8 of its mean.
const PEAK_TO_MEAN: f32 = 1.875;

/// The block that moves every joint, at `speed_rad_per_s` at most, to where `block`'s
/// reference begins, in the shorter direction; `None` if all are there.
///
/// Joints in open loop are moved with feedback, and nothing is injected; joints that the rig
/// does not have keep their mode.
pub fn approach(
    block: &ParameterBlock,
    now: &Telemetry,
    speed_rad_per_s: f32,
) -> Option<ParameterBlock> {
    let is_present = [1, 2, 3].map(|joint| joints::present(block).contains(&joint));
    let from_rad = positions_rad(block, now);
    let start_rad = start_of(block);
    let distance_rad = [0, 1, 2].map(|i| {
        let distance =
            Angle::from_radians(start_rad[i] as f32).minus(Angle::from_radians(from_rad[i]));
        if is_present[i] { distance } else { 0.0 }
    });
    let furthest_rad = distance_rad.iter().fold(0.0f32, |most, rad| most.max(rad.abs()));
    if furthest_rad < NEAR_RAD {
        return None;
    }
    let duration_s = (PEAK_TO_MEAN * furthest_rad / speed_rad_per_s).max(SHORTEST_S);
    let motion = [0, 1, 2].map(|i| Motion::Quintic {
        from_rad: from_rad[i],
        to_rad: from_rad[i] + distance_rad[i],
        duration_s,
    });
    let reference = Reference { motion, ..Reference::hold([0.0; 3]) };
    let mode = [0, 1, 2].map(|i| match block.mode[i] {
        Mode::OpenLoop | Mode::FrictionOnly if is_present[i] => Mode::Pd,
        mode => mode,
    });
    // A second longer than the motion, so that what is left of it dies out.
    Some(ParameterBlock {
        reference: Reference { duration_s: duration_s + 1.0, ..reference },
        mode,
        ..block.clone()
    })
}

/// The joint positions [rad].
pub fn positions_rad(block: &ParameterBlock, now: &Telemetry) -> [f32; 3] {
    now.counts
        .map(|count| (f64::from(count) / f64::from(block.encoder_counts_per_turn)) as f32 * TAU)
}
