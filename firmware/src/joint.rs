//! What the controller knows of one joint from tick to tick.

use model::FrictionState;

use crate::Angle;
use crate::block::ParameterBlock;
use crate::encoder::{Encoder, EncoderScale};
use crate::reference::InjectionSource;
use crate::velocity::{TrackerGains, VelocityTracker};

/// Estimator, friction and injection state of one joint.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub encoder: Encoder,
    pub tracker: Option<VelocityTracker>,
    pub tracker_gains: TrackerGains,
    pub friction: FrictionState<f32>,
    pub injection: InjectionSource,
}

/// Position and velocity as measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measured {
    pub angle: Angle,
    pub velocity_rad_per_s: f32,
}

impl Joint {
    /// At rest, with nothing estimated yet.
    pub fn new(block: &ParameterBlock, index: usize, rate_per_s: f32) -> Self {
        let bandwidth = block.velocity_bandwidth_rad_per_s[index];
        Self {
            encoder: Encoder::new(EncoderScale::new(block.encoder_counts_per_turn)),
            tracker: None,
            tracker_gains: TrackerGains::new(bandwidth, block.sample_period_s),
            friction: FrictionState::default(),
            injection: InjectionSource::new(&block.reference.injection[index], rate_per_s),
        }
    }

    /// Whether counts mean the same to both.
    pub fn has_scales_of(&self, other: &Self) -> bool {
        self.tracker_gains == other.tracker_gains && self.encoder.scale() == other.encoder.scale()
    }

    /// Takes an encoder's count of a tick.
    #[inline]
    pub fn measure(&mut self, count: i32) -> Measured {
        let angle = self.encoder.update(count);
        let gains = self.tracker_gains;
        let tracker = self.tracker.get_or_insert_with(|| VelocityTracker::at_rest(gains, angle));
        Measured { angle, velocity_rad_per_s: tracker.update(angle) }
    }
}
