//! The checks of every tick, joint by joint.

use core::f32::consts::TAU;

use super::fault::{Fault, Implausible};
use super::joint_limits::{DITHER_COUNTS, Limits, SATURATION_WEIGHT};
use super::range_monitor::RangeMonitor;
use super::stall::StallMonitor;
use crate::joint::JointSample;
use crate::{Angle, Mode, ParameterBlock};

/// Ticks over which the velocity estimate is compared with the encoder's travel.
const WINDOW_TICKS: u32 = 64;
/// Largest velocity estimate of a joint that counts as at rest [rad/s].
const REST_RAD_PER_S: f32 = 0.05;
/// Largest difference between the mean velocity estimate and the encoder's over a window [rad/s].
const DISAGREEMENT_RAD_PER_S: f32 = 0.1;
/// A limit that was exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LimitViolation {
    pub fault: Fault,
    pub value: f32,
    pub limit: f32,
}

impl LimitViolation {
    /// A fault without figures.
    pub fn of(fault: Fault) -> Self {
        Self { fault, value: 0.0, limit: 0.0 }
    }
}

/// The monitor of one joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointMonitor {
    limits: Limits,
    /// Whether the mode tracks a reference.
    has_reference: bool,
    radians_per_count: f32,
    rate_per_s: f32,
    sample_period_s: f32,
    last_count: i32,
    last_move: i32,
    /// How far the last move differed from the one before.
    jump_counts: u32,
    /// Ticks seen so far, counted until the estimates have settled.
    ticks: u32,
    ticks_since_jump: u32,
    /// The command of the last tick was cut.
    was_cut: bool,
    /// Ticks at the limit, [`SATURATION_WEIGHT`] each, less those below it.
    saturated_quarters: u32,
    standstill: Standstill,
    stall: StallMonitor,
    range: RangeMonitor,
    window: Window,
}

/// Since when an encoder has not moved.
#[derive(Clone, Copy, Debug, Default)]
struct Standstill {
    count: i32,
    reference: Angle,
    /// Ticks at a voltage that should have moved the joint, less those at a smaller one.
    pushed_ticks: u32,
}

/// The velocity estimate against the encoder's travel, over some ticks.
#[derive(Clone, Copy, Debug, Default)]
struct Window {
    ticks: u32,
    first_count: i32,
    sum_rad_per_s: f32,
    disagrees: bool,
}

impl JointMonitor {
    /// The monitor of joint `index` (0 to 2) with a checked block.
    pub fn new(block: &ParameterBlock, index: usize) -> Self {
        // The compiler sees that no index below can be out of bounds: the tick comes here.
        let index = index.min(2);
        let period_s = block.sample_period_s;
        Self {
            limits: Limits::of(block, index, has_reference(block.mode[index])),
            has_reference: has_reference(block.mode[index]),
            radians_per_count: TAU / block.encoder_counts_per_turn as f32,
            rate_per_s: 1.0 / period_s,
            sample_period_s: period_s,
            last_count: 0,
            last_move: 0,
            jump_counts: 0,
            ticks: 0,
            ticks_since_jump: WINDOW_TICKS,
            was_cut: false,
            saturated_quarters: 0,
            standstill: Standstill::default(),
            stall: StallMonitor::new(block, index),
            range: RangeMonitor::new(block, index),
            window: Window::default(),
        }
    }

    /// Whether the limits still are those of the block.
    pub fn has_limits_of(&self, block: &ParameterBlock, index: usize) -> bool {
        let fresh = Self::new(block, index);
        self.limits == fresh.limits
            && self.stall.fresh() == fresh.stall
            && self.range == fresh.range
            && self.has_reference == fresh.has_reference
            && self.radians_per_count == fresh.radians_per_count
            && self.rate_per_s == fresh.rate_per_s
            && self.sample_period_s == fresh.sample_period_s
    }

    /// The count of the last tick.
    pub fn last_count(&self) -> i32 {
        self.last_count
    }

    /// Begins a run: resets what an earlier one has counted.
    pub fn begin_run(&mut self) {
        self.saturated_quarters = 0;
        self.stall.moves();
        self.window.ticks = 0;
        self.window.sum_rad_per_s = 0.0;
        self.standstill.pushed_ticks = 0;
        self.standstill.count = self.last_count.wrapping_add(i32::MIN); // Out of reach: the next count restarts it.
    }

