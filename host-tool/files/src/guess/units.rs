//! The unit of a column, by its name and else by its values.

use super::looked::Looked;
use super::words::has;
use crate::quantity::Role;

/// The unit of the log's column, the unit of the file's, and why.
pub(super) type Units = (&'static str, &'static str, String);

/// Sampling periods that a rig can have [s].
const PERIODS_S: std::ops::Range<f64> = 2e-5..0.5;

/// Units of a column of some role.
pub(super) fn units(role: Role, words: &[String], looked: &Looked) -> Option<Units> {
    match role {
        Role::Time => time(words, looked),
        Role::Position | Role::Reference | Role::Count => Some(angle(words, looked)),
        Role::Velocity => Some(velocity(words, looked)),
        Role::Command | Role::Torque => Some(drive(words)),
    }
}

fn by_name(words: &[String], list: &[(&str, &'static str, &'static str)]) -> Option<Units> {
    let (word, column, unit) =
        list.iter().find(|(word, ..)| words.iter().any(|w| w == word)).copied()?;
    Some((column, unit, format!("\"{word}\" in its name")))
}

fn time(words: &[String], looked: &Looked) -> Option<Units> {
    let units = [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];
    let fits = |unit_s: f64| PERIODS_S.contains(&(looked.median_step * unit_s));
    let named = by_name(words, &[("ms", "s", "ms"), ("us", "s", "us"), ("ns", "s", "ns")]);
    if let Some(named) = named {
        return Some(named);
    }
    let told = has(words, &["s", "sec", "secs", "seconds"]);
    let (unit, unit_s) = match told {
        true => ("s", 1.0),
        false => units.into_iter().find(|(_, unit_s)| fits(*unit_s))?,
    };
    let rate = 1.0 / (looked.median_step * unit_s);
    Some(("s", unit, format!("its step, {:.6}, gives {rate:.1} Hz", looked.median_step)))
}

fn angle(words: &[String], looked: &Looked) -> Units {
    let list = [
        ("deg", "rad", "deg"),
        ("degree", "rad", "deg"),
        ("degrees", "rad", "deg"),
        ("rad", "rad", "rad"),
        ("rev", "rad", "rev"),
        ("turns", "rad", "rev"),
        ("mm", "m", "mm"),
        ("count", "count", "count"),
        ("counts", "count", "count"),
        ("ticks", "count", "count"),
    ];
    let largest = looked.largest;
    if let Some(named) = by_name(words, &list) {
        return named;
    }
    match looked.largest > std::f64::consts::TAU {
        true if looked.is_whole => ("count", "count", format!("whole numbers up to {largest}")),
        true => {
            ("rad", "deg", format!("goes to {largest:.3}, which is more than a turn in radians"))
        }
        false => ("rad", "rad", format!("goes to {largest:.3}")),
    }
}

fn velocity(words: &[String], looked: &Looked) -> Units {
    let list = [
        ("rpm", "rad_per_s", "rpm"),
        ("deg", "rad_per_s", "deg/s"),
        ("rad", "rad_per_s", "rad/s"),
        ("mm", "m_per_s", "mm/s"),
    ];
    let unknown = || ("rad_per_s", "rad/s", format!("goes to {:.4}", looked.largest));
    by_name(words, &list).unwrap_or_else(unknown)
}

fn drive(words: &[String]) -> Units {
    let list = [
        ("mv", "V", "mV"),
        ("mnm", "Nm", "mNm"),
        ("ma", "A", "mA"),
        ("nm", "Nm", "Nm"),
        ("voltage", "V", "V"),
        ("volt", "V", "V"),
        ("volts", "V", "V"),
        ("spannung", "V", "V"),
        ("current", "A", "A"),
        ("currents", "A", "A"),
        ("amp", "A", "A"),
        ("strom", "A", "A"),
        ("torque", "Nm", "Nm"),
        ("torques", "Nm", "Nm"),
        ("tau", "Nm", "Nm"),
        ("effort", "Nm", "Nm"),
        ("efforts", "Nm", "Nm"),
        ("moment", "Nm", "Nm"),
        ("drehmoment", "Nm", "Nm"),
        ("force", "N", "N"),
        ("v", "V", "V"),
        ("a", "A", "A"),
    ];
    let unknown = || ("V", "V", "its name tells no unit".to_owned());
    by_name(words, &list).unwrap_or_else(unknown)
}
