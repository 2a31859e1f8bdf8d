//! The control law.
//!
//! Once a tick, from three encoder counts to three DAC codes:
//!
//! ```text
//! u = kp (q_ref - q) + kd (qd_ref - qd)      feedback, eq. (17), faded in as a run begins
//!   + k_t^-1 (D qdd + c + h)                 inverse dynamics of the reference, eq. (3)
//!   + LuGre friction of the reference        eq. (9)
//!   + injected voltage
//! ```
//!
//! Effects that the model lacks are compensated in the two feedforward terms and by an inverse
//! of the input effects applied to u: [`crate::compensation`].
//!
//! Inverse dynamics and friction are evaluated for the reference in the middle of the interval
//! in which the command acts; feedback uses the reference at the tick itself.
//! All but the feedback depends on the tick's number alone: [`Controller::prepare`] computes it
//! for the next tick once the codes of this one are out.
//! Deadline: the codes are out before the next tick, 1 ms or 170,000 cycles of the
//! STM32G474; `docs/board.md` holds the count of instructions.

use model::{FrictionState, Posture};

use crate::block::{Fingerprints, Gains, PARTS, ParameterBlock};
use crate::feedforward::{Clock, JointFeedforward, last_tick};
use crate::joint::{Joint, JointSample};
use crate::start_fade::StartFade;
use crate::{Angle, DacCode, Mode};

/// What a tick puts out, and what it saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TickOutput {
    /// Command of each joint.
    pub codes: [DacCode; 3],
    /// Reference angle of each joint at this tick.
    pub reference: [Angle; 3],
    /// Measured angle of each joint.
    pub measured: [Angle; 3],
    /// Estimated velocities [rad/s].
    pub velocity_rad_per_s: [f32; 3],
    /// Whether the command of each joint was cut: at the limit, or to 0 V if it was not finite.
    pub saturated: [bool; 3],
}

impl TickOutput {
    /// Whether the command of joint `index` (0 to 2) was a finite number.
    #[inline]
    pub fn is_finite(&self, index: usize) -> bool {
        // A finite command that is cut is at the limit, not at 0 V.
        !(self.saturated[index] && self.codes[index].0 == 0)
    }

    fn of(samples: &[JointSample; 3]) -> Self {
        Self {
            codes: samples.map(|sample| sample.code),
            reference: samples.map(|sample| sample.reference),
            measured: samples.map(|sample| sample.measured),
            velocity_rad_per_s: samples.map(|sample| sample.velocity_rad_per_s),
            saturated: samples.map(|sample| sample.saturated),
        }
    }
}

/// The controller of all three joints.
#[derive(Clone, Debug)]
pub struct Controller {
    joints: [Joint; 3],
    clock: Clock,
    running: bool,
    /// The next tick's, if it `is_prepared`.
    feedforward: [JointFeedforward; 3],
    is_prepared: bool,
    /// Friction before the next tick was prepared.
    friction_before: [FrictionState<f32>; 3],
    /// What the feedback leaves out at first, so that a run begins without a step.
    start_fade: StartFade,
    /// Largest command of each joint: the block's, or less while its motor is warm [V].
    limit_v: [f32; 3],
    block: ParameterBlock,
    /// Checksums of the block's parts when it was taken.
    fingerprints: Fingerprints,
}

impl Controller {
    /// A controller with a checked block, not running yet: it puts out 0 V.
    pub fn new(block: ParameterBlock) -> Self {
        let rate_per_s = 1.0 / block.sample_period_s;
        Self {
            joints: [0, 1, 2].map(|i| Joint::new(&block, i, rate_per_s)),
            clock: Clock::new(&block, rate_per_s),
            running: false,
            feedforward: Default::default(),
            is_prepared: false,
            friction_before: Default::default(),
            start_fade: StartFade::default(),
            limit_v: [block.command_limit_v; 3],
            fingerprints: block.fingerprints(),
            block,
        }
    }

    /// The parameter block in use.
    pub fn block(&self) -> &ParameterBlock {
        &self.block
    }

    /// Whether the block, and what was derived from it once, are unchanged since it was taken:
    /// a check for corrupted memory.
    pub fn is_intact(&self) -> bool {
        (0..PARTS).all(|part| self.part_is_intact(part)) && self.derived_is_intact()
    }

    /// The same for one part of the block, from 0: as much as a tick has time for.
    pub(crate) fn part_is_intact(&self, part: usize) -> bool {
        self.fingerprints.get(part).is_none_or(|kept| *kept == self.block.part_fingerprint(part))
    }

