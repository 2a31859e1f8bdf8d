//! What is looked at in every tick, joint by joint.

use core::f32::consts::TAU;

use super::fault::{Fault, Implausible};
use crate::{Angle, Mode, ParameterBlock};

/// Ticks over which the velocity estimate is compared with the encoder's way.
const WINDOW_TICKS: u32 = 64;
/// A joint at rest may seem to move so fast [rad/s].
const REST_RAD_PER_S: f32 = 0.05;
/// So far may the velocity estimate be from the encoder's way over a window [rad/s].
const DISAGREEMENT_RAD_PER_S: f32 = 0.1;
/// Counts by which an encoder may dither about a standing joint, and about a smooth motion.
const DITHER_COUNTS: u32 = 3;

/// What a joint does in a tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub count: i32,
    pub velocity_rad_per_s: f32,
    pub measured: Angle,
    pub reference: Angle,
    pub command_v: f32,
    pub saturated: bool,
    pub finite: bool,
}

/// A limit that was exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Excess {
    pub fault: Fault,
    pub value: f32,
    pub limit: f32,
}

impl Excess {
    /// A fault without figures.
    pub fn of(fault: Fault) -> Self {
        Self { fault, value: 0.0, limit: 0.0 }
    }
}

/// The limits of one joint, in the units in which they are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Limits {
    jump_counts: u32,
    speed_rad_per_s: f32,
    tracking_error_rad: f32,
    saturated_ticks: u32,
    stuck_travel_rad: f32,
    stuck_voltage_v: f32,
    stuck_ticks: u32,
}

impl Limits {
    fn of(block: &ParameterBlock, index: usize) -> Self {
        let (safety, period_s) = (&block.safety, block.sample_period_s);
        let counts_per_radian = block.encoder_counts_per_turn as f32 / TAU;
        let acceleration = safety.acceleration_rad_per_s2[index];
        let jump = acceleration * period_s * period_s * counts_per_radian;
        Self {
            // Converting to integers saturates.
            jump_counts: (jump as u32).saturating_add(DITHER_COUNTS),
            speed_rad_per_s: safety.speed_rad_per_s[index],
            tracking_error_rad: safety.tracking_error_rad[index],
            saturated_ticks: (safety.saturation_s / period_s + 0.5) as u32,
            stuck_travel_rad: safety.stuck_travel_rad,
            // Commands that are cut below that must not hide a dead encoder.
            stuck_voltage_v: safety.stuck_voltage_v.min(0.9 * block.command_limit_v),
            stuck_ticks: (safety.stuck_s / period_s + 0.5) as u32,
        }
    }
}

/// One joint under watch.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointMonitor {
    limits: Limits,
    /// Whether the mode has a reference that the joint shall follow.
    follows: bool,
    radians_per_count: f32,
    rate_per_s: f32,
    sample_period_s: f32,
    last_count: i32,
    last_move: i32,
    /// How far the last move differed from the one before.
    jump_counts: u32,
    /// Ticks watched, up to where everything has settled.
    ticks: u32,
    ticks_since_jump: u32,
    saturated_ticks: u32,
    standing: Standing,
    window: Window,
}

/// Since when an encoder stands still.
#[derive(Clone, Copy, Debug, Default)]
struct Standing {
    count: i32,
    reference: Angle,
    /// Ticks at a voltage that should have moved the joint, less those at a smaller one.
    pushed_ticks: u32,
}

/// The estimate against the encoder's way, over some ticks.
#[derive(Clone, Copy, Debug, Default)]
struct Window {
    ticks: u32,
    first_count: i32,
    sum_rad_per_s: f32,
    disagrees: bool,
}

impl JointMonitor {
    /// A watch over joint `index` (0 to 2) with a checked block.
    pub fn new(block: &ParameterBlock, index: usize) -> Self {
        let period_s = block.sample_period_s;
        Self {
            limits: Limits::of(block, index),
            follows: follows(block.mode[index]),
            radians_per_count: TAU / block.encoder_counts_per_turn as f32,
            rate_per_s: 1.0 / period_s,
            sample_period_s: period_s,
            last_count: 0,
            last_move: 0,
            jump_counts: 0,
            ticks: 0,
            ticks_since_jump: WINDOW_TICKS,
            saturated_ticks: 0,
            standing: Standing::default(),
            window: Window::default(),
        }
    }

    /// Whether the limits still are those of the block.
    pub fn has_limits_of(&self, block: &ParameterBlock, index: usize) -> bool {
        let fresh = Self::new(block, index);
        self.limits == fresh.limits
            && self.follows == fresh.follows
            && self.radians_per_count == fresh.radians_per_count
            && self.rate_per_s == fresh.rate_per_s
            && self.sample_period_s == fresh.sample_period_s
    }

    /// The count of the last tick.
    pub fn last_count(&self) -> i32 {
        self.last_count
    }

    /// A run begins: what was counted in another one does not count.
    pub fn begin(&mut self) {
        self.saturated_ticks = 0;
        self.window.ticks = 0;
        self.window.sum_rad_per_s = 0.0;
        self.standing.pushed_ticks = 0;
        self.standing.count = self.last_count.wrapping_add(i32::MIN); // Never near: begins anew.
    }

    /// Takes a tick in which nothing has to be followed: only a joint that cannot be is a fault.
    #[inline]
    pub fn rest(&mut self, seen: &Seen) -> Option<Fault> {
        self.follow_count(seen.count);
        self.compare(seen);
        if self.jump_counts > self.limits.jump_counts {
            self.ticks_since_jump = 0;
            Some(Fault::EncoderJump)
        } else if !(seen.finite && seen.velocity_rad_per_s.is_finite()) {
            Some(Fault::NotFinite)
        } else if seen.velocity_rad_per_s.abs() > self.limits.speed_rad_per_s {
            Some(Fault::Speed)
        } else {
            None
        }
    }

