//! The part of a tick that its number alone decides: references, the model's terms and the
//! injected voltages of all joints, computed once the codes of the tick before are out.

use model::Posture;

use crate::block::ParameterBlock;
use crate::compensation::{InputInverses, JointMotion, less_tables};
use crate::joint::{Joint, JointSample};
use crate::reference::{BRAKING_S, Setpoint, Time, braking_time_s};
use crate::start_fade::StartFade;
use crate::{Angle, Mode};

/// When a run is, and how its reference ends.
#[derive(Clone, Debug)]
pub(crate) struct Clock {
    pub rate_per_s: f32,
    /// Ticks since the run began.
    pub tick: u32,
    /// When the reference of this run ends: in its last tick, or before.
    pub end_tick: u32,
    /// Time in which each joint brakes after that [s].
    pub braking_s: [f32; 3],
}

impl Clock {
    pub fn new(block: &ParameterBlock, rate_per_s: f32) -> Self {
        let end_tick = last_tick(block, rate_per_s);
        Self { rate_per_s, tick: 0, end_tick, braking_s: [BRAKING_S; 3] }
    }

    /// Ends the reference at this tick, as fast as the ranges of the joints say that they can.
    pub fn end_now(&mut self, block: &ParameterBlock, velocity_rad_per_s: &[f32; 3]) {
        self.end_tick = self.tick;
        self.braking_s = [0, 1, 2].map(|i| match &block.safety.position[i] {
            Some(range) => braking_time_s(velocity_rad_per_s[i], range.braking_rad_per_s2),
            None => BRAKING_S,
        });
    }

    /// The setpoints in the middle of the interval that begins with this tick.
    #[inline]
    fn reference_ahead(&self, block: &ParameterBlock) -> [Setpoint; 3] {
        let tick = if self.tick < self.end_tick { self.tick } else { self.end_tick };
        let time = Time::new(tick, block.sample_period_s, self.rate_per_s);
        let since_end_s = (self.tick - tick) as f32 * block.sample_period_s;
        let mut wanted = block.reference.motion.each_ref().map(|motion| motion.at(time));
        if tick == self.end_tick {
            for (setpoint, braking_s) in wanted.iter_mut().zip(self.braking_s) {
                *setpoint = setpoint.brought_to_rest(since_end_s, braking_s);
            }
        }
        wanted
    }

    /// The time for injected voltages; none once the reference has ended.
    #[inline]
    fn injects_at(&self, period_s: f32) -> Option<Time> {
        (self.tick < self.end_tick).then(|| Time::new(self.tick, period_s, self.rate_per_s))
    }
}

/// The tick in which the reference ends.
pub(crate) fn last_tick(block: &ParameterBlock, rate_per_s: f32) -> u32 {
    (block.reference.duration_s * rate_per_s + 0.5) as u32
}

/// What a joint's tick can know before its counts.
#[derive(Clone, Debug, Default)]
pub(crate) struct JointFeedforward {
    /// Reference at the tick itself, for the feedback.
    pub angle: Angle,
    pub velocity_rad_per_s: f32,
    /// Reference in the middle of the interval, turns included [rad].
    position_rad: f32,
    /// What the feedback leaves out as a run begins [V].
    pub start_step_v: f32,
    pub friction_v: f32,
    pub inverse_dynamics_v: f32,
    pub injected_v: f32,
    pub input_inverses: InputInverses,
}

impl JointFeedforward {
    /// Of all joints; moves the states of friction and injected voltages on by a tick.
    #[inline(never)]
    pub fn of_tick(
        clock: &Clock,
        block: &ParameterBlock,
        start_fade: &StartFade,
        joints: &mut [Joint; 3],
        terms: &mut [Self; 3],
    ) {
        let ahead = clock.reference_ahead(block);
        let dynamics_v = tables_taken_off(inverse_dynamics(block, &ahead), block, &ahead);
        let injects_at = clock.injects_at(block.sample_period_s);
        for (i, (joint, terms)) in joints.iter_mut().zip(terms).enumerate() {
            let now = ahead[i].earlier(0.5 * block.sample_period_s);
            (terms.angle, terms.velocity_rad_per_s) = (now.angle, now.velocity_rad_per_s);
            terms.position_rad = ahead[i].position_rad;
            terms.start_step_v = start_fade.left_out_v(i, clock.tick);
            terms.injected_v = injects_at.map_or(0.0, |time| joint.injection.next_voltage(time));
            terms.add_model(i, block, joint, &ahead[i], dynamics_v[i]);
        }
    }

