//! Bounds of the compensations' values: those of the catalogue of effects.

use model::ParameterError;
use model::parameter::named;

use super::limits::{self, Bounds};
use super::parameters::{AngularHarmonic, Compensations, ExternalLoad, Feedforward, InputInverse};
use super::tables::Table;

type Checked = Result<(), ParameterError>;

/// Gravity's change has no parameter of its own: the host computes it from the angles.
const GRAVITY_CHANGE: Bounds = Bounds::new(-2.0, 2.0, "be from -2 to 2");

/// Requires a value within its bounds.
fn within((name, joint): (&'static str, u8), value: f32, bounds: Bounds) -> Checked {
    let [lowest, highest] = bounds.single;
    named(name, value).of_joint(joint).require(value >= lowest && value <= highest, bounds.must)?;
    Ok(())
}

impl AngularHarmonic {
    fn check(&self, name: &'static str, joint: u8) -> Checked {
        within((name, joint), f32::from(self.order), limits::HARMONIC)
    }
}

impl Compensations {
    /// Checks every value; `joint` (1 to 3) is for the message.
    pub(crate) fn check(&self, joint: u8) -> Checked {
        self.feedforward.iter().try_for_each(|effect| effect.check(joint))?;
        self.input_inverses.iter().try_for_each(|effect| effect.check(joint))?;
        self.tables.iter().try_for_each(|table| table.check(joint))
    }
}

impl Feedforward {
    fn check(&self, joint: u8) -> Checked {
        match *self {
            Self::Cogging { amplitude_v, wave } => {
                wave.check("cogging harmonic", joint)?;
                within(("cogging amplitude_V", joint), amplitude_v, limits::COGGING_V)
            }
            Self::CableSpring { stiffness_v_per_rad, rest_rad } => {
                let name = ("cable_spring stiffness_V_per_rad", joint);
                within(name, stiffness_v_per_rad, limits::CABLE_STIFFNESS_V_PER_RAD)?;
                let name = ("cable_spring rest_rad", joint);
                within(name, rest_rad, limits::CABLE_REST_RAD)
            }
            Self::QuadraticDrag { coefficient_v_s2_per_rad2 } => {
                let name = ("quadratic_drag coefficient_V_s2_per_rad2", joint);
                within(name, coefficient_v_s2_per_rad2, limits::QUADRATIC_DRAG_V_S2_PER_RAD2)
            }
            Self::PositionFriction { relative_amplitude, wave } => {
                wave.check("position_friction harmonic", joint)?;
                let name = ("position_friction relative_amplitude", joint);
                within(name, relative_amplitude, limits::POSITION_FRICTION)
            }
            Self::AsymmetricFriction { relative_asymmetry } => {
                let name = ("asymmetric_friction relative_asymmetry", joint);
                within(name, relative_asymmetry, limits::FRICTION_ASYMMETRY)
            }
        }
    }
}

impl InputInverse {
    fn check(&self, joint: u8) -> Checked {
        match *self {
            Self::TorqueConstant { relative_error } => {
                let name = ("torque_constant relative_error", joint);
                within(name, relative_error, limits::TORQUE_CONSTANT_ERROR)
            }
            Self::TorqueRipple { relative_amplitude, wave } => {
                wave.check("torque_ripple harmonic", joint)?;
                let name = ("torque_ripple relative_amplitude", joint);
                within(name, relative_amplitude, limits::TORQUE_RIPPLE)
            }
            Self::DacOffset { offset_v } => {
                within(("dac_offset offset_V", joint), offset_v, limits::DAC_OFFSET_V)
            }
            Self::DeadZone { half_width_v } => {
                let name = ("dead_zone half_width_V", joint);
                within(name, half_width_v, limits::DEAD_ZONE_V)
            }
        }
    }
}

impl Table {
    fn check(&self, joint: u8) -> Checked {
        let (knots, values) = (self.knots.len(), self.values_v.len());
        named("table's number of knots", knots as f32)
            .of_joint(joint)
            .require(knots >= 2 && knots == values, "be 2 or more, and that of values_V")?;
        for knot in &self.knots {
            within(("table knots", joint), *knot, limits::TABLE_KNOT)?;
        }
        for value_v in &self.values_v {
            within(("table values_V", joint), *value_v, limits::TABLE_V)?;
        }
        for (before, next) in self.knots.iter().zip(self.knots.iter().skip(1)) {
            named("table knots", *next)
                .of_joint(joint)
                .require(before < next, "be above the knot before it")?;
        }
        Ok(())
    }
}

impl ExternalLoad {
    /// Checks the vectors, component by component.
    pub(crate) fn check(&self) -> Checked {
        for change in &self.tilt.gravity_change {
            within(("base_tilt gravity_change", 0), *change, GRAVITY_CHANGE)?;
        }
        for moment in &self.tilt.hidden_moment_kg_m {
            let name = ("base_tilt hidden_moment_kg_m", 0);
            within(name, *moment, limits::HIDDEN_MOMENT_KG_M)?;
        }
        for force_n in &self.tip_force_n {
            within(("tip_force force_N", 0), *force_n, limits::TIP_FORCE_N)?;
        }
        Ok(())
    }
}
