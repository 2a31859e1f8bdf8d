//! The converter's outputs against the codes that act: an output that sticks, a channel that is
//! damaged, a wire that is short, while the converter's own registers read back right.

use crate::DacCode;
use crate::block::HardLimits;

/// Since when each output has not been what its code says.
#[derive(Clone, Debug)]
pub(super) struct OutputMonitor {
    /// What is allowed [V].
    pub limit_v: f32,
    allowed_ticks: u32,
    /// The codes that acted when the outputs were measured: those of the tick before.
    pub acting: [DacCode; 3],
    off_ticks: [u32; 3],
}

impl Default for OutputMonitor {
    fn default() -> Self {
        let HardLimits { output_error_v, output_error_ticks, .. } = HardLimits::default();
        Self {
            limit_v: output_error_v,
            allowed_ticks: output_error_ticks,
            acting: [DacCode(0); 3],
            off_ticks: [0; 3],
        }
    }
}

impl OutputMonitor {
    /// Nothing is expected of outputs at 0 V.
    #[inline]
    pub fn look_away(&mut self) {
        self.off_ticks = [0; 3];
    }

    /// Counts a tick; the first output (0 to 2) that has been off for too long, and by how much [V].
    #[inline]
    pub fn look(&mut self, measured_v: &[f32; 3]) -> Option<(usize, f32)> {
        let mut found = None;
        let outputs = self.acting.iter().zip(measured_v).zip(&mut self.off_ticks).enumerate();
        for (index, ((code, measured_v), off_ticks)) in outputs {
            let off_v = (measured_v - code.to_volts()).abs();
            // What is not a number is off.
            let is_right = off_v <= self.limit_v;
            *off_ticks = if is_right { 0 } else { off_ticks.saturating_add(1) };
            if *off_ticks > self.allowed_ticks && found.is_none() {
                found = Some((index, off_v));
            }
        }
        found
    }
}
