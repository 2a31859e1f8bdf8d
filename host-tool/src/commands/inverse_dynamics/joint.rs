//! The columns of a joint.

use files::arm_file::DriveKind;
use files::{ArmJoint, EffectTable};
use model::mechanism::JointKind;

use super::friction::{self, SteadyFriction};

/// A joint's number and units, and the torque by its command.
#[derive(Clone, Debug)]
pub struct JointColumns {
    number: usize,
    kind: JointKind,
    /// The command's unit, and the torque by it, where both are known.
    command: Option<(&'static str, f64)>,
    friction: Option<SteadyFriction>,
}

impl JointColumns {
    /// A joint of the robot of format 1, which is commanded a voltage; torque constant in Nm/V.
    pub fn with_voltage(
        number: u8,
        torque_constant_nm_per_v: f64,
        friction: Option<SteadyFriction>,
    ) -> Self {
        let command = Some(("V", torque_constant_nm_per_v));
        Self { number: number.into(), kind: JointKind::Revolute, command, friction }
    }

    /// A joint of an arm of any kind, its number from 1.
    pub fn of(number: usize, joint: &ArmJoint) -> Self {
        let command = joint.drive.as_ref().and_then(|drive| match drive.kind {
            DriveKind::Voltage => Some(("V", drive.torque_constant?)),
            DriveKind::Current => Some(("A", drive.torque_constant?)),
            // A torque is its own command, a servo's is a goal.
            DriveKind::Torque | DriveKind::PositionServo => None,
        });
        let is_goal =
            joint.drive.as_ref().is_some_and(|drive| drive.kind == DriveKind::PositionServo);
        let law = friction::of_joint(joint).filter(|_| !is_goal);
        let friction = law.map(SteadyFriction::of);
        Self { number, kind: joint.kind, command, friction }
    }

    /// Position, velocity and acceleration.
    pub fn motion(&self) -> [String; 3] {
        let (joint, unit) = (self.number, self.unit());
        [
            format!("q{joint}_{unit}"),
            format!("qd{joint}_{unit}_per_s"),
            format!("qdd{joint}_{unit}_per_s2"),
        ]
    }

    /// Torque or force.
    pub fn torque(&self) -> String {
        format!("tau{}_{}", self.number, self.torque_unit())
    }

    fn torque_unit(&self) -> &'static str {
        match self.kind {
            JointKind::Revolute => "Nm",
            JointKind::Prismatic => "N",
        }
    }

    /// The command, where it is neither torque nor goal.
    pub fn command(&self) -> Option<String> {
        self.command.map(|(unit, _)| format!("u{}_{unit}", self.number))
    }

    /// Friction, and the whole command that a motion needs: the rigid body's share and friction's; in
    /// files that tell friction, where the command is no goal.
    pub fn needed(&self) -> Option<[String; 2]> {
        self.friction.as_ref()?;
        let unit = self.command.map_or(self.torque_unit(), |(unit, _)| unit);
        Some(["friction", "needed"].map(|name| format!("{name}{}_{unit}", self.number)))
    }

    /// Takes an effect of this joint; whether it is one of friction that the file tells.
    pub fn add(&mut self, effect: &EffectTable) -> bool {
        usize::from(effect.joint) == self.number
            && self.friction.as_mut().is_some_and(|friction| friction.add(effect))
    }

    /// The values of [`JointColumns::needed`], from the rigid body's torque, Coriolis and gravity torques and the
    /// velocity.
    pub fn needed_values(&self, torque: f64, load: f64, velocity: f64) -> Option<[f64; 2]> {
        let constant = self.torque_constant().unwrap_or(1.0);
        let friction = self.friction.as_ref()?.at(velocity, load, torque, constant);
        Some([friction, torque / constant + friction])
    }

    /// Torque by command.
    pub fn torque_constant(&self) -> Option<f64> {
        self.command.map(|(_, constant)| constant)
    }

    fn unit(&self) -> &'static str {
        match self.kind {
            JointKind::Revolute => "rad",
            JointKind::Prismatic => "m",
        }
    }
}
