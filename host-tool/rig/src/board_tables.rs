//! Tables as the board plays them.

use firmware::compensation::{self, MAX_KNOTS};

use crate::effects::{Table, TableAxis, board_axis};

/// A table that the board compensates.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayedTable {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Over what it lies.
    pub axis: TableAxis,
    /// Knots in the model.
    pub knots: usize,
    /// Knots on the board.
    pub on_board: usize,
    /// By how much the board's curve differs from the model's at most [V].
    pub missed_v: f64,
}

impl std::fmt::Display for PlayedTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { joint, axis, knots, on_board, missed_v } = self;
        write!(f, "table of joint {joint} over {} is compensated: ", axis.name())?;
        match knots == on_board {
            true => write!(f, "{knots} knots"),
            false => {
                let missed_mv = 1e3 * missed_v;
                write!(f, "{on_board} of its {knots} knots, off by at most {missed_mv:.1} mV")
            }
        }
    }
}

/// A table for the board, and what became of it; or why the board cannot compensate it.
///
/// # Errors
/// An axis on which the reference does not tell the place, or knots that the board cannot tell
/// apart.
pub fn for_board(table: &Table) -> Result<(compensation::Table, PlayedTable), &'static str> {
    let axis = board_axis(table.axis)?;
    let (coarse, missed_v) = table.coarsened(MAX_KNOTS);
    let single = |values: &[f64]| values.iter().map(|value| *value as f32).collect();
    let (knots, values_v) = (single(&coarse.knots), single(&coarse.values_v));
    let on_board = compensation::Table { axis, knots, values_v };
    if on_board.knots.windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err("two of its knots are the same number in the board's precision");
    }
    let played = PlayedTable {
        joint: table.joint,
        axis: table.axis,
        knots: table.knots.len(),
        on_board: coarse.knots.len(),
        missed_v,
    };
    Ok((on_board, played))
}
