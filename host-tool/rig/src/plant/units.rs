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

    /// Words on a joint that turns and takes volts, as they are said of this one: `0.3 mV s/rad` is
    /// `0.3 mA s/m` on a sliding joint with a current drive. Names of parameters stay.
    pub fn in_words(self, words: &str) -> String {
        if self == Self::VOLTS {
            return words.into();
        }
        let words = if self.slides { words.replace("kg m^2", "kg") } else { words.to_owned() };
        let is_part = |letter: char| letter.is_alphanumeric() || "_^.".contains(letter);
        let mut said = String::new();
        let mut rest = words.as_str();
        while let Some(first) = rest.chars().next() {
            let inside = is_part(first);
            let end = rest.find(|letter| is_part(letter) != inside).unwrap_or(rest.len());
            let (piece, after) = rest.split_at(end);
            said += &self.unit(piece).unwrap_or_else(|| piece.to_owned());
            rest = after;
        }
        said
    }

    /// What stands for a unit, with its dot where it ends a sentence; none for other words.
    fn unit(self, word: &str) -> Option<String> {
        let (bare, dot) = match word.strip_suffix('.') {
            Some(bare) => (bare, "."),
            None => (word, ""),
        };
        let (milli, bare) = match bare.strip_prefix('m') {
            Some(unit) if !unit.is_empty() => ("m", unit),
            _ => ("", bare),
        };
        let unit = match bare {
            "V" => self.command,
            "rad" if self.slides => "m",
            "rad^2" if self.slides => "m^2",
            "Nm" if self.slides => "N",
            _ => return None,
        };
        Some(format!("{milli}{unit}{dot}"))
    }
}

impl Default for JointUnits {
    fn default() -> Self {
        Self::VOLTS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sliding_joint_with_a_current_drive_has_other_units() {
        let units = JointUnits { command: "A", slides: true };
        let said = ["V", "V s/rad", "V s^2/rad^2", "kg m^2", "Nm s/rad", "V/Nm", "s", "kg"];
        let found = said.map(|unit| units.in_words(unit));
        assert_eq!(found, ["A", "A s/m", "A s^2/m^2", "kg", "N s/m", "A/N", "s", "kg"]);
        assert_eq!(JointUnits::VOLTS.in_words("V s/rad"), "V s/rad");
    }

    #[test]
    fn sentences_keep_their_names() {
        let torque = JointUnits { command: "Nm", slides: false };
        let said =
            torque.in_words("order 8 per revolution, 0.11 V; [mV], amplitude_V below 2 rad/s.");
        assert_eq!(said, "order 8 per revolution, 0.11 Nm; [mNm], amplitude_V below 2 rad/s.");
        let force = JointUnits { command: "N", slides: true };
        assert_eq!(force.in_words("A gap of 3 V."), "A gap of 3 N.");
    }
}
