//! Where the filter begins.

use model::Friction;

use crate::one_joint::parameters::to_logarithms;
use crate::one_joint::rows::{Rows, Term};
use crate::one_joint::sliding::sliding;

/// First estimates; what is absent is taken from the log itself by least squares where
/// the joint slides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Friction.
    pub friction: Option<Friction<f64>>,
    /// Inertia in volts per acceleration [V s^2/rad].
    pub inertia: Option<f64>,
}

impl Start {
    /// Nothing is known but the log.
    pub fn from_log() -> Self {
        Self::default()
    }

    /// Friction's logarithms, inertia, factors of the linear terms.
    pub(super) fn parameters(&self, rows: &Rows) -> Vec<f64> {
        let sliding = sliding(rows);
        let own = sliding.as_ref().map_or_else(typical, |sliding| Friction {
            alpha0_v: sliding.alpha0_v,
            alpha1_v: -0.2 * sliding.alpha0_v,
            alpha2_v_s_per_rad: sliding.alpha2_v_s_per_rad,
            ..typical()
        });
        let mut parameters = to_logarithms(&self.friction.unwrap_or(own)).to_vec();
        match &sliding {
            Some(sliding) => parameters.extend(sliding.factors.iter()),
            None => parameters.extend(vec![0.0; rows.terms.len()]),
        }
        let inertia = rows.column(Term::Inertia).map(|column| column + 6);
        if let Some(index) = inertia {
            let value = self.inertia.unwrap_or(parameters[index]);
            parameters[index] = if value > 0.0 { value } else { TYPICAL_INERTIA };
        }
        parameters
    }
}

/// Inertia of a joint of which nothing is known [V s^2/rad].
const TYPICAL_INERTIA: f64 = 0.05;

/// Friction of a joint of which nothing is known.
fn typical() -> Friction<f64> {
    Friction {
        alpha0_v: 0.3,
        alpha1_v: -0.05,
        stribeck_velocity_rad_per_s: 0.004,
        alpha2_v_s_per_rad: 0.1,
        sigma0_v_per_rad: 250.0,
        sigma1_v_s_per_rad: 2.0,
    }
}
