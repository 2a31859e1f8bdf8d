//! What a controller makes up for, of the effects that a model carries.
//!
//! The mathematics is in [`model::effects`], the tick's part in [`firmware::compensation`].
//! A payload is a change of the base parameters, made here when a block is built.

use firmware::Angle;
use firmware::compensation::{AngularHarmonic, ExternalLoad, Feedforward, InputInverse};
use model::effects::{Tilt, with_payload};
use model::vector::Vector3;
use model::{BaseParameters, Robot};

use crate::effects::{EffectError, definition_and_values, effect_of};
use files::EffectTable;

/// The compensations of a rig.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compensations {
    /// Of each joint.
    pub joints: [firmware::compensation::Compensations; 3],
    /// Mass at the tip [kg].
    pub payload_kg: f64,
    /// How the base leans, if it does.
    pub tilt: Option<Tilt<f64>>,
    /// Force on the tip [N].
    pub tip_force_n: Vector3<f64>,
}

/// An effect that the controller does not make up for, and why.
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
    pub fn of(effects: &[EffectTable]) -> Result<(Self, Vec<LeftOut>), EffectError> {
        let mut compensations = Self::default();
        let mut left_out = Vec::new();
        for table in effects {
            effect_of(table)?;
            let (_, values) = definition_and_values(table)?;
            if let Err(why) = compensations.add(table, &values) {
                let effect = table.effect.clone();
                left_out.push(LeftOut { effect, joint: table.joint, why });
            }
        }
        Ok((compensations, left_out))
    }

    /// The robot whose base parameters the board shall take.
    pub fn base(&self, robot: &Robot<f64>) -> BaseParameters<f64> {
        with_payload(&robot.base, &robot.geometry, self.payload_kg)
    }

    /// What acts on the arm from outside; `None` for nothing.
    pub fn outside(&self) -> Option<ExternalLoad> {
        let outside = ExternalLoad {
            tilt: self.tilt.map(|tilt| tilt.cast()).unwrap_or_default(),
            tip_force_n: self.tip_force_n.map(|force_n| force_n as f32),
        };
        (outside != ExternalLoad::default()).then_some(outside)
    }

    /// Adds an effect with its checked values, or says why it cannot be compensated.
    fn add(&mut self, table: &EffectTable, values: &[f64]) -> Result<(), &'static str> {
        match (table.effect.as_str(), values) {
            ("payload", &[mass_kg]) => self.payload_kg += mass_kg,
            ("base_tilt", _) if self.tilt.is_some() => return Err(SECOND_TILT),
            ("base_tilt", &[a, b, reach, side]) => self.tilt = Some(Tilt::new(a, b, [reach, side])),
            ("tip_force", &[x, y, z]) => add(&mut self.tip_force_n, [x, y, z]),
            (name, values) => {
                let joint = usize::from(table.joint).wrapping_sub(1);
                let lists = self.joints.get_mut(joint).ok_or(NO_JOINT)?;
                if let Some(effect) = fed_forward(name, values)? {
                    lists.feedforward.push(effect).map_err(|_| FULL)?;
                } else {
                    lists.input_inverses.push(undone(name, values)?).map_err(|_| FULL)?;
                }
            }
        }
        Ok(())
    }
}

const SECOND_TILT: &str = "the board knows one tilt, and the model holds two";
const FULL: &str = "the board's list of such effects is full for this joint";
const NO_JOINT: &str = "it acts on no joint";

/// Forces add up.
fn add(sum: &mut Vector3<f64>, more: Vector3<f64>) {
    for (total, part) in sum.iter_mut().zip(more) {
        *total += part;
    }
}

/// What feedforward makes up for, if the effect is of this kind, or why it cannot.
fn fed_forward(name: &str, values: &[f64]) -> Result<Option<Feedforward>, &'static str> {
    let single = |value: f64| value as f32;
    Ok(Some(match (name, values) {
        ("cogging", &[a, n, phase]) => {
            Feedforward::Cogging { amplitude_v: single(a), wave: turn_wave(n, phase)? }
        }
        ("cable_spring", &[k, rest]) => {
            Feedforward::CableSpring { stiffness_v_per_rad: single(k), rest_rad: single(rest) }
        }
        ("quadratic_drag", &[b]) => {
            Feedforward::QuadraticDrag { coefficient_v_s2_per_rad2: single(b) }
        }
        ("position_friction", &[a, n, phase]) => Feedforward::PositionFriction {
            relative_amplitude: single(a),
            wave: turn_wave(n, phase)?,
        },
        ("asymmetric_friction", &[e]) => {
            Feedforward::AsymmetricFriction { relative_asymmetry: single(e) }
        }
        _ => return Ok(None),
    }))
}

/// What the command undoes, or why it cannot.
fn undone(name: &str, values: &[f64]) -> Result<InputInverse, &'static str> {
    let single = |value: f64| value as f32;
    Ok(match (name, values) {
        ("torque_constant", &[e]) => InputInverse::TorqueConstant { relative_error: single(e) },
        ("torque_ripple", &[a, n, phase]) => {
            InputInverse::TorqueRipple { relative_amplitude: single(a), wave: turn_wave(n, phase)? }
        }
        ("dac_offset", &[offset]) => InputInverse::DacOffset { offset_v: single(offset) },
        ("dead_zone", &[d]) => InputInverse::DeadZone { half_width_v: single(d) },
        (name, _) => return Err(why_not(name)),
    })
}

/// The board's wave over the turn; its angles wrap there, so the wave must fit it.
fn turn_wave(harmonic: f64, phase_rad: f64) -> Result<AngularHarmonic, &'static str> {
    const ROUNDING: f64 = 1e-6;
    let whole = harmonic.round();
    if (harmonic - whole).abs() > ROUNDING {
        return Err("its harmonic is no whole number, so it does not repeat every turn");
    }
    Ok(AngularHarmonic { order: whole as u16, phase: Angle::from_radians(phase_rad as f32) })
}

/// Why the controller makes nothing up for an effect of this name.
fn why_not(name: &str) -> &'static str {
    match name {
        "actuator_lag" => "undoing a lag would amplify the noise of the command",
        "delay" => "no command can act before it is given",
        "joint_elasticity" | "backlash" => "the encoder sees the motor, not the link",
        "load_friction" => "the board does not compute the load's part of friction",
        "friction_drift" => "the board does not know how warm the joint is",
        "saturation" => "an amplifier gives no more than it can",
        "encoder_eccentricity" => "the board takes its encoders for true",
        _ => "the board knows no compensation for it",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{CATALOGUE, table_from_text};

    fn of(texts: &[&str]) -> (Compensations, Vec<LeftOut>) {
        let tables: Result<Vec<_>, _> = texts.iter().map(|text| table_from_text(text)).collect();
        Compensations::of(&tables.unwrap()).unwrap()
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
        assert_eq!(found.payload_kg, 0.75);
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
    fn every_effect_is_either_compensated_or_left_out_for_its_own_reason() {
        let other = why_not("");
        let known = CATALOGUE.iter().filter(|definition| {
            let values: Vec<f64> =
                definition.parameters.iter().map(|p| p.highest.min(1.0)).collect();
            let table = EffectTable {
                effect: definition.name.into(),
                joint: if definition.whole_robot { 0 } else { 1 },
                ..EffectTable::default()
            };
            let added = Compensations::default().add(&table, &values);
            assert_ne!(added, Err(other), "{}", definition.name);
            added.is_ok()
        });
        assert_eq!(known.count(), 12);
    }
}