    /// Whether what was derived from the block once is unchanged.
    pub(crate) fn derived_is_intact(&self) -> bool {
        let rate_per_s = self.clock.rate_per_s;
        rate_per_s == 1.0 / self.block.sample_period_s
            && self.clock.end_tick <= last_tick(&self.block, rate_per_s)
            && self.limit_v.iter().all(|limit_v| *limit_v <= self.block.command_limit_v)
            && (0..3).all(|i| self.joints[i].is_of(&self.block, i))
    }

    /// Limits the commands of joint `index` (0 to 2) from the next tick on, below the block's limit;
    /// `None`: to that.
    #[inline]
    pub(crate) fn limit_command(&mut self, index: usize, limit_v: Option<f32>) {
        let most_v = self.block.command_limit_v;
        if let Some(slot) = self.limit_v.get_mut(index) {
            *slot = limit_v.filter(|limit_v| *limit_v < most_v).unwrap_or(most_v);
        }
    }

    /// Resets the estimators: from the next tick on the counts have another zero.
    pub(crate) fn reset(&mut self) {
        self.joints.iter_mut().for_each(Joint::reset);
        self.is_prepared = false;
    }

    /// Changes the block as corrupted memory would; for tests.
    #[cfg(feature = "fault-injection")]
    pub(crate) fn corrupt_block(&mut self, change: impl FnOnce(&mut ParameterBlock)) {
        change(&mut self.block);
    }

    /// Reference angle of each joint at the first tick of the reference.
    ///
    /// Found by playing that tick on a copy: a second caller of the motions' functions would
    /// keep the compiler from building them into the tick.
    pub fn start_of_reference(&self) -> [Angle; 3] {
        let mut copy = self.clone();
        copy.start();
        copy.tick(&[0; 3]).reference
    }

    /// Begins the reference at the next tick.
    pub fn start(&mut self) {
        self.joints.iter_mut().for_each(Joint::begin_run);
        self.clock = Clock::new(&self.block, self.clock.rate_per_s);
        self.running = true;
        self.start_fade = StartFade::default();
        self.feedforward = Default::default();
        self.is_prepared = false;
    }

    /// Begins the reference at the next tick, with joints at rest at these angles: what the
    /// feedback makes of their distance from its `start` is faded in.
    pub fn start_from(&mut self, start: &[Angle; 3], measured: &[Angle; 3]) {
        self.start();
        self.start_fade = StartFade::new(&self.block, start, measured);
    }

    /// Whether it does more than measure.
    #[inline]
    pub(crate) fn is_running(&self) -> bool {
        self.running
    }

    /// Whether the reference has ended.
    #[inline]
    pub(crate) fn has_ended(&self) -> bool {
        self.clock.tick > self.clock.end_tick
    }

    /// For how long the reference has ended [s].
    #[inline]
    pub fn held_s(&self) -> f32 {
        let ticks = self.clock.tick.saturating_sub(self.clock.end_tick);
        ticks as f32 * self.block.sample_period_s
    }

    /// Ends the reference at the next tick: joints at these velocities brake to rest as fast as
    /// their ranges say that they can, and are held.
    pub fn brake(&mut self, velocity_rad_per_s: &[f32; 3]) {
        if self.clock.tick >= self.clock.end_tick {
            return;
        }
        self.clock.end_now(&self.block, velocity_rad_per_s);
        // Injected voltages, whose state has moved on too, end with the reference.
        if core::mem::take(&mut self.is_prepared) {
            for (joint, before) in self.joints.iter_mut().zip(self.friction_before) {
                joint.friction = before;
            }
        }
    }

    /// Puts out 0 V from the next tick on.
    pub fn stop(&mut self) {
        self.running = false;
    }

    /// Computes what the next tick can know before its counts, after the codes of this one are
    /// out; a tick that finds nothing prepared does it itself. The codes are the same.
    pub fn prepare(&mut self) {
        if !self.running || self.is_prepared {
            return;
        }
        self.friction_before = self.joints.each_ref().map(|joint| joint.friction);
        let Self { clock, block, start_fade, joints, feedforward, .. } = self;
        JointFeedforward::of_tick(clock, block, start_fade, joints, feedforward);
        self.is_prepared = true;
    }

