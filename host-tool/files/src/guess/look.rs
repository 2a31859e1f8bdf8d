//! What a table's columns look like.

use super::looked::Looked;
use crate::table::{Table, Values};

/// A look at all columns; those that were not read have a name alone.
pub fn look(context: &str, table: &Table) -> Vec<Looked> {
    table.names().map(|name| of_column(context, name, table.get(name))).collect()
}

/// The columns' names alone, which takes no time.
pub fn names_alone(context: &str, table: &Table) -> Vec<Looked> {
    table.names().map(|name| of_column(context, name, None)).collect()
}

fn of_column(context: &str, name: &str, values: Option<&Values>) -> Looked {
    let rows = values.and_then(Values::rows).unwrap_or(0);
    let at = |row: usize| values.map_or(f64::NAN, |values| values.at(row));
    let finite = (0..rows).map(at).filter(|value| value.is_finite());
    let mut steps: Vec<f64> = match values {
        // Nanoseconds of a calendar are more than a float holds; their differences are not.
        Some(Values::Count(whole)) => {
            whole.windows(2).map(|pair| pair[1].saturating_sub(pair[0]) as f64).collect()
        }
        _ => (1..rows).map(|row| at(row) - at(row - 1)).collect(),
    };
    steps.retain(|step| step.is_finite() && *step > 0.0);
    steps.sort_by(f64::total_cmp);
    Looked {
        context: context.to_owned(),
        name: name.to_owned(),
        largest: finite.map(f64::abs).fold(0.0, f64::max),
        median_step: steps.get(steps.len() / 2).copied().unwrap_or(0.0),
        is_whole: matches!(values, Some(Values::Count(_))),
    }
}
