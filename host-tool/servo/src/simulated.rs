//! An arm of servos as its file describes it, with effects that the file does not have.

use files::{ArmFile, EffectTable};
use recordings::ArmCampaign;
use rig::effects::Catalogue;

use crate::along::without_rotors;
use crate::error::ServoError;
use crate::prepared::joints;
use crate::recorded::{Recording, Truth, record};
use crate::whole_table::{tip_force, with_effects};

/// Rate of an arm whose file tells none [Hz].
const USUAL_HZ: f64 = 50.0;
/// A position is read this long after its goal was sent [s], and no later than a part of a row.
const READ_AFTER_S: f64 = 0.006;
const READ_AFTER_PART: f64 = 0.3;

/// The logs in which a gap is looked for: nine motions of 30 s, the last three held out.
pub fn gap_recording(arm: &ArmFile) -> Recording {
    let period_s = arm.sample_period_s.unwrap_or(1.0 / USUAL_HZ);
    Recording {
        rate_hz: 1.0 / period_s,
        length_s: 30.0,
        read_after_s: READ_AFTER_S.min(READ_AFTER_PART * period_s),
        logs: [6, 3],
        swing_rad: 0.8,
    }
}

/// The arm with these effects beside those of its file.
///
/// # Errors
/// Drives or links that are not known, or an effect that servos cannot have.
pub fn truth(arm: &ArmFile, hidden: &[EffectTable]) -> Result<Truth, ServoError> {
    hidden.iter().try_for_each(|table| check(arm, table))?;
    let mut whole = arm.clone();
    whole.effects.extend_from_slice(hidden);
    let links = with_effects(&without_rotors(&arm.chain()?), &whole.effects)?;
    let servos = joints(&whole)?;
    Ok(Truth { links, servos, force_n: tip_force(&whole.effects)? })
}

/// Records the arm with hidden effects; same seed, same motions.
///
/// # Errors
/// Those of [`truth`].
pub fn simulated(
    arm: &ArmFile,
    hidden: &[EffectTable],
    recording: &Recording,
    seed: u64,
) -> Result<ArmCampaign, ServoError> {
    Ok(record(arm, &truth(arm, hidden)?, recording, seed))
}

/// Numbers within the bounds of the catalogue's parameters of the same names.
fn check(arm: &ArmFile, table: &EffectTable) -> Result<(), ServoError> {
    let catalogue = Catalogue::of_arm(arm.joints.len());
    let parameters = catalogue.by_name(&table.effect).map_or(&[][..], |known| known.parameters);
    for parameter in parameters {
        let Some(value) = table.parameters.get(parameter.name) else { continue };
        let values = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
        let within = |value: &toml::Value| {
            let number = value.as_float().or(value.as_integer().map(|whole| whole as f64));
            number.is_some_and(|x| (parameter.lowest..=parameter.highest).contains(&x))
        };
        if !values.iter().all(within) {
            return Err(ServoError::Value {
                effect: table.effect.clone(),
                parameter: parameter.name,
                lowest: parameter.lowest,
                highest: parameter.highest,
            });
        }
    }
    Ok(())
}
