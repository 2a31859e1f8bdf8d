//! The part of the standard errors that no amount of data takes away.

use model::base::COUNT;
use model::{BaseParameters, friction_parameters};

/// Relative standard errors that no amount of data takes away: what the model's equations
/// and their sampling are trusted to.
///
/// A lag poses as inertia about the joint's own axis, so products of inertia carry none;
/// nor do gravity and Coulomb friction, which need no derivative of the motion. Where
/// amplifiers make noise of millivolts these are the smaller part of most errors; on a rig
/// without noise they are nearly all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelUncertainty {
    /// Of moments of inertia, in parts of the largest one of their link.
    pub inertia: f64,
    /// Of alpha_2.
    pub viscous: f64,
    /// Of sigma_0.
    pub stiffness: f64,
    /// Of sigma_1.
    pub damping: f64,
}

impl Default for ModelUncertainty {
    fn default() -> Self {
        Self { inertia: 1e-4, viscous: 2e-4, stiffness: 0.003, damping: 0.012 }
    }
}

impl ModelUncertainty {
    /// Standard errors of the base parameters.
    pub(super) fn of_base(&self, base: &BaseParameters<f64>) -> [f64; COUNT] {
        let one = self.inertia * base.zz1r.abs();
        let two = self.inertia * base.zz2r.abs();
        let three = self.inertia * (base.zz3r + base.ia3).abs();
        BaseParameters {
            zz1r: one,
            xx2r: two,
            xy2r: 0.0,
            xz2r: 0.0,
            yz2r: 0.0,
            zz2r: two,
            mx2r: 0.0,
            my2r: 0.0,
            xx3r: three,
            xy3r: 0.0,
            xz3r: 0.0,
            yz3r: 0.0,
            zz3r: three,
            mx3r: 0.0,
            my3r: 0.0,
            ia3: three,
        }
        .to_array()
    }

    /// Standard error of a friction parameter, in the order of their names.
    pub(super) fn of_friction(
        &self,
        values: &[f64; friction_parameters::COUNT],
        parameter: usize,
    ) -> f64 {
        let relative = [0.0, 0.0, 0.0, self.viscous, self.stiffness, self.damping];
        relative[parameter] * values[parameter].abs()
    }
}
