//! Random parameter blocks that an arm in this posture can be run with.

use firmware::reference::{FadeIn, FourierSeries, Injection, Motion, Noise, Reference, Sine};
use firmware::{Mode, ParameterBlock};
use rig::Rig;

use super::rng::Rng;

/// A block whose reference begins where the joints are; its first joint in mode `mode`.
pub fn block(rig: &Rig, rng: &mut Rng, mode: Mode, at_rad: [f32; 3]) -> ParameterBlock {
    let modes = [0, 1, 2].map(|joint| match joint {
        0 => mode,
        _ => Mode::ALL[rng.below(5) as usize],
    });
    let reference = Reference {
        motion: [0, 1, 2].map(|joint| motion(rng, at_rad[joint])),
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

fn motion(rng: &mut Rng, centre_rad: f32) -> Motion {
    let fade_in = FadeIn { duration_s: 2.0 };
    let period_s = rng.between(3.0, 6.0);
    match rng.below(4) {
        0 => Motion::Hold { angle_rad: centre_rad },
        1 => Motion::Quintic {
            from_rad: centre_rad,
            to_rad: centre_rad + rng.between(-0.8, 0.8),
            duration_s: period_s,
        },
        2 => {
            let amplitude_rad = rng.between(0.1, 0.8);
            Motion::Sine(Sine { centre_rad, amplitude_rad, period_s, fade_in })
        }
        _ => Motion::Fourier(FourierSeries {
            centre_rad,
            period_s: 2.0 * period_s,
            sine_rad: [0; 5].map(|_| rng.between(-0.1, 0.1)),
            cosine_rad: [0; 5].map(|_| rng.between(-0.1, 0.1)),
            fade_in,
        }),
    }
}

fn injection(rng: &mut Rng) -> Injection {
    match rng.below(3) {
        0 => {
            let rms_v = rng.between(0.02, 0.1);
            Injection::Noise(Noise { rms_v, bandwidth_hz: 200.0, seed: rng.word() })
        }
        _ => Injection::None,
    }
}
