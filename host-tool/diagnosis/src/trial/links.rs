//! How the links of a trial move: as measured, or behind springs as those drive them.

use std::borrow::Cow;
use std::sync::Arc;

use model::Posture;

use super::equation::Trial;
use super::link_motion::{self, JointMotion, MeasuredTorque};
use super::motor_side::MotorSide;
use crate::criteria::FitCriteria;
use crate::logs::kinematics::{Kinematics, Sines, postures_for};
use crate::logs::stretch::Stretch;
use rig::effects::Transmission;

impl<'a> Trial<'a> {
    /// Motion of the links.
    pub(super) fn link(&self) -> &Kinematics {
        if self.springs.is_empty() {
            return self.motor();
        }
        self.link.get_or_init(|| {
            let mut link = self.motor().clone();
            for (joint, spring) in &self.springs {
                link.take_joint(*joint, self.behind(*joint, spring));
            }
            link
        })
    }

    /// Sines and cosines of the links' angles.
    pub(super) fn postures(&self) -> &[Posture<f64>] {
        match self.moves_as_measured() {
            true => &self.stretch.postures,
            false => self.postures.get_or_init(|| postures_for(self.plant(), self.link())),
        }
    }

    /// The same by joints.
    pub(super) fn sines(&self) -> &[Sines] {
        let Stretch { motion, .. } = self.stretch;
        match self.moves_as_measured() {
            true => self.stretch.sines(),
            false => {
                self.sines.get_or_init(|| self.link().sines_near(motion, self.stretch.sines()))
            }
        }
    }

    /// Sines and cosines of the motors' angles, as a chain takes them.
    pub(super) fn motor_sines(&self) -> Cow<'_, [Sines]> {
        if self.plant().body.as_rrr().is_some() {
            return Cow::Borrowed(&[]);
        }
        let Stretch { motion, .. } = self.stretch;
        match self.has_true_encoders() {
            true => Cow::Borrowed(self.stretch.sines()),
            false => Cow::Owned(self.motor().sines_near(motion, self.stretch.sines())),
        }
    }

    /// The spring that was added last, with its joint (from 0).
    pub(super) fn last_spring(&self) -> Option<(usize, &Transmission)> {
        self.springs.last().map(|(joint, spring)| (*joint, spring))
    }

    /// The motors' side of the springs, where another trial has computed it.
    pub(super) fn motor_side(&self) -> Option<&'a dyn MotorSide> {
        self.motor_side
    }

    /// How far a joint's link behind a spring is ahead of its motor in acceleration, angle and velocity, at the samples.
    pub(super) fn link_ahead(&self, joint: usize, spring: &Transmission) -> Vec<[f64; 3]> {
        self.behind(joint, spring).ahead_of(self.motor(), joint)
    }

    /// Motion of a joint's link behind a spring.
    fn behind(&self, joint: usize, spring: &Transmission) -> JointMotion {
        let dynamics = match self.motor_side {
            Some(known) => Arc::clone(known.dynamics(joint, &|| self.dynamics(joint))),
            None => self.dynamics(joint),
        };
        let push_nm = match self.motor_side {
            Some(known) => self.push_nm(joint, known.net_v(joint)),
            None => self.push_nm(joint, &self.net(joint)),
        };
        let period_s = self.stretch.period_s;
        let unknown_torque = unknown_torque(spring, period_s, self.criteria);
        let measured = MeasuredTorque { push_nm: &push_nm, unknown_torque };
        link_motion::behind(spring, joint, self.motor(), &dynamics, measured, period_s)
    }

    /// Torque that pushes a joint in the interval after each sample [Nm].
    fn push_nm(&self, joint: usize, net_v: &[f64]) -> Vec<f64> {
        let k_t = self.plant().torque_constant_nm_per_v[joint];
        net_v.iter().map(|net_v| k_t * net_v).collect()
    }
}

/// Torque on a link behind a spring that no model tells, in parts of the noise of the measured torque.
///
/// Steps s of the encoder push a link by K s; the torque that is measured has as noise what they make of the motor's
/// acceleration, J_m s / T^2, so that the two are as K T^2 / J_m.
fn unknown_torque(spring: &Transmission, period_s: f64, criteria: &FitCriteria) -> f64 {
    if spring.gap_rad > 0.0 {
        return criteria.unknown_link_torque;
    }
    let of_steps = spring.stiffness_nm_per_rad * period_s.powi(2) / spring.motor_inertia_kg_m2;
    (criteria.spring_torque_of_steps * of_steps)
        .max(criteria.unknown_spring_torque)
        .min(criteria.unknown_link_torque)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stiffer_a_spring_the_more_the_measured_torque_corrects_its_link() {
        let criteria = FitCriteria::default();
        let behind = |stiffness_nm_per_rad: f64, motor_inertia_kg_m2: f64, gap_rad: f64| {
            let damping_nm_s_per_rad = 1.0;
            let spring = Transmission {
                gap_rad,
                stiffness_nm_per_rad,
                damping_nm_s_per_rad,
                motor_inertia_kg_m2,
            };
            unknown_torque(&spring, 1e-3, &criteria)
        };
        assert_eq!(behind(42.0, 0.01, 0.0), criteria.unknown_spring_torque, "a soft one");
        let stiff = behind(91_900.0, 0.0806, 0.0);
        assert!((stiff - 0.13 * 1.14).abs() < 0.001, "{stiff}");
        assert_eq!(behind(340e3, 0.02, 0.0), criteria.unknown_link_torque, "no more than play");
        assert_eq!(behind(42.0, 0.01, 1e-3), criteria.unknown_link_torque, "play");
    }
}
