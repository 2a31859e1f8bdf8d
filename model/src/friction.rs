//! LuGre friction, eq. (9)-(10), in volts of command.

use serde::{Deserialize, Serialize};

use crate::Real;
use crate::parameter::{ParameterError, named};

/// The friction of one joint, Tables 2 and 3.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Friction<T> {
    /// Coulomb level alpha_0 [V].
    #[serde(rename = "alpha0_V")]
    pub alpha0_v: T,
    /// Static level above the Coulomb level, alpha_1 [V]; may be negative.
    #[serde(rename = "alpha1_V")]
    pub alpha1_v: T,
    /// Stribeck velocity v_s [rad/s].
    pub stribeck_velocity_rad_per_s: T,
    /// Viscous coefficient alpha_2 [V s/rad].
    #[serde(rename = "alpha2_V_s_per_rad")]
    pub alpha2_v_s_per_rad: T,
    /// Stiffness of the pre-sliding deflection, sigma_0 [V/rad].
    #[serde(rename = "sigma0_V_per_rad")]
    pub sigma0_v_per_rad: T,
    /// Damping of the pre-sliding deflection, sigma_1 [V s/rad].
    #[serde(rename = "sigma1_V_s_per_rad")]
    pub sigma1_v_s_per_rad: T,
}

/// How an unmodelled effect changes a joint's friction at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionScale<T> {
    /// Factor on the Coulomb and Stribeck level gamma.
    pub level: T,
    /// What comes on top of it [V].
    pub added_v: T,
    /// Factor on the viscous coefficient.
    pub viscous: T,
}

impl<T: Real> FrictionScale<T> {
    /// Friction as the model says.
    pub fn unchanged() -> Self {
        Self { level: T::one(), added_v: T::zero(), viscous: T::one() }
    }

    /// The same in another number type.
    pub fn cast<U: Real>(&self) -> FrictionScale<U> {
        let cast = |x: T| U::constant(x.as_f64());
        FrictionScale {
            level: cast(self.level),
            added_v: cast(self.added_v),
            viscous: cast(self.viscous),
        }
    }
}

impl<T: Real> Friction<T> {
    /// The Stribeck curve gamma of eq. (10) [V], for a velocity of either sign.
    #[inline]
    pub fn stribeck_level(&self, velocity_rad_per_s: T) -> T {
        let ratio = velocity_rad_per_s / self.stribeck_velocity_rad_per_s;
        let square = ratio * ratio;
        // Beyond, the exponential is lost in alpha_0's last digit, also in f64; most
        // motion is there, and is spared its cost.
        if square > T::constant(40.0) {
            return self.alpha0_v;
        }
        self.alpha0_v + self.alpha1_v * (-square).exp()
    }

    /// Friction in steady sliding, eq. (10) [V].
    #[inline]
    pub fn sliding(&self, velocity_rad_per_s: T) -> T {
        let viscous = self.alpha2_v_s_per_rad * velocity_rad_per_s;
        if velocity_rad_per_s == T::zero() {
            return viscous;
        }
        self.stribeck_level(velocity_rad_per_s) * velocity_rad_per_s.signum() + viscous
    }

    /// The same friction in another number type.
    pub fn cast<U: Real>(&self) -> Friction<U> {
        let cast = |x: T| U::constant(x.as_f64());
        Friction {
            alpha0_v: cast(self.alpha0_v),
            alpha1_v: cast(self.alpha1_v),
            stribeck_velocity_rad_per_s: cast(self.stribeck_velocity_rad_per_s),
            alpha2_v_s_per_rad: cast(self.alpha2_v_s_per_rad),
            sigma0_v_per_rad: cast(self.sigma0_v_per_rad),
            sigma1_v_s_per_rad: cast(self.sigma1_v_s_per_rad),
        }
    }

