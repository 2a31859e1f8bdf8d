//! Units of the axes.

use diagnosis::Axis;

/// The unit of an axis; none over frequencies, which have no course.
pub(super) fn unit(axis: Axis) -> Option<&'static str> {
    Some(match axis {
        Axis::Position => "rad",
        Axis::Velocity => "rad/s",
        Axis::Acceleration => "rad/s^2",
        Axis::Command => "V",
        Axis::Load => "Nm",
        Axis::Time | Axis::Offset => "s since the log began",
        Axis::Frequency => return None,
    })
}
