//! Kinds of joints.

/// What a joint does. Units of a prismatic joint are m, N and kg where those of a revolute one
/// are rad, Nm and kg m^2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis.
    #[default]
    Revolute,
    /// Slides along its axis.
    Prismatic,
}
