//! The columns that a log can have, by name, and the units that each may come in.

use std::f64::consts::{PI, TAU};

/// What a column of a log says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// Sample time.
    Time,
    /// Measured position.
    Position,
    /// Measured position in encoder counts.
    Count,
    /// Command.
    Command,
    /// Reference, or the goal of a position servo.
    Reference,
    /// Velocity that the drive reports.
    Velocity,
    /// Torque that the drive reports.
    Torque,
}

/// A column of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// What it says.
    pub role: Role,
    /// Of which joint, from 1; 0 for the time.
    pub joint: usize,
    /// The unit in its name.
    pub unit: &'static str,
}

/// How a number in some unit becomes one in the unit of a column's name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factor {
    /// Times this.
    Times(f64),
    /// Divided by this, which for powers of ten rounds right where their inverses do not.
    Over(f64),
}

impl Factor {
    /// The number in the column's unit.
    pub fn apply(self, value: f64) -> f64 {
        match self {
            Self::Times(factor) => value * factor,
            Self::Over(divisor) => value / divisor,
        }
    }
}

/// Beginning of a name, its role, and the units that can end it.
const FORMS: [(&str, Role, &[&str]); 6] = [
    ("qref", Role::Reference, &["rad", "m"]),
    ("qd", Role::Velocity, &["rad_per_s", "m_per_s"]),
    ("tau", Role::Torque, &["Nm", "N"]),
    ("q", Role::Count, &["count"]),
    ("q", Role::Position, &["rad", "m"]),
    ("u", Role::Command, &["V", "A", "Nm", "N"]),
];

/// Units by what they measure: that of a column's name first.
const UNITS: [(&str, &[(&str, Factor)]); 10] = [
    (
        "s",
        &[
            ("s", Factor::Times(1.0)),
            ("ms", Factor::Over(1e3)),
            ("us", Factor::Over(1e6)),
            ("ns", Factor::Over(1e9)),
            ("min", Factor::Times(60.0)),
        ],
    ),
    (
        "rad",
        &[
            ("rad", Factor::Times(1.0)),
            ("deg", Factor::Times(PI / 180.0)),
            ("rev", Factor::Times(TAU)),
            ("mrad", Factor::Over(1e3)),
        ],
    ),
    ("m", &[("m", Factor::Times(1.0)), ("mm", Factor::Over(1e3)), ("cm", Factor::Over(1e2))]),
    (
        "rad_per_s",
        &[
            ("rad/s", Factor::Times(1.0)),
            ("deg/s", Factor::Times(PI / 180.0)),
            ("rpm", Factor::Times(TAU / 60.0)),
            ("rev/s", Factor::Times(TAU)),
        ],
    ),
    ("m_per_s", &[("m/s", Factor::Times(1.0)), ("mm/s", Factor::Over(1e3))]),
    ("V", &[("V", Factor::Times(1.0)), ("mV", Factor::Over(1e3))]),
    ("A", &[("A", Factor::Times(1.0)), ("mA", Factor::Over(1e3))]),
    ("Nm", &[("Nm", Factor::Times(1.0)), ("mNm", Factor::Over(1e3)), ("Ncm", Factor::Over(1e2))]),
    ("N", &[("N", Factor::Times(1.0)), ("mN", Factor::Over(1e3)), ("kN", Factor::Times(1e3))]),
    ("count", &[("count", Factor::Times(1.0))]),
];

impl Quantity {
    /// The sample time.
    pub const TIME: Self = Self { role: Role::Time, joint: 0, unit: "s" };

    /// The column of a name, if a log can have it.
    pub fn of(name: &str) -> Option<Self> {
        if name == "t_s" {
            return Some(Self::TIME);
        }
        FORMS.iter().find_map(|&(begin, role, units)| {
            let (joint, unit) = name.strip_prefix(begin)?.split_once('_')?;
            let unit = units.iter().find(|known| **known == unit)?;
            let joint = joint.parse().ok().filter(|number| (1..=99).contains(number))?;
            Some(Self { role, joint, unit })
        })
    }

    /// The column of a role, joint and unit.
    pub fn new(role: Role, joint: usize, unit: &str) -> Option<Self> {
        let (_, _, units) = FORMS.iter().find(|(_, known, _)| *known == role)?;
        let unit = units.iter().find(|known| **known == unit)?;
        Some(Self { role, joint, unit })
    }

    /// Its name.
    pub fn name(&self) -> String {
        let form = FORMS.iter().find(|(_, role, _)| *role == self.role);
        form.map_or("t_s".to_owned(), |(begin, ..)| format!("{begin}{}_{}", self.joint, self.unit))
    }

    /// What a number in a unit must be multiplied by or divided by.
    pub fn factor(&self, unit: &str) -> Option<Factor> {
        self.units().iter().find(|(name, _)| *name == unit).map(|(_, factor)| *factor)
    }

    /// The units that it may come in, that of its name first.
    pub fn units(&self) -> &'static [(&'static str, Factor)] {
        UNITS.iter().find(|(name, _)| *name == self.unit).map_or(&[], |(_, units)| units)
    }
}

/// Every unit's spelling with the unit of the columns that it is for.
pub fn unit_names() -> impl Iterator<Item = (&'static str, &'static str)> {
    UNITS.iter().flat_map(|(column, units)| units.iter().map(move |(name, _)| (*name, *column)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_quantities_are_each_others() {
        for name in ["t_s", "q1_rad", "q12_m", "q3_count", "u2_Nm", "qref1_rad", "qd6_m_per_s"] {
            assert_eq!(Quantity::of(name).map(|quantity| quantity.name()), Some(name.to_owned()));
        }
        for name in ["q_rad", "q0_rad", "q1_V", "u1", "tau1_rad", "quiet1_rad", "q1e_rad", ""] {
            assert_eq!(Quantity::of(name), None, "{name}");
        }
    }

    #[test]
    fn milliseconds_round_as_decimals_do() {
        let factor = Quantity::TIME.factor("ms").unwrap();
        assert!((0..5000).all(|k| {
            let decimal: f64 = format!("{}.{:03}", k / 1000, k % 1000).parse().unwrap();
            factor.apply(f64::from(k)) == decimal
        }));
        assert_eq!(Quantity::TIME.factor("deg"), None);
    }
}
