//! A joint that stands still under a voltage that must move it: amplifier off, brake, obstacle
//! or encoder.

use crate::ParameterBlock;

/// A joint is held by its static friction, and by as much again that the model does not know.
const FRICTION_MARGIN: f32 = 2.0;

/// Since when a joint stands still under a voltage that ought to move it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StallMonitor {
    /// What friction and the model's errors may hold [V].
    limit_v: f32,
    allowed_ticks: u32,
    ticks: u32,
}

impl StallMonitor {
    /// For joint `index` (0 to 2) of a checked block.
    pub fn new(block: &ParameterBlock, index: usize) -> Self {
        let friction = &block.robot.friction[index];
        let static_v = friction.alpha0_v + friction.alpha1_v;
        Self {
            limit_v: FRICTION_MARGIN * static_v + block.safety.stalled_margin_v,
            allowed_ticks: (block.safety.stalled_s / block.sample_period_s + 0.5) as u32,
            ticks: 0,
        }
    }

    /// The same limits, and nothing counted.
    pub fn fresh(&self) -> Self {
        Self { ticks: 0, ..*self }
    }

    /// What friction and the model's errors may hold [V].
    pub fn limit_v(&self) -> f32 {
        self.limit_v
    }

    /// Counts a tick in which the encoder has not moved.
    #[inline]
    pub fn stands(&mut self, command_v: f32) {
        let pushed = command_v.abs() > self.limit_v;
        self.ticks = if pushed { self.ticks.saturating_add(1) } else { 0 };
    }

    /// The joint has moved, or gravity holds it.
    #[inline]
    pub fn moves(&mut self) {
        self.ticks = 0;
    }

    /// Whether the joint has stood so long that gravity must be looked at.
    #[inline]
    pub fn is_due(&self) -> bool {
        self.ticks > self.allowed_ticks
    }
}
