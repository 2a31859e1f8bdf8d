//! The earlier steps' results, and settings.

use model::{BaseParameters, Pendulum};

use crate::estimate::Estimate;
use signal::spectrum::Welch;

/// What is known of the robot before this step. Everything may be absent; then the
/// intervals are wider.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prior {
    /// The rigid body and how well it is known.
    pub rigid: Option<RigidBody>,
    /// Sliding friction of joints 1 to 3.
    pub sliding: [Option<Sliding>; 3],
    /// Bristles of joints 1 to 3, used for the neighbours of the excited joint.
    pub bristles: [Option<Bristles>; 3],
}

impl Prior {
    /// A prior with the base parameters, known to `relative_error` (see [`RigidBody`]).
    pub fn with_base(base: BaseParameters<f64>, relative_error: f64) -> Self {
        Self { rigid: Some(RigidBody::Robot { base, relative_error }), ..Self::default() }
    }

    /// The same with sliding friction of a joint, 1 to 3; other numbers are ignored.
    pub fn with_sliding(mut self, joint: u8, sliding: Sliding) -> Self {
        if let Some(slot) = usize::from(joint).checked_sub(1).and_then(|i| self.sliding.get_mut(i))
        {
            *slot = Some(sliding);
        }
        self
    }
}

/// The rigid body of the rig.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigidBody {
    /// Three joints.
    Robot {
        /// Base parameters of eq. (19).
        base: BaseParameters<f64>,
        /// Standard error of an entry D_ij of the mass matrix over sqrt(D_ii D_jj).
        relative_error: f64,
    },
    /// One joint, eq. (11).
    Pendulum {
        /// Inertia and gravity.
        pendulum: Pendulum<f64>,
        /// Relative standard error of the inertia.
        relative_error: f64,
    },
}

/// Sliding friction of a joint, eq. (10), from an earlier step.
#[derive(Clone, Debug, PartialEq)]
pub struct Sliding {
    /// Coulomb level alpha_0 [V].
    pub alpha0_v: Estimate,
    /// Static level above it, alpha_1 [V].
    pub alpha1_v: Estimate,
    /// Stribeck velocity [rad/s].
    pub stribeck_velocity_rad_per_s: Estimate,
    /// Viscous coefficient alpha_2 [V s/rad].
    pub alpha2_v_s_per_rad: Estimate,
}

/// Stiffness and damping of a neighbour's bristles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bristles {
    /// Stiffness [V/rad].
    pub sigma0_v_per_rad: f64,
    /// Its relative standard error.
    pub sigma0_relative_error: f64,
    /// Damping [V s/rad].
    pub sigma1_v_s_per_rad: f64,
    /// Its relative standard error.
    pub sigma1_relative_error: f64,
}

/// How the FRF is measured and fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Averaging.
    pub welch: Welch,
    /// Frequencies that are looked at [Hz]; the band of the fit lies within.
    pub band_hz: [f64; 2],
    /// The band of the fit ends where the smoothed coherence falls below this.
    pub least_coherence: f64,
    /// Delay of the loop beyond the zero-order hold [s].
    pub delay_s: f64,
    /// Standard error of the delay [s].
    pub delay_error_s: f64,
    /// Relative standard error of sigma0 that linearising LuGre leaves.
    pub sigma0_model_error: f64,
    /// Relative standard error of sigma1 that linearising LuGre leaves.
    pub sigma1_model_error: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            welch: Welch::default(),
            band_hz: [1.0, 200.0],
            least_coherence: 0.1,
            delay_s: 0.0,
            delay_error_s: 2e-5,
            sigma0_model_error: 0.005,
            sigma1_model_error: 0.002,
        }
    }
}
