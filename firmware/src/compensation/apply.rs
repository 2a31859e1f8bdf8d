//! The compensations as the tick evaluates them.

use heapless::Vec;
use model::effects::{
    cable_spring_v, cogging_v, dead_zone_inverse, quadratic_drag_v, ripple_factor,
    scale_asymmetric_friction, scale_position_friction, table_v, torque_constant_factor,
};
use model::friction::FrictionScale;
use model::{Posture, Robot};

use super::parameters::{
    AngularHarmonic, Compensations, ExternalLoad, Feedforward, InputInverse, MAX_INPUT_INVERSES,
};
use super::tables::TableAxis;
use crate::Angle;
use crate::reference::Setpoint;

impl AngularHarmonic {
    /// The wave at an angle, in [-1, 1].
    #[inline]
    pub fn sine(&self, angle: Angle) -> f32 {
        let turned = angle.0.wrapping_mul(i32::from(self.order));
        model::trigonometry::sin_turn(turned.wrapping_add(self.phase.0))
    }
}

impl ExternalLoad {
    /// Its torques [Nm] at an angle of joint 1 and the sines and cosines of joints 2 and 3.
    // Not inlined, so that an arm without external load does not pay for it.
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

/// Motor voltages less what the joints' tables add at the setpoints [V].
// Not inlined, so that a rig without tables does not pay for them.
#[inline(never)]
pub fn less_tables(
    voltage_v: [f32; 3],
    joints: &[Compensations; 3],
    robot: &Robot<f32>,
    wanted: &[Setpoint; 3],
) -> [f32; 3] {
    let mut left_v = voltage_v;
    // Computed once a table lies over it.
    let mut loads_nm = None;
    for i in 0..3 {
        for table in &joints[i].tables {
            let x = match table.axis {
                TableAxis::Position => wanted[i].position_rad,
                TableAxis::Velocity => wanted[i].velocity_rad_per_s,
                TableAxis::Load => loads_nm.get_or_insert_with(|| load_nm(robot, wanted))[i],
            };
            left_v[i] -= table_v(&table.knots, &table.values_v, x);
        }
    }
    left_v
}

/// Coriolis and gravity torques at the setpoints, c + h of eq. (5) [Nm].
#[inline(never)]
fn load_nm(robot: &Robot<f32>, wanted: &[Setpoint; 3]) -> [f32; 3] {
    let Robot { base, geometry, .. } = robot;
    let posture = Posture::from_sines(wanted[1].angle.sin_cos(), wanted[2].angle.sin_cos());
    let coriolis = posture.coriolis(base, geometry, &wanted.map(|w| w.velocity_rad_per_s));
    let gravity = posture.gravity(base, geometry);
    [0, 1, 2].map(|i| coriolis[i] + gravity[i])
}

/// The motion of a joint for which feedforward is computed.
#[derive(Clone, Copy, Debug)]
pub struct JointMotion {
    /// Angle within the turn.
    pub angle: Angle,
    /// Position, turns included [rad].
    pub position_rad: f32,
    /// Velocity [rad/s].
    pub velocity_rad_per_s: f32,
}

/// What the model of a joint lacks, at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Disturbance {
    /// Friction relative to the LuGre model, eq. (9).
    pub friction: FrictionScale<f32>,
    /// Disturbance voltage at the motor [V].
    pub added_v: f32,
}

impl Disturbance {
    /// A joint without effects.
    pub const NONE: Self =
        Self { friction: FrictionScale { level: 1.0, added_v: 0.0, viscous: 1.0 }, added_v: 0.0 };
}

impl Compensations {
    /// The disturbance in a motion.
    #[inline]
    pub fn disturbance(&self, motion: JointMotion) -> Disturbance {
        let mut disturbance = Disturbance::NONE;
        // Checked first: an empty list costs nothing.
        if self.feedforward.is_empty() {
            return disturbance;
        }
        for effect in &self.feedforward {
            effect.add_to(&mut disturbance, motion);
        }
        disturbance
    }
}

impl Feedforward {
    #[inline]
    fn add_to(&self, disturbance: &mut Disturbance, motion: JointMotion) {
        let JointMotion { angle, position_rad, velocity_rad_per_s } = motion;
        let Disturbance { friction, added_v } = disturbance;
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
                scale_position_friction(friction, relative_amplitude, wave.sine(angle));
            }
            Self::AsymmetricFriction { relative_asymmetry } => {
                scale_asymmetric_friction(friction, relative_asymmetry, velocity_rad_per_s);
            }
        }
    }
}

/// The inverses of a joint's input effects at one instant, in the order in which they are applied.
#[derive(Clone, Debug, Default)]
pub struct InputInverses(Vec<Inversion, MAX_INPUT_INVERSES>);

/// One of them, its wave over the turn evaluated.
#[derive(Clone, Copy, Debug)]
enum Inversion {
    Divide(f32),
    Subtract(f32),
    DeadZone(f32),
}

impl InputInverses {
    /// Evaluates them at the reference angle: the last effect is undone first.
    #[inline]
    pub fn evaluate(&mut self, joint: &Compensations, angle: Angle) {
        self.0.clear();
        for effect in joint.input_inverses.iter().rev() {
            // There is room for as many.
            let _ = self.0.push(effect.at(angle));
        }
    }

    /// The command that brings a voltage to the motor [V].
    #[inline]
    pub fn applied_to(&self, motor_v: f32) -> f32 {
        self.0.iter().fold(motor_v, |voltage_v, inversion| match *inversion {
            Inversion::Divide(factor) => voltage_v / factor,
            Inversion::Subtract(offset_v) => voltage_v - offset_v,
            Inversion::DeadZone(half_width_v) => dead_zone_inverse(voltage_v, half_width_v),
        })
    }
}

impl InputInverse {
    /// What undoes the effect at an angle.
    #[inline]
    fn at(&self, angle: Angle) -> Inversion {
        match *self {
            Self::TorqueConstant { relative_error } => {
                Inversion::Divide(torque_constant_factor(relative_error))
            }
            Self::TorqueRipple { relative_amplitude, wave } => {
                Inversion::Divide(ripple_factor(relative_amplitude, wave.sine(angle)))
            }
            Self::DacOffset { offset_v } => Inversion::Subtract(offset_v),
            Self::DeadZone { half_width_v } => Inversion::DeadZone(half_width_v),
        }
    }
}