    /// One tick: counts since power-on in, codes out.
    ///
    /// ```
    /// use firmware::{Controller, Gains, Mode, ParameterBlock, store::safe_defaults};
    ///
    /// // Holds all joints at angle zero by feedback alone.
    /// let mut controller = Controller::new(ParameterBlock {
    ///     mode: [Mode::Pd; 3],
    ///     gains: [Gains { proportional_v_per_rad: 80.0, derivative_v_s_per_rad: 4.0 }; 3],
    ///     command_limit_v: 9.0,
    ///     ..safe_defaults()
    /// });
    /// controller.start();
    /// let output = controller.tick(&[0, 0, 655]); // joint 3 is at 6.28 mrad
    /// assert!((output.codes[2].to_volts() + 80.0 * 0.00628).abs() < 1e-3);
    /// ```
    #[inline(never)]
    pub fn tick(&mut self, counts: &[i32; 3]) -> TickOutput {
        let mut samples = Default::default();
        match self.running {
            true => self.act(counts, &mut samples, |_, _| {}),
            false => self.only_measure(counts, &mut samples),
        }
        TickOutput::of(&samples)
    }

    /// A tick of a run, joint by joint; each sample is shown as soon as it is complete.
    #[inline(always)]
    pub(crate) fn act(
        &mut self,
        counts: &[i32; 3],
        samples: &mut [JointSample; 3],
        mut show: impl FnMut(usize, &JointSample),
    ) {
        if !self.is_prepared {
            self.prepare_late();
        }
        let Self { joints, feedforward, block, limit_v, .. } = self;
        let known = feedforward.iter().zip(&block.gains).zip(&block.mode).zip(limit_v);
        let joints = joints.iter_mut().zip(samples).zip(counts).zip(known);
        for (i, (((joint, sample), count), (((known, gains), mode), limit_v))) in joints.enumerate()
        {
            joint.measure(*count, sample);
            let wanted_v = match mode {
                Mode::FrictionOnly => {
                    known.friction_of_measured(i, block, joint, sample) + known.injected_v
                }
                _ => known.command_v(*mode, gains.feedback(known, sample)),
            };
            sample.command(wanted_v, *limit_v);
            sample.reference = known.angle;
            show(i, sample);
        }
        self.clock.tick = self.clock.tick.saturating_add(1);
        self.is_prepared = false;
    }

    #[cold]
    fn prepare_late(&mut self) {
        self.prepare();
    }

    /// A tick outside a run: codes of 0 V.
    #[inline(never)]
    pub(crate) fn only_measure(&mut self, counts: &[i32; 3], samples: &mut [JointSample; 3]) {
        for ((joint, sample), count) in self.joints.iter_mut().zip(samples).zip(counts) {
            *sample = JointSample::default();
            joint.measure(*count, sample);
        }
    }

    /// Motor voltages that gravity takes at these angles [V].
    #[cold]
    pub fn gravity_v(&self, angles: &[Angle; 3]) -> [f32; 3] {
        let robot = &self.block.robot;
        let posture = Posture::from_sines(angles[1].sin_cos(), angles[2].sin_cos());
        robot.torque_to_voltage(&posture.gravity(&robot.base, &robot.geometry))
    }
}

/// The output for a voltage above `limit_v` in magnitude: the limit, or 0 V if it is not finite.
#[cold]
fn cut(voltage_v: f32, limit_v: f32) -> f32 {
    if voltage_v.is_finite() { limit_v.copysign(voltage_v) } else { 0.0 }
}

impl JointFeedforward {
    /// The control law with a reference, see the head of this file.
    #[inline]
    fn command_v(&self, mode: Mode, feedback_v: f32) -> f32 {
        let motor_v = match mode {
            Mode::PdModel => feedback_v + self.friction_v + self.inverse_dynamics_v,
            Mode::PdFriction => feedback_v + self.friction_v,
            Mode::Pd => feedback_v,
            Mode::FrictionOnly | Mode::OpenLoop => 0.0,
        };
        self.input_inverses.applied_to(motor_v + self.injected_v)
    }
}

impl JointSample {
    /// Takes the code of a voltage, which is cut where it is beyond the limit.
    #[inline]
    fn command(&mut self, wanted_v: f32, limit_v: f32) {
        self.code = DacCode::from_volts(wanted_v);
        self.saturated = false;
        // NaN compares false, so it counts as beyond the limit.
        let is_within = wanted_v.abs() <= limit_v;
        if !is_within {
            self.code = DacCode::from_volts(cut(wanted_v, limit_v));
            self.saturated = true;
        }
    }
}

impl Gains {
    /// Feedback voltage, eq. (17), less what is left out as a run begins.
    #[inline]
    fn feedback(&self, wanted: &JointFeedforward, sample: &JointSample) -> f32 {
        let position_error_rad = wanted.angle.minus(sample.measured);
        let velocity_error = wanted.velocity_rad_per_s - sample.velocity_rad_per_s;
        self.proportional_v_per_rad * position_error_rad
            + self.derivative_v_s_per_rad * velocity_error
            - wanted.start_step_v
    }
}
