//! The parameters of an effect: what they are, their names and their bounds.

use firmware::compensation::limits::Bounds;

/// What a parameter is; whoever treats parameters differently asks this and not the name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Amplitude of a harmonic; with its phase moved by half a turn it changes its sign.
    Amplitude,
    /// Waves per turn, a whole number that is tried and not fitted.
    Harmonic,
    /// One of two, 0 or 1, that are tried and not fitted.
    Choice,
    /// Phase of a harmonic [rad], the same after a turn.
    Phase,
    /// An angle that is another one after a turn [rad].
    Angle,
    /// One component of a small rotation [rad].
    Rotation,
    /// A change in parts of what the model holds.
    RelativeChange,
    /// Time constant of an exponential [s].
    TimeConstant,
    /// Delay [s].
    Delay,
    /// Mass [kg].
    Mass,
    /// First moment of mass [kg m].
    FirstMoment,
    /// Inertia [kg m^2].
    Inertia,
    /// Component of a place [m].
    Place,
    /// Component of a force [N].
    Force,
    /// Stiffness, a torque or a voltage per angle.
    Stiffness,
    /// Viscous damping.
    Damping,
    /// Gap between two stops [rad].
    Gap,
    /// A constant that is added.
    Offset,
    /// A limit that a signal does not exceed, and that shows only where it is reached.
    Limit,
    /// Half the width of a band in which nothing passes.
    HalfWidth,
    /// Factor of a term of its own.
    Coefficient,
}

impl Kind {
    /// Whether a search tries values of it, and no fit changes them.
    pub fn is_tried(self) -> bool {
        matches!(self, Self::Harmonic | Self::Choice)
    }
}

/// A parameter of an effect.
#[derive(Debug)]
pub struct Parameter {
    /// Its name, with its unit; the components of a vector bear the same name.
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
    /// The least that it can be.
    pub lowest: f64,
    /// The most that it can be.
    pub highest: f64,
    /// Whether it may be left out, and is zero then.
    pub optional: bool,
}

impl Parameter {
    /// A parameter with its bounds.
    pub const fn new(name: &'static str, kind: Kind, lowest: f64, highest: f64) -> Self {
        Self { name, kind, lowest, highest, optional: false }
    }

    /// A parameter that the board takes as well, within the board's bounds.
    pub const fn of_board(name: &'static str, kind: Kind, bounds: Bounds) -> Self {
        Self::new(name, kind, bounds.lowest, bounds.highest)
    }

    /// The same, zero where it is left out.
    pub const fn optional(self) -> Self {
        Self { optional: true, ..self }
    }
}
