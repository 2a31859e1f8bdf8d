//! What no amount of data takes away.

use model::BaseParameters;
use model::base::COUNT;

use super::super::base_parameters::friction::FRICTION_COUNT;

/// Relative standard errors that no amount of data takes away: what the model's equations
/// and their sampling are trusted to.
///
/// Gravity and Coulomb friction need no derivative of the motion and carry none. Where
/// amplifiers make noise of millivolts these are the smaller part of most errors; on a rig
/// without noise they are nearly all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelDoubt {
    /// Of inertias, in parts of the largest one of their link.
    pub inertia: f64,
    /// Of alpha_2.
    pub viscous: f64,
    /// Of sigma_0.
    pub stiffness: f64,
    /// Of sigma_1.
    pub damping: f64,
}

impl Default for ModelDoubt {
    fn default() -> Self {
        Self { inertia: 1e-4, viscous: 2e-4, stiffness: 0.005, damping: 0.02 }
    }
}

impl ModelDoubt {
    /// Standard errors of the base parameters.
    pub(super) fn of_base(&self, base: &BaseParameters<f64>) -> [f64; COUNT] {
        let one = self.inertia * base.zz1r.abs();
        let two = self.inertia * base.zz2r.abs();
        let three = self.inertia * (base.zz3r + base.ia3).abs();
        BaseParameters {
            zz1r: one,
            xx2r: two,
            xy2r: two,
            xz2r: two,
            yz2r: two,
            zz2r: two,
            mx2r: 0.0,
            my2r: 0.0,
            xx3r: three,
            xy3r: three,
            xz3r: three,
            yz3r: three,
            zz3r: three,
            mx3r: 0.0,
            my3r: 0.0,
            ia3: three,
        }
        .to_array()
    }

    /// Standard error of a friction parameter, in the order of their names.
    pub(super) fn of_friction(&self, values: &[f64; FRICTION_COUNT], parameter: usize) -> f64 {
        let relative = [0.0, 0.0, 0.0, self.viscous, self.stiffness, self.damping];
        relative[parameter] * values[parameter].abs()
    }
}
