//! Random blocks that begin where the arm is.

use firmware::block::PositionLimits;
use firmware::reference::{FadeIn, FourierSeries, Injection, Motion, Noise, Reference, Sine};
use firmware::{Mode, ParameterBlock};
use rig::Rig;

use super::ending::Ending;

/// Knuth's linear congruential generator.
pub struct Draw(pub u64);

impl Draw {
    fn word(&mut self) -> u32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32
    }

    pub fn below(&mut self, limit: u32) -> u32 {
        self.word() % limit
    }

    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.word() as f32 / (1_u32 << 31) as f32)
    }
}

/// Modes that track a reference.
const TRACKING: [Mode; 3] = [Mode::PdModel, Mode::Pd, Mode::PdFriction];

/// The block of a session with such an ending.
pub fn block(rig: &Rig, draw: &mut Draw, ending: Ending, at_rad: [f32; 3]) -> ParameterBlock {
    let motion = match ending {
        // As far off as a run may begin.
        Ending::Stall => at_rad.map(|angle_rad| Motion::Hold { angle_rad: angle_rad + 0.045 }),
        Ending::Range => [0, 1, 2].map(|i| beyond(at_rad[i])),
        _ => [0, 1, 2].map(|i| motion(draw, at_rad[i])),
    };
    let injection = [0, 1, 2].map(|_| injection(draw, ending));
    let duration_s = if ending == Ending::Hold { 4.0 } else { 3600.0 };
    let mode = TRACKING[draw.below(3) as usize];
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

fn motion(draw: &mut Draw, centre_rad: f32) -> Motion {
    let fade_in = FadeIn { duration_s: 2.0 };
    let period_s = draw.between(3.0, 6.0);
    match draw.below(4) {
        0 => Motion::Hold { angle_rad: centre_rad },
        1 => {
            let to_rad = centre_rad + draw.between(-0.6, 0.6);
            Motion::Quintic { from_rad: centre_rad, to_rad, duration_s: period_s }
        }
        2 => {
            let amplitude_rad = draw.between(0.1, 0.6);
            Motion::Sine(Sine { centre_rad, amplitude_rad, period_s, fade_in })
        }
        _ => Motion::Fourier(FourierSeries {
            centre_rad,
            period_s: 2.0 * period_s,
            sine_rad: [0; 5].map(|_| draw.between(-0.1, 0.1)),
            cosine_rad: [0; 5].map(|_| draw.between(-0.1, 0.1)),
            fade_in,
        }),
    }
}

fn injection(draw: &mut Draw, ending: Ending) -> Injection {
    let quiet = matches!(ending, Ending::Stall | Ending::Range | Ending::Hold);
    match draw.below(3) {
        0 if !quiet => {
            let (rms_v, seed) = (draw.between(0.02, 0.1), draw.word());
            Injection::Noise(Noise { rms_v, bandwidth_hz: 200.0, seed })
        }
        _ => Injection::None,
    }
}
