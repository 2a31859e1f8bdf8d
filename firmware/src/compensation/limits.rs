//! The bounds of compensations, which are those of the host's catalogue of effects.

/// Bounds of a value, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least that it can be.
    pub lowest: f64,
    /// The most that it can be.
    pub highest: f64,
    /// What a refusal says that the value must.
    pub(super) must: &'static str,
    /// The same as the board compares them.
    pub(super) single: [f32; 2],
}

impl Bounds {
    pub(super) const fn new(lowest: f64, highest: f64, must: &'static str) -> Self {
        Self { lowest, highest, must, single: [lowest as f32, highest as f32] }
    }
}

/// Waves per turn.
pub const HARMONIC: Bounds = Bounds::new(1.0, 1000.0, "be from 1 to 1000");
/// Amplitude of cogging [V].
pub const COGGING_V: Bounds = Bounds::new(0.0, 5.0, "be from 0 to 5 V");
/// Stiffness of cables [V/rad].
pub const CABLE_STIFFNESS_V_PER_RAD: Bounds = Bounds::new(0.0, 10.0, "be from 0 to 10 V/rad");
/// Rest angle of cables [rad].
pub const CABLE_REST_RAD: Bounds = Bounds::new(-100.0, 100.0, "be within 100 rad");
/// Drag by the square of speed [V s^2/rad^2].
pub const QUADRATIC_DRAG_V_S2_PER_RAD2: Bounds = Bounds::new(0.0, 1.0, "be from 0 to 1");
/// Variation of the friction level over the turn, in parts of it.
pub const POSITION_FRICTION: Bounds = Bounds::new(0.0, 0.95, "be from 0 to 0.95");
/// Asymmetry of friction, in parts of it.
pub const FRICTION_ASYMMETRY: Bounds = Bounds::new(-0.95, 0.95, "be from -0.95 to 0.95");
/// Error of a torque constant, in parts of it.
pub const TORQUE_CONSTANT_ERROR: Bounds = Bounds::new(-0.5, 0.5, "be from -0.5 to 0.5");
/// Variation of a torque constant over the turn, in parts of it.
pub const TORQUE_RIPPLE: Bounds = Bounds::new(0.0, 0.9, "be from 0 to 0.9");
/// Offset of the converter [V].
pub const DAC_OFFSET_V: Bounds = Bounds::new(-5.0, 5.0, "be from -5 to 5 V");
/// Half the width of a dead zone [V].
pub const DEAD_ZONE_V: Bounds = Bounds::new(0.0, 5.0, "be from 0 to 5 V");
/// First moments that a level base hides [kg m].
pub const HIDDEN_MOMENT_KG_M: Bounds = Bounds::new(-10.0, 10.0, "be from -10 to 10 kg m");
/// Components of a force on the tip [N].
pub const TIP_FORCE_N: Bounds = Bounds::new(-200.0, 200.0, "be within 200 N");
/// Values of a table [V].
pub const TABLE_V: Bounds = Bounds::new(-5.0, 5.0, "be from -5 to 5 V");
/// Knots of a table, in the unit of its axis.
pub const TABLE_KNOT: Bounds = Bounds::new(-1e6, 1e6, "be within 1e6");
