//! Over which axes the board plays a table.

use firmware::compensation;

use super::axis::TableAxis;

/// The axis as the board knows it.
///
/// # Errors
/// Why the board cannot play a table over it.
pub fn board_axis(axis: TableAxis) -> Result<compensation::TableAxis, &'static str> {
    match axis {
        TableAxis::Position => Ok(compensation::TableAxis::Position),
        TableAxis::Velocity => Ok(compensation::TableAxis::Velocity),
        TableAxis::Load => Ok(compensation::TableAxis::Load),
        TableAxis::Command => {
            Err("the board would have to know its command before it has computed it")
        }
        TableAxis::Time => Err("the board does not know when the curve begins"),
    }
}