    /// The terms of the modes that know the model, at the setpoint of joint `i` (0 to 2).
    #[inline]
    fn add_model(
        &mut self,
        i: usize,
        block: &ParameterBlock,
        joint: &mut Joint,
        ahead: &Setpoint,
        dynamics_v: f32,
    ) {
        if !matches!(block.mode[i], Mode::PdFriction | Mode::PdModel) {
            return;
        }
        let motion = JointMotion {
            angle: ahead.angle,
            position_rad: ahead.position_rad,
            velocity_rad_per_s: ahead.velocity_rad_per_s,
        };
        let (friction_v, disturbance_v) = friction_and_disturbance(i, block, joint, motion);
        self.friction_v = friction_v;
        self.inverse_dynamics_v = dynamics_v - disturbance_v;
        self.input_inverses.evaluate(&block.compensations[i], ahead.angle);
    }

    /// Friction of the measured motion of joint `i` (0 to 2) [V], for the mode without a reference.
    // Not inlined, so that the other modes do not pay for it.
    #[inline(never)]
    pub fn friction_of_measured(
        &self,
        i: usize,
        block: &ParameterBlock,
        joint: &mut Joint,
        sample: &JointSample,
    ) -> f32 {
        let motion = JointMotion {
            angle: sample.measured,
            position_rad: self.position_rad,
            velocity_rad_per_s: sample.velocity_rad_per_s,
        };
        friction_and_disturbance(i, block, joint, motion).0
    }
}

/// Friction of joint `i` (0 to 2) and what else disturbs it in a motion [V].
#[inline]
fn friction_and_disturbance(
    i: usize,
    block: &ParameterBlock,
    joint: &mut Joint,
    motion: JointMotion,
) -> (f32, f32) {
    let disturbance = block.compensations[i].disturbance(motion);
    let friction_v = joint.friction.step_scaled(
        &block.robot.friction[i],
        disturbance.friction,
        motion.velocity_rad_per_s,
        block.sample_period_s,
    );
    (friction_v, disturbance.added_v)
}

/// Motor voltages of the reference, the inverse dynamics of eq. (3), less the external load's.
#[inline]
fn inverse_dynamics(block: &ParameterBlock, wanted: &[Setpoint; 3]) -> [f32; 3] {
    let robot = &block.robot;
    let (second, third) = (wanted[1].angle.sin_cos(), wanted[2].angle.sin_cos());
    let torque_nm = Posture::from_sines(second, third).inverse_dynamics(
        &robot.base,
        &robot.geometry,
        &wanted.map(|w| w.velocity_rad_per_s),
        &wanted.map(|w| w.acceleration_rad_per_s2),
    );
    let torque_nm = match &block.external_load {
        None => torque_nm,
        Some(load) => {
            let less = load.torque(robot, wanted[0].angle, second, third);
            [0, 1, 2].map(|i| torque_nm[i] - less[i])
        }
    };
    robot.torque_to_voltage(&torque_nm)
}

/// Motor voltages less what tables add at the reference.
#[inline]
fn tables_taken_off(
    voltage_v: [f32; 3],
    block: &ParameterBlock,
    wanted: &[Setpoint; 3],
) -> [f32; 3] {
    let joints = &block.compensations;
    // Checked first: no tables cost nothing.
    if joints.iter().all(|joint| joint.tables.is_empty()) {
        return voltage_v;
    }
    less_tables(voltage_v, joints, &block.robot, wanted)
}
