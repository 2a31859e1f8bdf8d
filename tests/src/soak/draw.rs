//! Random parameter blocks that an arm in this posture can be run with.

use firmware::reference::Reference;
use firmware::{Mode, ParameterBlock};
use rig::Rig;

use random_motions::{Rng, injection, motion};

/// How far a motion goes from where it begins [rad].
const FURTHEST_RAD: f32 = 0.8;

/// A block whose reference begins where the joints are; its first joint in mode `mode`.
pub fn block(rig: &Rig, rng: &mut Rng, mode: Mode, at_rad: [f32; 3]) -> ParameterBlock {
    let modes = [0, 1, 2].map(|joint| match joint {
        0 => mode,
        _ => Mode::ALL[rng.below(5) as usize],
    });
    let reference = Reference {
        motion: [0, 1, 2].map(|joint| motion(rng, at_rad[joint], FURTHEST_RAD)),
        injection: [0, 1, 2].map(|_| injection(rng)),
        duration_s: 1e6,
    };
    let mut block = rig.block(modes, reference);
    for joint in 0..3 {
        let gains = &mut block.gains[joint];
        gains.proportional_v_per_rad *= rng.between(0.8, 1.2);
        gains.derivative_v_s_per_rad *= rng.between(0.8, 1.2);
        block.velocity_bandwidth_rad_per_s[joint] = rng.between(250.0, 350.0);
        // Never more friction than there is: what is compensated too much runs away.
        let friction = &mut block.robot.friction[joint];
        let share = rng.between(0.7, 0.95);
        friction.alpha0_v *= share;
        friction.alpha1_v *= share;
        friction.alpha2_v_s_per_rad *= share;
    }
    block
}
