//! A log's columns from one stream, in the log's units.

use super::lane::Lane;
use super::spec::ColumnSource;
use crate::error::{LocatedProblem, Place, Problem};
use crate::quantity::{Quantity, Role};
use crate::table::Values;

/// A column of a log and where it comes from.
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    pub(super) quantity: Quantity,
    pub(super) source: ColumnSource,
}

impl Wanted {
    /// A column that is called in the file as it is in a log.
    pub(super) fn as_named(name: &str) -> Option<Self> {
        let quantity = Quantity::of(name)?;
        Some(Self { quantity, source: ColumnSource::named(name) })
    }

    /// The values in the log's unit, of the rows of a lane.
    pub(super) fn values(&self, column: &Values, lane: &Lane) -> Vec<f64> {
        let ColumnSource { unit, scale, offset, wraps_at, .. } = &self.source;
        let factor = unit.as_deref().and_then(|unit| self.quantity.factor(unit));
        let mut values = lane.values(column);
        if let Some(factor) = factor {
            values.iter_mut().for_each(|value| *value = factor.apply(*value));
        }
        if (*scale, *offset) != (1.0, 0.0) {
            values.iter_mut().for_each(|value| *value = *value * scale + offset);
        }
        if let Some(turn) = wraps_at {
            unwrap(&mut values, *turn);
        }
        values
    }

    /// As a column of a table: counts whole, all else as it is.
    pub(super) fn column(&self, values: Vec<f64>) -> Result<(String, Values), LocatedProblem> {
        let name = self.quantity.name();
        if self.quantity.role != Role::Count {
            return Ok((name, Values::Float(values)));
        }
        match values.iter().find(|value| value.fract() != 0.0) {
            Some(value) => {
                let place = Place::column(&self.source.column);
                Err(Problem::NotACount(value.to_string()).at(place))
            }
            None => Ok((name, Values::Count(values.iter().map(|value| *value as i64).collect()))),
        }
    }

    /// What is said of a torque that is coarse.
    pub(super) fn note(&self) -> Option<String> {
        let name = self.quantity.name();
        let step = self.source.step?;
        Some(format!("{name} comes in steps of {step} {}", self.quantity.unit))
    }
}

/// Adds whole turns where values begin anew.
fn unwrap(values: &mut [f64], turn: f64) {
    let mut turns = 0.0;
    for row in 1..values.len() {
        let step = values[row] + turns * turn - values[row - 1];
        turns -= (step / turn).round();
        values[row] += turns * turn;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_begin_anew_go_on() {
        let mut values = [170.0, 179.0, -175.0, -170.0, 178.0, 10.0, 200.0];
        unwrap(&mut values, 360.0);
        assert_eq!(values, [170.0, 179.0, 185.0, 190.0, 178.0, 10.0, -160.0]);
    }
}
