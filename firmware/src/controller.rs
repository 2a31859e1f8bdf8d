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
//! Deadline: the codes are out before the next tick, 1 ms or 170,000 cycles of the
//! STM32G474; `docs/firmware.md` holds the count of instructions, under 2,500.

use model::{FrictionState, Posture};

use crate::Mode;
use crate::block::{Gains, ParameterBlock};
use crate::compensation::{JointMotion, less_tables};
use crate::joint::{Joint, Measured};
use crate::reference::{BRAKING_S, InjectionSource, Setpoint, Time, braking_time_s};
use crate::start_fade::StartFade;
use crate::{Angle, DacCode};

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
}

/// The controller of all three joints.
#[derive(Clone, Debug)]
pub struct Controller {
    joints: [Joint; 3],
    rate_per_s: f32,
    last_tick: u32,
    /// When the reference of this run ends: in its last tick, or before.
    end_tick: u32,
    /// Time in which each joint brakes after that [s].
    braking_s: [f32; 3],
    tick: u32,
    running: bool,
    /// What the feedback leaves out at first, so that a run begins without a step.
    start_fade: StartFade,
    block: ParameterBlock,
    /// Fingerprint of the block when it was taken.
    fingerprint: u32,
}

impl Controller {
    /// A controller with a checked block, not running yet: it puts out 0 V.
    pub fn new(block: ParameterBlock) -> Self {
        let rate_per_s = 1.0 / block.sample_period_s;
        Self {
            joints: [0, 1, 2].map(|i| Joint::new(&block, i, rate_per_s)),
            rate_per_s,
            last_tick: last_tick(&block, rate_per_s),
            end_tick: last_tick(&block, rate_per_s),
            braking_s: [BRAKING_S; 3],
            tick: 0,
            running: false,
            start_fade: StartFade::default(),
            fingerprint: block.fingerprint(),
            block,
        }
    }

    /// The parameter block in use.
    pub fn block(&self) -> &ParameterBlock {
        &self.block
    }

    /// Whether the block, and what was derived from it once, are unchanged since it was taken:
    /// a check for corrupted memory. Some 5,000 instructions and more, `docs/board.md`.
    pub fn is_intact(&self) -> bool {
        let fresh = |i| Joint::new(&self.block, i, self.rate_per_s);
        self.block.fingerprint() == self.fingerprint
            && self.rate_per_s == 1.0 / self.block.sample_period_s
            && self.last_tick == last_tick(&self.block, self.rate_per_s)
            && (0..3).all(|i| self.joints[i].has_scales_of(&fresh(i)))
    }

    /// Resets the estimators: from the next tick on the counts have another zero.
    pub(crate) fn reset(&mut self) {
        self.joints = [0, 1, 2].map(|i| Joint::new(&self.block, i, self.rate_per_s));
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
        for (joint, injection) in self.joints.iter_mut().zip(&self.block.reference.injection) {
            joint.injection = InjectionSource::new(injection, self.rate_per_s);
            joint.friction = FrictionState::default();
        }
        self.tick = 0;
        (self.end_tick, self.braking_s) = (self.last_tick, [BRAKING_S; 3]);
        self.running = true;
        self.start_fade = StartFade::default();
    }

    /// Begins the reference at the next tick, with joints at rest at these angles: what the
    /// feedback makes of their distance from its `start` is faded in.
    pub fn start_from(&mut self, start: &[Angle; 3], measured: &[Angle; 3]) {
        self.start();
        self.start_fade = StartFade::new(&self.block, start, measured);
    }

    /// For how long the reference has ended [s].
    #[inline]
    pub fn held_s(&self) -> f32 {
        self.tick.saturating_sub(self.end_tick) as f32 * self.block.sample_period_s
    }

    /// Ends the reference at the next tick: joints at these velocities brake to rest as fast as
    /// their ranges say that they can, and are held.
    pub fn brake(&mut self, velocity_rad_per_s: &[f32; 3]) {
        if self.tick >= self.end_tick {
            return;
        }
        self.end_tick = self.tick;
        self.braking_s = [0, 1, 2].map(|i| match &self.block.safety.position[i] {
            Some(range) => braking_time_s(velocity_rad_per_s[i], range.braking_rad_per_s2),
            None => BRAKING_S,
        });
    }