    /// Checks that all are finite and that gamma is positive at every velocity.
    ///
    /// `joint` (1 to 3) is for the message.
    pub fn check(&self, joint: u8) -> Result<(), ParameterError> {
        let named = |name, value| named(name, value).of_joint(joint);
        named("alpha0_V", self.alpha0_v).positive()?;
        named("alpha1_V", self.alpha1_v).finite()?;
        named("alpha1_V", self.alpha1_v).require(
            self.alpha0_v + self.alpha1_v > T::zero(),
            "leave gamma = alpha0 + alpha1 above 0",
        )?;
        named("stribeck_velocity_rad_per_s", self.stribeck_velocity_rad_per_s).positive()?;
        named("alpha2_V_s_per_rad", self.alpha2_v_s_per_rad).not_negative()?;
        named("sigma0_V_per_rad", self.sigma0_v_per_rad).positive()?;
        named("sigma1_V_s_per_rad", self.sigma1_v_s_per_rad).not_negative()?;
        Ok(())
    }
}

/// The state z of eq. (9): the pre-sliding deflection [rad].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionState<T> {
    /// Deflection z [rad].
    pub deflection_rad: T,
}

impl<T: Real> FrictionState<T> {
    /// Moves z on by one step and returns the mean friction voltage over it [V].
    ///
    /// For a velocity that is constant over the step, (9) is linear in z and this is
    /// its exact solution: z relaxes to gamma/sigma0 as exp(-sigma0 |v| t / gamma).
    /// That holds for steps of any length, also where sigma0 |v| / gamma reaches
    /// 51,000 1/s (joint 1 at 10 rad/s) and an explicit integrator explodes.
    ///
    /// Error at constant velocity, of 1e-5 to 10 rad/s and steps of 0.1 and 1 ms, with z in
    /// parts of max(gamma) / sigma0: in `f64` below 1e-12 and 1e-10 V, what the comparison
    /// can resolve; in `f32` below 2e-7 and 6e-6 V. A velocity that swings by 1 rad/s at
    /// 1 Hz, taken at the middle of 1 ms ticks, costs up to 7e-4 and 1.1 mV around its
    /// reversals; taken at their start, half a tick late, up to 0.094 and 43 mV.
    ///
    /// A joint that slides for a second at 1 rad/s has reached the steady friction, eq. (10):
    ///
    /// ```
    /// use model::{FrictionState, reference_robot::reference_robot};
    ///
    /// let friction = reference_robot::<f64>().friction[0];
    /// let mut state = FrictionState::default();
    /// for _ in 0..1000 {
    ///     state.step(&friction, 1.0, 1e-3);
    /// }
    /// assert!((state.step(&friction, 1.0, 1e-3) - friction.sliding(1.0)).abs() < 1e-12);
    /// ```
    #[inline]
    pub fn step(&mut self, friction: &Friction<T>, velocity_rad_per_s: T, step_s: T) -> T {
        self.step_scaled(friction, FrictionScale::unchanged(), velocity_rad_per_s, step_s)
    }

    /// [`Self::step`] with the friction's level and viscous part scaled.
    #[inline]
    pub fn step_scaled(
        &mut self,
        friction: &Friction<T>,
        scale: FrictionScale<T>,
        velocity_rad_per_s: T,
        step_s: T,
    ) -> T {
        let level = friction.stribeck_level(velocity_rad_per_s) * scale.level + scale.added_v;
        let relaxation = friction.sigma0_v_per_rad * velocity_rad_per_s.abs() * step_s / level;
        let decay = (-relaxation).exp_m1();
        let before = self.deflection_rad;
        let steady = level / friction.sigma0_v_per_rad * velocity_rad_per_s.signum();
        let excess = before - steady;
        let change = excess * decay;
        self.deflection_rad = before + change;
        let mean = if relaxation > T::constant(1e-6) {
            steady - change / relaxation
        } else {
            before + change / T::constant(2.0)
        };
        friction.sigma0_v_per_rad * mean
            + friction.sigma1_v_s_per_rad * change / step_s
            + friction.alpha2_v_s_per_rad * scale.viscous * velocity_rad_per_s
    }
}
