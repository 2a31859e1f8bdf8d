//! What the tick makes of a block's compensations.

use model::effects::{
    cable_spring_v, cogging_v, dead_zone_command, favour_a_direction, quadratic_drag_v,
    ripple_factor, torque_constant_factor, vary_friction,
};
use model::friction::FrictionScale;
use model::{Posture, Robot};

use super::parameters::{Compensations, FedForward, Outside, TurnWave, Undone};
use crate::Angle;

impl TurnWave {
    /// The wave at an angle, in [-1, 1].
    #[inline]
    pub fn sine(&self, angle: Angle) -> f32 {
        let turned = angle.0.wrapping_mul(i32::from(self.harmonic));
        model::trigonometry::sin_turn(turned.wrapping_add(self.phase.0))
    }
}

impl Outside {
    /// Its torques [Nm] at an angle of joint 1 and the sines and cosines of joints 2 and 3.
    // Not inlined: an arm without it shall not pay for it.
    #[inline(never)]
    pub fn torque(
        &self,
        robot: &Robot<f32>,
        first: Angle,
        second: (f32, f32),
        third: (f32, f32),
    ) -> [f32; 3] {
        let Robot { base, geometry, .. } = robot;
        let (posture, turned) = (Posture::from_sines(second, third), first.sin_cos());
        let leaning = self.tilt.torque(turned, &posture, base, geometry);
        let pushed = posture.tip_force_torque(turned, geometry, &self.tip_force_n);
        [0, 1, 2].map(|i| leaning[i] + pushed[i])
    }
}

/// The motion of a joint that is fed forward.
#[derive(Clone, Copy, Debug)]
pub struct Moving {
    /// Where within the turn.
    pub angle: Angle,
    /// Where, turns included [rad].
    pub position_rad: f32,
    /// How fast [rad/s].
    pub velocity_rad_per_s: f32,
}

/// What a joint does beyond the model.
#[derive(Clone, Copy, Debug)]
pub struct Beyond {
    /// How its friction differs from eq. (9).
    pub friction: FrictionScale<f32>,
    /// What the motor finds added to its own voltage [V].
    pub added_v: f32,
}

impl Beyond {
    /// A joint that does as the model says.
    pub const NOTHING: Self =
        Self { friction: FrictionScale { level: 1.0, added_v: 0.0, viscous: 1.0 }, added_v: 0.0 };
}

impl Compensations {
    /// What the joint does beyond the model in a motion.
    #[inline]
    pub fn beyond(&self, motion: Moving) -> Beyond {
        let mut beyond = Beyond::NOTHING;
        // Asked first, so that nothing is made ready where there is nothing.
        if self.fed_forward.is_empty() {
            return beyond;
        }
        for effect in &self.fed_forward {
            effect.add_to(&mut beyond, motion);
        }
        beyond
    }

    /// The command that brings a voltage to the motor, at the angle that is wanted.
    #[inline]
    pub fn command_for(&self, motor_v: f32, angle: Angle) -> f32 {
        if self.undone.is_empty() { motor_v } else { self.some_command_for(motor_v, angle) }
    }

    // Not inlined: a joint without shall not pay for it.
    #[inline(never)]
    fn some_command_for(&self, motor_v: f32, angle: Angle) -> f32 {
        let last_first = self.undone.iter().rev();
        last_first.fold(motor_v, |voltage_v, effect| effect.undo(voltage_v, angle))
    }
}

impl FedForward {
    #[inline]
    fn add_to(&self, beyond: &mut Beyond, motion: Moving) {
        let Moving { angle, position_rad, velocity_rad_per_s } = motion;
        let Beyond { friction, added_v } = beyond;
        match *self {
            Self::Cogging { amplitude_v, wave } => {
                *added_v += cogging_v(amplitude_v, wave.sine(angle));
            }
            Self::CableSpring { stiffness_v_per_rad, rest_rad } => {
                *added_v += cable_spring_v(stiffness_v_per_rad, position_rad, rest_rad);
            }
            Self::QuadraticDrag { coefficient_v_s2_per_rad2 } => {
                *added_v += quadratic_drag_v(coefficient_v_s2_per_rad2, velocity_rad_per_s);
            }
            Self::PositionFriction { relative_amplitude, wave } => {
                vary_friction(friction, relative_amplitude, wave.sine(angle));
            }
            Self::AsymmetricFriction { relative_asymmetry } => {
                favour_a_direction(friction, relative_asymmetry, velocity_rad_per_s);
            }
        }
    }
}

impl Undone {
    /// The voltage that must go in for this one to come out.
    #[inline]
    fn undo(&self, voltage_v: f32, angle: Angle) -> f32 {
        match *self {
            Self::TorqueConstant { relative_error } => {
                voltage_v / torque_constant_factor(relative_error)
            }
            Self::TorqueRipple { relative_amplitude, wave } => {
                voltage_v / ripple_factor(relative_amplitude, wave.sine(angle))
            }
            Self::DacOffset { offset_v } => voltage_v - offset_v,
            Self::DeadZone { half_width_v } => dead_zone_command(voltage_v, half_width_v),
        }
    }
}