    /// Puts out 0 V from the next tick on.
    pub fn stop(&mut self) {
        self.running = false;
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
        let measured = self.measure(counts);
        let mut output = TickOutput {
            measured: measured.map(|m| m.angle),
            velocity_rad_per_s: measured.map(|m| m.velocity_rad_per_s),
            ..TickOutput::default()
        };
        if self.running {
            self.control(&measured, &mut output);
        }
        output
    }

    #[inline]
    fn measure(&mut self, counts: &[i32; 3]) -> [Measured; 3] {
        let [first, second, third] = &mut self.joints;
        [first.measure(counts[0]), second.measure(counts[1]), third.measure(counts[2])]
    }

    /// The control law, see the head of this file.
    #[inline]
    fn control(&mut self, measured: &[Measured; 3], output: &mut TickOutput) {
        let ahead = self.reference_ahead();
        let inverse_dynamics_v = self.less_tables(self.inverse_dynamics(&ahead), &ahead);
        let injected_v = self.injected();
        for i in 0..3 {
            let now = ahead[i].earlier(0.5 * self.block.sample_period_s);
            let feedback_v = self.block.gains[i].feedback(&now, &measured[i]);
            let feedback_v = self.start_fade.applied_to(feedback_v, i, self.tick);
            let motion = self.block.mode[i].feedforward_motion(&ahead[i], &measured[i]);
            let terms = self.terms(i, motion, feedback_v, inverse_dynamics_v[i]);
            let motor_v = terms.sum(self.block.mode[i]) + injected_v[i];
            let wanted_v = self.command_for(i, motor_v, ahead[i].angle);
            let limit_v = self.block.command_limit_v;
            // NaN compares false, so it counts as beyond the limit.
            let within = wanted_v.abs() <= limit_v;
            let command_v = if within { wanted_v } else { cut(wanted_v, limit_v) };
            output.codes[i] = DacCode::from_volts(command_v);
            output.saturated[i] = !within;
            output.reference[i] = now.angle;
        }
        self.tick = self.tick.saturating_add(1);
    }

    /// Feedback and feedforward of joint `i` (0 to 2), disturbance included.
    #[inline]
    fn terms(&mut self, i: usize, motion: JointMotion, feedback_v: f32, dynamics_v: f32) -> Terms {
        let disturbance = self.block.compensations[i].disturbance(motion);
        let friction_v = self.joints[i].friction.step_scaled(
            &self.block.robot.friction[i],
            disturbance.friction,
            motion.velocity_rad_per_s,
            self.block.sample_period_s,
        );
        Terms { feedback_v, inverse_dynamics_v: dynamics_v - disturbance.added_v, friction_v }
    }

    /// The command that brings a voltage to the motor, in the modes that know the model.
    #[inline]
    fn command_for(&self, i: usize, motor_v: f32, angle: Angle) -> f32 {
        match self.block.mode[i] {
            Mode::PdFriction | Mode::PdModel => {
                self.block.compensations[i].command_for(motor_v, angle)
            }
            Mode::Pd | Mode::FrictionOnly | Mode::OpenLoop => motor_v,
        }
    }

    /// The setpoints in the middle of the interval that begins with this tick.
    #[inline]
    fn reference_ahead(&self) -> [Setpoint; 3] {
        let tick = if self.tick < self.end_tick { self.tick } else { self.end_tick };
        let time = Time::new(tick, self.block.sample_period_s, self.rate_per_s);
        let since_end_s = (self.tick - tick) as f32 * self.block.sample_period_s;
        let mut wanted = self.block.reference.motion.each_ref().map(|motion| motion.at(time));
        if tick == self.end_tick {
            for (setpoint, braking_s) in wanted.iter_mut().zip(self.braking_s) {
                *setpoint = setpoint.brought_to_rest(since_end_s, braking_s);
            }
        }
        wanted
    }

