//! Bounds of the compensations' values: those of the catalogue of effects.

use model::ParameterError;
use model::parameter::named;

use super::parameters::{AngularHarmonic, Compensations, ExternalLoad, Feedforward, InputInverse};

type Checked = Result<(), ParameterError>;

/// Requires a value from `lowest` to `highest`; `must` says so in words.
fn within(
    (name, joint): (&'static str, u8),
    value: f32,
    (lowest, highest): (f32, f32),
    must: &'static str,
) -> Checked {
    named(name, value).of_joint(joint).require(value >= lowest && value <= highest, must)?;
    Ok(())
}

impl AngularHarmonic {
    fn check(&self, name: &'static str, joint: u8) -> Checked {
        within((name, joint), f32::from(self.order), (1.0, 1000.0), "be from 1 to 1000")
    }
}

impl Compensations {
    /// Checks every value; `joint` (1 to 3) is for the message.
    pub(crate) fn check(&self, joint: u8) -> Checked {
        self.feedforward.iter().try_for_each(|effect| effect.check(joint))?;
        self.input_inverses.iter().try_for_each(|effect| effect.check(joint))
    }
}

impl Feedforward {
    fn check(&self, joint: u8) -> Checked {
        match *self {
            Self::Cogging { amplitude_v, wave } => {
                wave.check("cogging harmonic", joint)?;
                within(("cogging amplitude_V", joint), amplitude_v, (0.0, 5.0), "be from 0 to 5 V")
            }
            Self::CableSpring { stiffness_v_per_rad, rest_rad } => {
                let name = ("cable_spring stiffness_V_per_rad", joint);
                within(name, stiffness_v_per_rad, (0.0, 10.0), "be from 0 to 10 V/rad")?;
                let name = ("cable_spring rest_rad", joint);
                within(name, rest_rad, (-100.0, 100.0), "be within 100 rad")
            }
            Self::QuadraticDrag { coefficient_v_s2_per_rad2 } => {
                let name = ("quadratic_drag coefficient_V_s2_per_rad2", joint);
                within(name, coefficient_v_s2_per_rad2, (0.0, 1.0), "be from 0 to 1")
            }
            Self::PositionFriction { relative_amplitude, wave } => {
                wave.check("position_friction harmonic", joint)?;
                let name = ("position_friction relative_amplitude", joint);
                within(name, relative_amplitude, (0.0, 0.95), "be from 0 to 0.95")
            }
            Self::AsymmetricFriction { relative_asymmetry } => {
                let name = ("asymmetric_friction relative_asymmetry", joint);
                within(name, relative_asymmetry, (-0.95, 0.95), "be from -0.95 to 0.95")
            }
        }
    }
}

impl InputInverse {
    fn check(&self, joint: u8) -> Checked {
        match *self {
            Self::TorqueConstant { relative_error } => {
                let name = ("torque_constant relative_error", joint);
                within(name, relative_error, (-0.5, 0.5), "be from -0.5 to 0.5")
            }
            Self::TorqueRipple { relative_amplitude, wave } => {
                wave.check("torque_ripple harmonic", joint)?;
                let name = ("torque_ripple relative_amplitude", joint);
                within(name, relative_amplitude, (0.0, 0.9), "be from 0 to 0.9")
            }
            Self::DacOffset { offset_v } => {
                within(("dac_offset offset_V", joint), offset_v, (-5.0, 5.0), "be from -5 to 5 V")
            }
            Self::DeadZone { half_width_v } => {
                let name = ("dead_zone half_width_V", joint);
                within(name, half_width_v, (0.0, 5.0), "be from 0 to 5 V")
            }
        }
    }
}

impl ExternalLoad {
    /// Checks the vectors, component by component.
    pub(crate) fn check(&self) -> Checked {
        for change in &self.tilt.gravity_change {
            within(("base_tilt gravity_change", 0), *change, (-2.0, 2.0), "be from -2 to 2")?;
        }
        for moment in &self.tilt.hidden_moment_kg_m {
            let name = ("base_tilt hidden_moment_kg_m", 0);
            within(name, *moment, (-10.0, 10.0), "be from -10 to 10 kg m")?;
        }
        for force_n in &self.tip_force_n {
            within(("tip_force force_N", 0), *force_n, (-1e3, 1e3), "be within 1000 N")?;
        }
        Ok(())
    }
}
