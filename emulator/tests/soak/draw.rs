//! Random blocks that begin where the arm is.

use firmware::block::PositionLimits;
use firmware::reference::{Injection, Motion, Reference};
use firmware::{Mode, ParameterBlock};
use random_motions::{Rng, injection, motion};
use rig::Rig;

use super::ending::Ending;

/// How far a motion goes from where it begins [rad].
const FURTHEST_RAD: f32 = 0.6;
/// Modes that track a reference.
const TRACKING: [Mode; 3] = [Mode::PdModel, Mode::Pd, Mode::PdFriction];

/// The block of a session with such an ending.
pub fn block(rig: &Rig, rng: &mut Rng, ending: Ending, at_rad: [f32; 3]) -> ParameterBlock {
    let motion = match ending {
        // As far off as a run may begin.
        Ending::Stall => at_rad.map(|angle_rad| Motion::Hold { angle_rad: angle_rad + 0.045 }),
        Ending::Range => [0, 1, 2].map(|i| beyond(at_rad[i])),
        _ => [0, 1, 2].map(|i| motion(rng, at_rad[i], FURTHEST_RAD)),
    };
    let injection = [0, 1, 2].map(|_| injected(rng, ending));
    let duration_s = if ending == Ending::Hold { 4.0 } else { 3600.0 };
    let mode = TRACKING[rng.below(3) as usize];
    let mode = if ending == Ending::Stall { Mode::Pd } else { mode };
    let mut block = rig.block([mode; 3], Reference { motion, injection, duration_s });
    if ending == Ending::Hold {
        block.safety.hold_s = 2.0;
    }
    if ending == Ending::Range {
        block.safety.position = [0, 1, 2].map(|i| Some(around(at_rad[i])));
    }
    block
}

/// A radian to either side.
fn around(at_rad: f32) -> PositionLimits {
    PositionLimits { lower_rad: at_rad - 0.5, upper_rad: at_rad + 0.5, braking_rad_per_s2: 6.0 }
}

fn beyond(from_rad: f32) -> Motion {
    Motion::Quintic { from_rad, to_rad: from_rad + 1.0, duration_s: 6.0 }
}

fn injected(rng: &mut Rng, ending: Ending) -> Injection {
    let quiet = matches!(ending, Ending::Stall | Ending::Range | Ending::Hold);
    let drawn = injection(rng);
    if quiet { Injection::None } else { drawn }
}