    /// Motor voltages of the reference, the inverse dynamics of eq. (3), less the external load's.
    #[inline]
    fn inverse_dynamics(&self, wanted: &[Setpoint; 3]) -> [f32; 3] {
        let robot = &self.block.robot;
        let (second, third) = (wanted[1].angle.sin_cos(), wanted[2].angle.sin_cos());
        let torque_nm = Posture::from_sines(second, third).inverse_dynamics(
            &robot.base,
            &robot.geometry,
            &wanted.map(|w| w.velocity_rad_per_s),
            &wanted.map(|w| w.acceleration_rad_per_s2),
        );
        let torque_nm = match &self.block.external_load {
            None => torque_nm,
            Some(load) => {
                let less = load.torque(robot, wanted[0].angle, second, third);
                [0, 1, 2].map(|i| torque_nm[i] - less[i])
            }
        };
        robot.torque_to_voltage(&torque_nm)
    }

    /// Motor voltages that gravity takes at these angles [V].
    #[cold]
    pub fn gravity_v(&self, angles: &[Angle; 3]) -> [f32; 3] {
        let robot = &self.block.robot;
        let posture = Posture::from_sines(angles[1].sin_cos(), angles[2].sin_cos());
        robot.torque_to_voltage(&posture.gravity(&robot.base, &robot.geometry))
    }

    /// Motor voltages less what tables add at the reference.
    #[inline]
    fn less_tables(&self, voltage_v: [f32; 3], wanted: &[Setpoint; 3]) -> [f32; 3] {
        let joints = &self.block.compensations;
        // Checked first: no tables cost nothing.
        if joints.iter().all(|joint| joint.tables.is_empty()) {
            return voltage_v;
        }
        less_tables(voltage_v, joints, &self.block.robot, wanted)
    }

    /// Injected voltages; none once the reference has ended.
    #[inline]
    fn injected(&mut self) -> [f32; 3] {
        if self.tick >= self.end_tick {
            return [0.0; 3];
        }
        let time = Time::new(self.tick, self.block.sample_period_s, self.rate_per_s);
        let [first, second, third] = &mut self.joints;
        [first, second, third].map(|joint| joint.injection.next_voltage(time))
    }
}

/// The terms of a joint's command [V].
#[derive(Clone, Copy, Debug)]
struct Terms {
    feedback_v: f32,
    inverse_dynamics_v: f32,
    friction_v: f32,
}

impl Terms {
    /// The terms that a mode takes, added up.
    #[inline]
    fn sum(&self, mode: Mode) -> f32 {
        match mode {
            Mode::Pd => self.feedback_v,
            Mode::PdFriction => self.feedback_v + self.friction_v,
            Mode::PdModel => self.feedback_v + self.friction_v + self.inverse_dynamics_v,
            Mode::FrictionOnly => self.friction_v,
            Mode::OpenLoop => 0.0,
        }
    }
}

impl Mode {
    /// The velocity whose friction is compensated: the reference's, or the measured one in the
    /// mode without a reference.
    #[inline]
    fn friction_velocity(self, wanted: &Setpoint, measured: &Measured) -> f32 {
        match self {
            Self::FrictionOnly => measured.velocity_rad_per_s,
            _ => wanted.velocity_rad_per_s,
        }
    }

    /// The motion for which feedforward is computed.
    #[inline]
    fn feedforward_motion(self, wanted: &Setpoint, measured: &Measured) -> JointMotion {
        JointMotion {
            angle: if self == Self::FrictionOnly { measured.angle } else { wanted.angle },
            position_rad: wanted.position_rad,
            velocity_rad_per_s: self.friction_velocity(wanted, measured),
        }
    }
}

/// The tick in which the reference ends.
fn last_tick(block: &ParameterBlock, rate_per_s: f32) -> u32 {
    (block.reference.duration_s * rate_per_s + 0.5) as u32
}

/// The output for a voltage above `limit_v` in magnitude: the limit, or 0 V if it is not finite.
#[cold]
fn cut(voltage_v: f32, limit_v: f32) -> f32 {
    if voltage_v.is_finite() { limit_v.copysign(voltage_v) } else { 0.0 }
}

impl Gains {
    /// Feedback voltage, eq. (17).
    #[inline]
    fn feedback(&self, wanted: &Setpoint, measured: &Measured) -> f32 {
        let position_error_rad = wanted.angle.minus(measured.angle);
        let velocity_error = wanted.velocity_rad_per_s - measured.velocity_rad_per_s;
        self.proportional_v_per_rad * position_error_rad
            + self.derivative_v_s_per_rad * velocity_error
    }
}