    /// Takes a tick of a run.
    #[inline]
    pub fn run(&mut self, seen: &Seen) -> Option<Fault> {
        let rest = self.rest(seen);
        self.count_saturation(seen.saturated);
        let stuck = self.is_stuck(seen);
        if rest.is_some() {
            rest
        } else if self.follows && tracking_error_rad(seen) > self.limits.tracking_error_rad {
            Some(Fault::TrackingError)
        } else if stuck {
            Some(Fault::EncoderStuck)
        } else if self.saturated_ticks > self.limits.saturated_ticks {
            Some(Fault::Saturation)
        } else {
            None
        }
    }

    /// The figures of a fault that this tick has brought.
    #[cold]
    pub fn excess(&self, fault: Fault, seen: &Seen) -> Excess {
        let limits = &self.limits;
        let radians = |counts: u32| counts as f32 * self.radians_per_count;
        let seconds = |ticks: u32| ticks as f32 * self.sample_period_s;
        let (value, limit) = match fault {
            Fault::EncoderJump => (radians(self.jump_counts), radians(limits.jump_counts)),
            Fault::Speed => (seen.velocity_rad_per_s.abs(), limits.speed_rad_per_s),
            Fault::TrackingError => (tracking_error_rad(seen), limits.tracking_error_rad),
            Fault::EncoderStuck if self.follows => {
                (seen.reference.minus(self.standing.reference).abs(), limits.stuck_travel_rad)
            }
            Fault::EncoderStuck => (seen.command_v.abs(), limits.stuck_voltage_v),
            Fault::Saturation => (seconds(self.saturated_ticks), seconds(limits.saturated_ticks)),
            _ => (0.0, 0.0),
        };
        Excess { fault, value, limit }
    }

    /// Why the estimates must not be trusted, if so.
    pub fn implausible(&self, seen: &Seen) -> Option<Implausible> {
        if !seen.finite || !seen.velocity_rad_per_s.is_finite() {
            Some(Implausible::NotFinite)
        } else if self.ticks < 2 * WINDOW_TICKS {
            Some(Implausible::NotSettled)
        } else if self.ticks_since_jump < WINDOW_TICKS {
            Some(Implausible::Jumped)
        } else if self.window.disagrees {
            Some(Implausible::Disagrees)
        } else if seen.velocity_rad_per_s.abs() > REST_RAD_PER_S {
            Some(Implausible::Moving)
        } else {
            None
        }
    }

    /// How far the encoder's move differs from the one before, zero until one is known.
    #[inline]
    fn follow_count(&mut self, count: i32) {
        let moved = count.wrapping_sub(self.last_count);
        let change = moved.wrapping_sub(self.last_move).unsigned_abs();
        self.last_count = count;
        self.last_move = moved;
        self.ticks_since_jump = self.ticks_since_jump.saturating_add(1);
        if self.ticks < 2 * WINDOW_TICKS {
            self.ticks += 1;
        }
        self.jump_counts = if self.ticks <= 2 { 0 } else { change };
    }

    /// Holds the estimate against the encoder's way, once a window.
    #[inline]
    fn compare(&mut self, seen: &Seen) {
        let window = &mut self.window;
        if window.ticks == WINDOW_TICKS {
            let moved = seen.count.wrapping_sub(window.first_count) as f32;
            let way_rad_per_s =
                moved * self.radians_per_count * self.rate_per_s * (1.0 / WINDOW_TICKS as f32);
            let mean = window.sum_rad_per_s * (1.0 / WINDOW_TICKS as f32);
            // A NaN disagrees.
            let agrees = (mean - way_rad_per_s).abs() <= DISAGREEMENT_RAD_PER_S;
            *window = Window { disagrees: !agrees, ..Window::default() };
        }
        if window.ticks == 0 {
            window.first_count = seen.count;
        }
        window.ticks += 1;
        window.sum_rad_per_s += seen.velocity_rad_per_s;
    }

    #[inline]
    fn count_saturation(&mut self, saturated: bool) {
        self.saturated_ticks = if saturated { self.saturated_ticks.saturating_add(1) } else { 0 };
    }

    /// Whether the encoder stands while its joint must move.
    #[inline]
    fn is_stuck(&mut self, seen: &Seen) -> bool {
        let standing = &mut self.standing;
        if seen.count.wrapping_sub(standing.count).unsigned_abs() > DITHER_COUNTS {
            let (count, reference) = (seen.count, seen.reference);
            *standing = Standing { count, reference, pushed_ticks: 0 };
            return false;
        }
        if self.follows {
            let travel_rad = seen.reference.minus(standing.reference).abs();
            return travel_rad > self.limits.stuck_travel_rad;
        }
        let pushed = seen.command_v.abs() > self.limits.stuck_voltage_v;
        // A voltage that swings to and fro pushes too.
        standing.pushed_ticks = match pushed {
            true => standing.pushed_ticks.saturating_add(1),
            false => standing.pushed_ticks.saturating_sub(1),
        };
        standing.pushed_ticks > self.limits.stuck_ticks
    }
}

#[inline]
fn tracking_error_rad(seen: &Seen) -> f32 {
    seen.reference.minus(seen.measured).abs()
}

/// Whether a mode has a reference that the joint shall follow.
pub(super) fn follows(mode: Mode) -> bool {
    match mode {
        Mode::Pd | Mode::PdFriction | Mode::PdModel => true,
        Mode::FrictionOnly | Mode::OpenLoop => false,
    }
}
