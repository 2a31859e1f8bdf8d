//! The fade-in of the feedback where a run begins off the reference's start.

use core::f32::consts::TAU;

use crate::{Angle, ParameterBlock};

/// Time in which the feedback of the first distance comes in [s]: slower than the loops, so that
/// the joint follows, and much shorter than any motion.
const FADE_S: f32 = 0.5;
/// Distances that an encoder's dither makes are left alone [counts].
const DITHER_COUNTS: f32 = 3.0;

/// The part of the feedback that is left out while a run begins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StartFade {
    /// What the first distance is worth [V].
    step_v: [f32; 3],
    ticks: u32,
    share_per_tick: f32,
}

impl StartFade {
    /// For joints at rest at `measured`, with a reference that begins at `start`.
    pub fn new(block: &ParameterBlock, start: &[Angle; 3], measured: &[Angle; 3]) -> Self {
        let dither_rad = DITHER_COUNTS * TAU / block.encoder_counts_per_turn as f32;
        let step_v = [0, 1, 2].map(|i| {
            let distance_rad = start[i].minus(measured[i]);
            match distance_rad.abs() > dither_rad {
                true => block.gains[i].proportional_v_per_rad * distance_rad,
                false => 0.0,
            }
        });
        if step_v == [0.0; 3] {
            return Self::default();
        }
        let ticks = (FADE_S / block.sample_period_s + 0.5) as u32;
        Self { step_v, ticks, share_per_tick: 1.0 / ticks.max(1) as f32 }
    }

    /// What the feedback of joint `i` (0 to 2) leaves out in a tick of the run [V].
    #[inline]
    pub fn left_out_v(&self, i: usize, tick: u32) -> f32 {
        if tick >= self.ticks {
            return 0.0;
        }
        self.step_v[i] * (self.ticks - tick) as f32 * self.share_per_tick
    }
}