    /// Takes a tick in; whether it must be looked at closely, for a fault or not.
    #[inline(always)]
    pub fn is_suspicious(&mut self, sample: &JointSample, running: bool) -> bool {
        self.track_count(sample.count);
        self.was_cut = sample.saturated;
        let stands = running && self.is_cut_or_stands(sample);
        stands
            || self.jump_counts > self.limits.jump_counts
            || !self.limits.allow_speed(sample.velocity_rad_per_s)
            || running && error_units(sample) >= self.limits.far_units
            || running && self.range.is_left_by(sample)
            || !sample.is_finite()
    }

    /// What is wrong in the tick that was just taken in; stall and range are looked at apart.
    #[cold]
    pub fn fault(&self, sample: &JointSample, running: bool) -> Option<Fault> {
        let limits = &self.limits;
        if self.jumps() {
            Some(Fault::EncoderJump)
        } else if !(sample.is_finite() && sample.velocity_rad_per_s.is_finite()) {
            Some(Fault::NotFinite)
        } else if sample.velocity_rad_per_s.abs() > limits.speed_rad_per_s {
            Some(Fault::Speed)
        } else if !running {
            None
        } else if self.has_reference && tracking_error_rad(sample) > limits.tracking_error_rad {
            Some(Fault::TrackingError)
        } else if self.is_stuck(sample) {
            Some(Fault::EncoderStuck)
        } else if self.saturated_quarters > limits.saturated_quarters {
            Some(Fault::Saturation)
        } else {
            None
        }
    }

    /// Whether the encoder has jumped; its first two moves mean nothing.
    fn jumps(&self) -> bool {
        self.ticks >= 2 && self.jump_counts > self.limits.jump_counts
    }

    /// Whether the command of the last tick was cut.
    pub fn was_cut(&self) -> bool {
        self.was_cut
    }

    /// Counts, and whether it is time to look what holds the joint.
    #[inline]
    pub fn stall(&mut self) -> &mut StallMonitor {
        &mut self.stall
    }

    /// The range of the joint.
    pub fn range(&self) -> &RangeMonitor {
        &self.range
    }

    /// What friction and the model's errors may hold [V].
    pub fn stall_limit_v(&self) -> f32 {
        self.stall.limit_v()
    }

    /// Value and limit of a fault found in this tick.
    #[cold]
    pub fn violation(&self, fault: Fault, sample: &JointSample) -> LimitViolation {
        let limits = &self.limits;
        let radians = |counts: u32| counts as f32 * self.radians_per_count;
        let seconds = |quarters: u32| (quarters / SATURATION_WEIGHT) as f32 * self.sample_period_s;
        let (value, limit) = match fault {
            Fault::EncoderJump => (radians(self.jump_counts), radians(limits.jump_counts)),
            Fault::Speed => (sample.velocity_rad_per_s.abs(), limits.speed_rad_per_s),
            Fault::TrackingError => (tracking_error_rad(sample), limits.tracking_error_rad),
            Fault::EncoderStuck if self.has_reference => {
                (sample.reference.minus(self.standstill.reference).abs(), limits.stuck_travel_rad)
            }
            Fault::EncoderStuck => (sample.command_v().abs(), limits.stuck_voltage_v),
            Fault::PositionLimit => {
                self.range.leaves(sample.count, sample.velocity_rad_per_s).unwrap_or_default()
            }
            Fault::Saturation => {
                (seconds(self.saturated_quarters), seconds(limits.saturated_quarters))
            }
            _ => (0.0, 0.0),
        };
        LimitViolation { fault, value, limit }
    }

    /// Why the estimates are implausible, if they are.
    pub fn implausible(&self, sample: &JointSample) -> Option<Implausible> {
        if !sample.is_finite() || !sample.velocity_rad_per_s.is_finite() {
            Some(Implausible::NotFinite)
        } else if self.ticks < 2 * WINDOW_TICKS {
            Some(Implausible::NotSettled)
        } else if self.ticks_since_jump < WINDOW_TICKS {
            Some(Implausible::Jumped)
        } else if self.window.disagrees {
            Some(Implausible::Disagrees)
        } else if sample.velocity_rad_per_s.abs() > REST_RAD_PER_S {
            Some(Implausible::Moving)
        } else {
            None
        }
    }

