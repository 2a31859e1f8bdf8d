//! The units in which a joint moves and is commanded.

use files::ArmJoint;
use model::mechanism::JointKind;

/// The units of a joint, as they are said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointUnits {
    /// That of its command: `V`, `A`, `Nm` or `N`.
    pub command: &'static str,
    /// Whether it slides, so that rad, Nm and kg m^2 become m, N and kg.
    pub slides: bool,
}

impl JointUnits {
    /// A joint that turns and is commanded in volts.
    pub const VOLTS: Self = Self { command: "V", slides: false };

    /// Those of a joint as its file says.
    pub fn of(joint: &ArmJoint) -> Self {
        let slides = joint.kind == JointKind::Prismatic;
        Self { command: joint.command_unit(), slides }
    }

    /// A unit of a joint that turns and takes volts, as it is on this one: `V s/rad` is `A s/m` on a
    /// sliding joint with a current drive.
    pub fn in_place_of(self, unit: &str) -> String {
        if self == Self::VOLTS {
            return unit.into();
        }
        let word = |word: &str| -> String {
            match word {
                "V" => self.command.into(),
                "rad" if self.slides => "m".into(),
                "Nm" if self.slides => "N".into(),
                "rad^2" if self.slides => "m^2".into(),
                other => other.into(),
            }
        };
        let unit = if self.slides { unit.replace("kg m^2", "kg") } else { unit.into() };
        let side = |side: &str| side.split(' ').map(word).collect::<Vec<_>>().join(" ");
        unit.split('/').map(side).collect::<Vec<_>>().join("/")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sliding_joint_with_a_current_drive_has_other_units() {
        let units = JointUnits { command: "A", slides: true };
        let said = ["V", "V s/rad", "V s^2/rad^2", "kg m^2", "Nm s/rad", "V/Nm", "s", "kg"];
        let found = said.map(|unit| units.in_place_of(unit));
        assert_eq!(found, ["A", "A s/m", "A s^2/m^2", "kg", "N s/m", "A/N", "s", "kg"]);
        assert_eq!(JointUnits::VOLTS.in_place_of("V s/rad"), "V s/rad");
    }
}
