//! What the controller knows of one joint from tick to tick.

use model::FrictionState;

use crate::block::ParameterBlock;
use crate::encoder::{Encoder, EncoderScale};
use crate::reference::InjectionSource;
use crate::velocity::{TrackerGains, VelocityTracker};
use crate::{Angle, DacCode};

/// Estimator, friction and injection state of one joint.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub encoder: Encoder,
    pub tracker: VelocityTracker,
    /// The tracker has an angle.
    has_measured: bool,
    pub friction: FrictionState<f32>,
    pub injection: InjectionSource,
    /// Making it takes up to a millisecond for noise, so a run begins with a copy.
    injection_at_start: InjectionSource,
}

/// What is measured and commanded at a joint in a tick.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct JointSample {
    pub count: i32,
    pub measured: Angle,
    pub velocity_rad_per_s: f32,
    /// Reference at the tick.
    pub reference: Angle,
    pub code: DacCode,
    /// The command was cut: at the limit, or to 0 V if it was not finite.
    pub saturated: bool,
}

impl JointSample {
    /// The command [V].
    #[inline]
    pub fn command_v(&self) -> f32 {
        self.code.to_volts()
    }

    /// Whether the command was a finite number: one that is cut is at the limit, not at 0 V.
    #[inline]
    pub fn is_finite(&self) -> bool {
        !(self.saturated && self.code.0 == 0)
    }
}

impl Joint {
    /// At rest, with nothing estimated yet.
    pub fn new(block: &ParameterBlock, index: usize, rate_per_s: f32) -> Self {
        let injection = InjectionSource::new(&block.reference.injection[index], rate_per_s);
        Self {
            encoder: Encoder::new(EncoderScale::new(block.encoder_counts_per_turn)),
            tracker: VelocityTracker::at_rest(tracker_gains(block, index), Angle(0)),
            has_measured: false,
            friction: FrictionState::default(),
            injection,
            injection_at_start: injection,
        }
    }

    /// Forgets what it has estimated.
    pub fn reset(&mut self) {
        self.encoder = Encoder::new(self.encoder.scale());
        self.has_measured = false;
        self.begin_run();
    }

    /// Friction and injected voltage begin anew.
    pub fn begin_run(&mut self) {
        self.friction = FrictionState::default();
        self.injection = self.injection_at_start;
    }

    /// Whether what was derived from a block is unchanged.
    pub fn is_of(&self, block: &ParameterBlock, index: usize) -> bool {
        self.tracker.gains() == tracker_gains(block, index)
            && self.encoder.scale() == EncoderScale::new(block.encoder_counts_per_turn)
            && self.injection.goes_on_from(&self.injection_at_start)
    }

    /// Takes an encoder's count of a tick.
    #[inline]
    pub fn measure(&mut self, count: i32, sample: &mut JointSample) {
        let angle = self.encoder.update(count);
        if !self.has_measured {
            self.begin_at(angle);
        }
        sample.count = count;
        sample.measured = angle;
        sample.velocity_rad_per_s = self.tracker.update(angle);
    }

    #[cold]
    fn begin_at(&mut self, angle: Angle) {
        self.tracker = VelocityTracker::at_rest(self.tracker.gains(), angle);
        self.has_measured = true;
    }
}

fn tracker_gains(block: &ParameterBlock, index: usize) -> TrackerGains {
    TrackerGains::new(block.velocity_bandwidth_rad_per_s[index], block.sample_period_s)
}
