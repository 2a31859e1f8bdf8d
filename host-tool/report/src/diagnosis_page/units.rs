//! Units of the axes.

use diagnosis::report::sentence::joint_numbers;
use diagnosis::{Axis, Diagnosis};

use crate::Chart;

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

/// A chart of one joint, `Joint 2: ...`, in that joint's units.
pub(super) fn in_own_units(diagnosis: &Diagnosis, chart: Chart) -> Chart {
    let units = diagnosis.units_of(joint_in(&chart.title));
    let [title, x_label, y_label] =
        [&chart.title, &chart.x_label, &chart.y_label].map(|words| units.in_words(words));
    Chart { title, x_label, y_label, ..chart }
}

/// The joint that a title begins with; 0 where it names none.
pub(super) fn joint_in(title: &str) -> u8 {
    let after = title.strip_prefix("Joint ").unwrap_or_default();
    let end = after.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(after.len());
    after[..end].parse().unwrap_or(0)
}

/// Whether all joints have the same units.
pub(super) fn are_common(diagnosis: &Diagnosis) -> bool {
    let joints = joint_numbers(diagnosis);
    joints.windows(2).all(|pair| diagnosis.units_of(pair[0]) == diagnosis.units_of(pair[1]))
}
