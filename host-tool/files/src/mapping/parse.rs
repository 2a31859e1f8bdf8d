//! The mapping in `dataset.toml`, checked as far as it can be without the logs.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::spec::{ColumnSource, LogMapping, Mapping, StreamSource};
use crate::error::{FileError, Problem};
use crate::quantity::{Quantity, Role};
use crate::toml_source::TomlSource;

/// What of the list is a mapping.
#[derive(Deserialize)]
struct List {
    #[serde(default)]
    columns: BTreeMap<String, ColumnSource>,
    #[serde(default)]
    streams: BTreeMap<String, StreamSource>,
    joints: Option<Vec<usize>>,
    #[serde(default, rename = "log")]
    logs: Vec<LogMapping>,
}

/// The mapping of a data set's list.
pub(crate) fn parse(source: &TomlSource) -> Result<Mapping, FileError> {
    let List { columns, streams, joints, logs } = source.parse()?;
    let common = LogMapping { columns, streams, joints, ..LogMapping::default() };
    check(&common).map_err(|(key, what)| {
        source.problem_in(Problem::Contradiction(what), "columns", None, &key)
    })?;
    for (index, log) in logs.iter().enumerate() {
        let place = |(_, what)| source.problem_in_nth(Problem::Contradiction(what), "log", index);
        check(log).map_err(place)?;
    }
    Ok(Mapping { common, logs })
}

/// Checks names and units; what is wrong comes with its key.
fn check(mapping: &LogMapping) -> Result<(), (String, String)> {
    for (name, source) in &mapping.columns {
        let quantity = Quantity::of(name).ok_or_else(|| {
            let what = format!(
                "{name} in [columns] is no column of a log; those are t_s, q1_rad (or _m, _count), u1_V (or \
                 _A, _Nm, _N), qref1_rad, qd1_rad_per_s, tau1_Nm, and likewise for other joints"
            );
            (name.clone(), what)
        })?;
        check_source(name, source, quantity).map_err(|what| (name.clone(), what))?;
    }
    for (name, stream) in &mapping.streams {
        let times = stream.time.iter();
        let checked = times.map(|time| check_source("time", time, Quantity::TIME));
        let of_stream = |what| (name.clone(), format!("[streams.{name}]: {what}"));
        checked.collect::<Result<(), String>>().map_err(of_stream)?;
    }
    Ok(())
}

fn check_source(name: &str, source: &ColumnSource, quantity: Quantity) -> Result<(), String> {
    if let Some(unit) = &source.unit
        && quantity.factor(unit).is_none()
    {
        let units: Vec<_> = quantity.units().iter().map(|(unit, _)| *unit).collect();
        let other = match quantity.role {
            Role::Command => {
                "; a command in another unit goes to u1_V, u1_A, u1_Nm or u1_N, as the model's drive takes \
                 it, or has a scale (1 / torque constant makes V of Nm) and no unit"
            }
            _ => "; any other needs a scale, and no unit",
        };
        return Err(format!("{name} takes the units {}, not \"{unit}\"{other}", units.join(", ")));
    }
    let is_count = quantity.role == Role::Count;
    if is_count && (source.scale.fract() != 0.0 || source.offset.fract() != 0.0) {
        return Err(format!("{name} is in counts, so its scale and offset must be whole"));
    }
    if source.scale == 0.0 {
        return Err(format!("the scale of {name} is 0"));
    }
    if source.unsigned && quantity.role != Role::Torque {
        return Err(format!(
            "{name} is marked unsigned, but only a reported torque (tau1_Nm) may lack its sign: a \
             command or position without it tells nothing"
        ));
    }
    Ok(())
}
