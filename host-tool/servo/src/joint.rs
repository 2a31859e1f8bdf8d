//! A joint under a position servo: the drive's law, friction, rotor, and what effects change.

use files::ArmJoint;

use crate::error::ServoError;
use crate::over_speed::OverSpeed;

/// Parameters of a joint, in the units of the joint (rad or m) and of the drive (V); torque is
/// `torque_constant` times volts.
///
/// The drive makes u = stiffness (goal - q) - damping qd, limited to +-limit. What stands below
/// `read_after_s` is neutral where no effect is hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoJoint {
    /// Torque by volt [Nm/V; N/V].
    pub torque_constant: f64,
    /// Volts by distance to the goal [V/rad; V/m].
    pub stiffness: f64,
    /// Volts against velocity [V s/rad; V s/m].
    pub damping: f64,
    /// Largest voltage [V].
    pub limit: f64,
    /// The rotor seen at the joint [kg m^2; kg].
    pub rotor: f64,
    /// Coulomb level [V].
    pub coulomb: f64,
    /// Static level above Coulomb's [V].
    pub stribeck: f64,
    /// Stribeck velocity [rad/s; m/s].
    pub stribeck_velocity: f64,
    /// Viscous coefficient [V s/rad; V s/m].
    pub viscous: f64,
    /// What gravity's torque on the joint is multiplied with.
    pub gravity: f64,
    /// How long after a row's goal its position was read [s]; negative where goals act late.
    pub read_after_s: f64,
    /// Friction by the motor's torque [V/Nm].
    pub motor_load_friction: f64,
    /// Friction by the torque of the rigid body on the joint [V/Nm].
    pub joint_load_friction: f64,
    /// All friction times 1 + e forwards, 1 - e backwards.
    pub asymmetry: f64,
    /// Viscous friction alone, likewise.
    pub viscous_asymmetry: f64,
    /// Velocity squared, against the motion [V s^2/rad^2].
    pub drag: f64,
    /// Friction more than Coulomb's and viscous [V], over speed [rad/s; m/s].
    pub over_speed: OverSpeed,
    /// First-order lag from u to torque [s].
    pub lag_s: f64,
    /// Volts that the amplifier swallows.
    pub dead_zone: f64,
    /// Volts that are always there.
    pub offset: f64,
    /// A sin(n q + phi), added to u [V, 1/rad, rad].
    pub cogging: [f64; 3],
    /// -k (q - q0), added to u [V/rad].
    pub spring: f64,
    /// q0 of that [rad].
    pub spring_rest: f64,
    /// Friction times 1 + e (1 - exp(-t/T)).
    pub drift: f64,
    /// T of that [s].
    pub drift_time_s: f64,
    /// Play between the servo's motor and its encoder on the joint [rad].
    pub gap: f64,
    /// How far the joint stands from where the encoder says [rad].
    pub encoder_offset: f64,
    /// Lowest and highest goal that the drive takes [rad].
    pub goal_range: [f64; 2],
}

impl ServoJoint {
    /// The joint (from 0) of a file.
    ///
    /// # Errors
    /// Torque constant, stiffness or Coulomb friction that the file does not hold.
    pub fn of(index: usize, joint: &ArmJoint) -> Result<Self, ServoError> {
        let missing = |name: &'static str| ServoError::Missing { joint: index + 1, name };
        let drive = joint.drive.clone().unwrap_or_default();
        let friction = joint.friction.unwrap_or_default();
        Ok(Self {
            torque_constant: drive.torque_constant.ok_or(missing("torque_constant_Nm_per_V"))?,
            stiffness: drive.stiffness.ok_or(missing("stiffness_V_per_rad"))?,
            damping: drive.damping.unwrap_or(0.0),
            limit: drive.limit.unwrap_or(f64::INFINITY),
            rotor: joint.armature.unwrap_or(0.0),
            coulomb: friction.alpha0.unwrap_or(0.0),
            stribeck: friction.alpha1.unwrap_or(0.0),
            stribeck_velocity: friction.stribeck_velocity.unwrap_or(STRIBECK_VELOCITY),
            viscous: friction.alpha2.unwrap_or(0.0),
            ..Self::ideal()
        })
    }

    /// One volt a unit, without mass, friction or effects.
    pub fn ideal() -> Self {
        Self {
            torque_constant: 1.0,
            stiffness: 1.0,
            damping: 0.0,
            limit: f64::INFINITY,
            rotor: 0.0,
            coulomb: 0.0,
            stribeck: 0.0,
            stribeck_velocity: STRIBECK_VELOCITY,
            viscous: 0.0,
            gravity: 1.0,
            read_after_s: 0.0,
            motor_load_friction: 0.0,
            joint_load_friction: 0.0,
            asymmetry: 0.0,
            viscous_asymmetry: 0.0,
            drag: 0.0,
            over_speed: OverSpeed::default(),
            lag_s: 0.0,
            dead_zone: 0.0,
            offset: 0.0,
            cogging: [0.0; 3],
            spring: 0.0,
            spring_rest: 0.0,
            drift: 0.0,
            drift_time_s: 60.0,
            gap: 0.0,
            encoder_offset: 0.0,
            goal_range: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

/// Where Stribeck's peak has fallen to 1/e, if the file does not say [rad/s].
const STRIBECK_VELOCITY: f64 = 0.1;
