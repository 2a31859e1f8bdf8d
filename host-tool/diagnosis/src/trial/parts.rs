//! What a model's equation consists of along a stretch, and how it changes with an effect.

use super::equation::{MotorSide, Trial};
use super::hypothesis::EffectInstance;
use super::joint_dynamics::JointDynamics;
use crate::logs::intervals::at_samples;
use rig::effects::Touches;

/// The equation of a joint over a stretch, on the log's clock [V].
#[derive(Clone, Default)]
pub struct Parts {
    /// What drives the joint, by intervals.
    pub drive: Vec<f64>,
    /// Friction, by intervals.
    pub friction: Vec<f64>,
    /// Drive less friction, by intervals.
    pub net: Vec<f64>,
    /// What the rigid body needs, by samples.
    pub needed: Vec<f64>,
    /// Dynamics of the joint as if it were stiff, by samples.
    dynamics: Vec<JointDynamics>,
}

impl Parts {
    /// Those of a model under trial.
    pub fn of(trial: &Trial, joint: usize) -> Self {
        let drive = trial.drive(joint);
        let friction = trial.friction(joint, trial.robot());
        let net = drive.iter().zip(&friction).map(|(drive, friction)| drive - friction).collect();
        let (needed, dynamics) = (trial.needed(joint).to_vec(), trial.dynamics(joint));
        Self { drive, friction, net, needed, dynamics }
    }

    /// Change of the residual at the samples when a trial takes these parts' place.
    pub fn change_to(&self, trial: &Trial, joint: usize, touches: Touches) -> Vec<f64> {
        let mut net = vec![0.0; self.drive.len()];
        let mut add = |after: Vec<f64>, before: &[f64], sign: f64| {
            let both = after.iter().zip(before);
            net.iter_mut().zip(both).for_each(|(net, (a, b))| *net += sign * (a - b));
        };
        if touches.drive {
            add(trial.drive(joint), &self.drive, 1.0);
        }
        if touches.friction {
            add(trial.friction(joint, trial.robot()), &self.friction, -1.0);
        }
        let mut change = at_samples(&net);
        if touches.body {
            let both = trial.needed(joint).iter().zip(&self.needed);
            change.iter_mut().zip(both).for_each(|(change, (a, b))| *change -= a - b);
        }
        change
    }
}

/// The motors' side of the springs in these parts, for a hypothesis that differs from theirs in
/// `effect` alone: nothing unless that is a spring.
pub fn motor_side<'a>(parts: &'a [Parts; 3], effect: &EffectInstance) -> Option<MotorSide<'a>> {
    effect.is_spring().then(|| MotorSide {
        dynamics: [0, 1, 2].map(|joint| &parts[joint].dynamics[..]),
        net_v: [0, 1, 2].map(|joint| &parts[joint].net[..]),
    })
}

/// What an effect changes in the equation of a model that has others too.
pub fn touched(effect: &EffectInstance, others: &[EffectInstance]) -> Touches {
    let mut touches = effect.definition.touches;
    let moves_others = touches.body && !effect.is_spring() && !others.is_empty();
    // What is in the model already may depend on a body or a motion that changes.
    touches.drive |= moves_others;
    touches.friction |= moves_others;
    // A link with backlash is corrected by the torque that drives its motor.
    let meets = |other: &EffectInstance| effect.joint == 0 || effect.joint == other.joint;
    touches.body |= others.iter().any(|other| other.has_backlash() && meets(other));
    touches
}