    /// The change of the encoder's step from the one before.
    #[inline]
    fn track_count(&mut self, count: i32) {
        let moved = count.wrapping_sub(self.last_count);
        self.jump_counts = moved.wrapping_sub(self.last_move).unsigned_abs();
        self.last_count = count;
        self.last_move = moved;
    }

    /// The rest of a tick, on which no code depends.
    #[inline]
    pub fn complete(&mut self, sample: &JointSample) {
        self.ticks_since_jump =
            if self.jumps() { 0 } else { self.ticks_since_jump.saturating_add(1) };
        if self.ticks < 2 * WINDOW_TICKS {
            self.ticks += 1;
        }
        self.compare_velocity(sample);
    }

    /// Compares the estimate with the encoder's travel, once a window.
    #[inline]
    fn compare_velocity(&mut self, sample: &JointSample) {
        let window = &mut self.window;
        if window.ticks == WINDOW_TICKS {
            let moved = sample.count.wrapping_sub(window.first_count) as f32;
            let encoder_rad_per_s =
                moved * self.radians_per_count * self.rate_per_s * (1.0 / WINDOW_TICKS as f32);
            let mean = window.sum_rad_per_s * (1.0 / WINDOW_TICKS as f32);
            // A NaN disagrees.
            let agrees = (mean - encoder_rad_per_s).abs() <= DISAGREEMENT_RAD_PER_S;
            *window = Window { disagrees: !agrees, ..Window::default() };
        }
        if window.ticks == 0 {
            window.first_count = sample.count;
        }
        window.ticks += 1;
        window.sum_rad_per_s += sample.velocity_rad_per_s;
    }

    /// Counts what goes on for many ticks; whether it has gone on for too long.
    #[inline(always)]
    fn is_cut_or_stands(&mut self, sample: &JointSample) -> bool {
        let is_cut = (sample.saturated || self.saturated_quarters != 0)
            && self.count_saturation(sample.saturated);
        let moved = sample.count.wrapping_sub(self.standstill.count).unsigned_abs();
        if moved <= DITHER_COUNTS {
            return self.stands(sample) || is_cut;
        }
        let (count, reference) = (sample.count, sample.reference);
        self.standstill = Standstill { count, reference, pushed_ticks: 0 };
        self.stall.moves();
        is_cut
    }

    /// Whether the command was at its limit for too long.
    #[inline(never)]
    fn count_saturation(&mut self, saturated: bool) -> bool {
        let quarters = self.saturated_quarters;
        self.saturated_quarters = match saturated {
            true => quarters.saturating_add(SATURATION_WEIGHT),
            false => quarters.saturating_sub(1),
        };
        self.saturated_quarters > self.limits.saturated_quarters
    }

    /// Counts a tick in which the encoder has not moved; whether its joint must have.
    #[inline(never)]
    fn stands(&mut self, sample: &JointSample) -> bool {
        if self.has_reference {
            self.stall.stands(sample.command_v());
            return self.is_stuck(sample) || self.stall.is_due();
        }
        let pushed = sample.command_v().abs() > self.limits.stuck_voltage_v;
        // A voltage that swings to and fro pushes too.
        let ticks = self.standstill.pushed_ticks;
        self.standstill.pushed_ticks =
            if pushed { ticks.saturating_add(1) } else { ticks.saturating_sub(1) };
        self.is_stuck(sample)
    }

    /// Whether the encoder has stood for so long that its joint must have moved.
    #[inline]
    fn is_stuck(&self, sample: &JointSample) -> bool {
        let standstill = &self.standstill;
        if self.has_reference {
            let travel_rad = sample.reference.minus(standstill.reference).abs();
            return travel_rad > self.limits.stuck_travel_rad;
        }
        standstill.pushed_ticks > self.limits.stuck_ticks
    }
}

#[inline]
fn tracking_error_rad(sample: &JointSample) -> f32 {
    sample.reference.minus(sample.measured).abs()
}

/// Distance from the reference, in the units of an [`Angle`].
#[inline]
fn error_units(sample: &JointSample) -> u32 {
    sample.reference.0.wrapping_sub(sample.measured.0).unsigned_abs()
}

/// Whether a mode tracks a reference.
pub(super) fn has_reference(mode: Mode) -> bool {
    match mode {
        Mode::Pd | Mode::PdFriction | Mode::PdModel => true,
        Mode::FrictionOnly | Mode::OpenLoop => false,
    }
}
