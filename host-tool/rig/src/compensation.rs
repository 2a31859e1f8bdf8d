//! What a controller compensates for, of the effects that a model carries.
//!
//! The mathematics is in [`model::effects`], the tick's part in [`firmware::compensation`].
//! A payload is a change of the base parameters, made here when a block is built.

use firmware::compensation::ExternalLoad;
use model::effects::with_payload;
use model::{BaseParameters, Robot};

use crate::effects::{ArmLoad, Catalogue, Compensation, EffectError, Table};
use files::EffectTable;

/// The compensations of a rig.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compensations {
    /// Of each joint.
    pub joints: [firmware::compensation::Compensations; 3],
    /// What acts on the arm as a whole.
    pub load: ArmLoad,
}

/// An effect that the controller does not compensate for, and why.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{effect}{place} is not compensated: {why}", place = place(*joint))]
pub struct LeftOut {
    /// The effect's name in the catalogue.
    pub effect: String,
    /// Where it acts, 1 to 3, or 0 for the whole robot.
    pub joint: u8,
    /// Why not.
    pub why: &'static str,
}

fn place(joint: u8) -> String {
    if joint == 0 { String::new() } else { format!(" of joint {joint}") }
}

impl Compensations {
    /// Of the effects of a model file, in their order, and what is left out of them.
    ///
    /// # Errors
    /// An unknown effect, or parameters that do not fit.
    pub fn of(
        effects: &[EffectTable],
        catalogue: &Catalogue,
    ) -> Result<(Self, Vec<LeftOut>), EffectError> {
        let mut compensations = Self::default();
        let mut left_out = Vec::new();
        for table in effects {
            if Table::is_in(table) {
                let Table { joint, .. } = Table::of(table)?;
                let why = "the board plays no tables";
                left_out.push(LeftOut { effect: table.effect.clone(), joint, why });
                continue;
            }
            let (definition, values) = catalogue.definition_and_values(table)?;
            definition.with(table.joint, &values)?;
            let joint = table.joint;
            if let Err(why) = compensations.add(definition.compensation, joint, &values) {
                left_out.push(LeftOut { effect: table.effect.clone(), joint, why });
            }
        }
        Ok((compensations, left_out))
    }

    /// The robot whose base parameters the board shall take.
    pub fn base(&self, robot: &Robot<f64>) -> BaseParameters<f64> {
        with_payload(&robot.base, &robot.geometry, self.load.payload_kg)
    }

    /// What acts on the arm from outside; `None` for nothing.
    pub fn outside(&self) -> Option<ExternalLoad> {
        let outside = ExternalLoad {
            tilt: self.load.tilt.map(|tilt| tilt.cast()).unwrap_or_default(),
            tip_force_n: self.load.tip_force_n.map(|force_n| force_n as f32),
        };
        (outside != ExternalLoad::default()).then_some(outside)
    }

    /// Adds an effect with its checked values, or says why it cannot be compensated.
    fn add(
        &mut self,
        compensation: Compensation,
        joint: u8,
        values: &[f64],
    ) -> Result<(), &'static str> {
        const FULL: &str = "the board's list of such effects is full for this joint";
        let lists = self.joints.get_mut(usize::from(joint).wrapping_sub(1));
        let lists = || lists.ok_or("it acts on no joint");
        match compensation {
            Compensation::Feedforward(of) => {
                lists()?.feedforward.push(of(values)?).map_err(|_| FULL)
            }
            Compensation::Inverse(of) => {
                lists()?.input_inverses.push(of(values)?).map_err(|_| FULL)
            }
            Compensation::Model(add) => add(&mut self.load, values),
            Compensation::None(why) => Err(why),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use firmware::compensation::InputInverse;

    use crate::effects::table_from_text;

    fn of(texts: &[&str]) -> (Compensations, Vec<LeftOut>) {
        let tables: Result<Vec<_>, _> = texts.iter().map(|text| table_from_text(text)).collect();
        Compensations::of(&tables.unwrap(), &Catalogue::standard()).unwrap()
    }

    #[test]
    fn effects_go_to_their_joints_in_their_order() {
        let (found, left_out) = of(&[
            "dac_offset:3:offset_V=0.1",
            "cogging:2:amplitude_V=0.1,harmonic=8,phase_rad=0.5",
            "dead_zone:3:half_width_V=0.2",
            "payload:mass_kg=0.5",
            "payload:mass_kg=0.25",
        ]);
        assert_eq!(found.joints.each_ref().map(|j| j.feedforward.len()), [0, 1, 0]);
        assert_eq!(found.joints.each_ref().map(|j| j.input_inverses.len()), [0, 0, 2]);
        assert_eq!(found.joints[2].input_inverses[0], InputInverse::DacOffset { offset_v: 0.1 });
        assert_eq!(found.load.payload_kg, 0.75);
        assert_eq!(left_out, []);
    }

    #[test]
    fn what_cannot_be_compensated_is_named() {
        let (found, left_out) =
            of(&["delay:2:delay_s=0.002", "cogging:2:amplitude_V=0.1,harmonic=8.5,phase_rad=0.5"]);
        assert_eq!(found, Compensations::default());
        let words: Vec<String> = left_out.iter().map(ToString::to_string).collect();
        assert!(words[0].starts_with("delay of joint 2 is not compensated: no"), "{words:?}");
        assert!(words[1].contains("no whole number"), "{words:?}");
    }

    #[test]
    fn what_finds_no_room_is_left_out() {
        let (found, left_out) = of(&["dac_offset:1:offset_V=0.1"; 5]);
        assert_eq!((found.joints[0].input_inverses.len(), left_out.len()), (4, 1));
        assert!(left_out[0].to_string().contains("full"), "{left_out:?}");
    }

    #[test]
    fn the_board_takes_what_the_catalogue_allows() {
        let rig = crate::Rig::new(model::reference_robot::reference_robot());
        let pick: [fn(&crate::effects::Parameter) -> f64; 2] = [|p| p.lowest, |p| p.highest];
        let plan = crate::plan::task(10.0);
        let mut compensated = 0;
        for definition in Catalogue::standard().iter() {
            for bound in pick {
                let values: Vec<f64> = definition.parameters.iter().map(bound).collect();
                let mut compensations = Compensations::default();
                let joint = if definition.whole_robot { 0 } else { 1 };
                let added = compensations.add(definition.compensation, joint, &values);
                if matches!(definition.compensation, Compensation::None(_)) {
                    assert!(added.is_err(), "{}", definition.name);
                    continue;
                }
                assert_eq!(added, Ok(()), "{}", definition.name);
                let block = plan.block(&rig.clone().with_compensations(compensations));
                assert_eq!(block.check(), Ok(()), "{}", definition.name);
                compensated += 1;
            }
        }
        assert_eq!(compensated, 2 * 12);
    }
}
