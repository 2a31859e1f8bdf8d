//! What changes after the robot was identified, so large that a user notices.

use rig::effects::{Catalogue, Definition, DrawContext};

use super::settings::NOTICED;
use crate::case::{Case, Kind, Recorded};
use crate::cause::TrueEffect;
use crate::detectability::{Residuals, is_stable, peak_command_v};
use crate::diverse::scaled;
use crate::error::TrialError;
use crate::rng::Rng;
use crate::visibility::Visibility;

/// Effects that are drawn before a robot is given up.
const EFFECT_TRIES: u32 = 20;
/// Sizes of one effect that are tried.
const SIZE_TRIES: u32 = 12;
/// How sizes are changed until they are noticed.
const LARGER: f64 = 1.5;
/// How sizes are changed until the arm follows again; no power of [`LARGER`], so that the two do
/// not take each other back.
const SMALLER: f64 = 0.8;

/// The case with one change, and how much it shows beside what the model leaves.
///
/// `case` has the identified model as its nominal one and no causes yet.
///
/// # Errors
/// A robot that cannot follow its motions, or on which nothing drawn is noticed.
pub(super) fn changed(case: &Case, only: &[String], rng: &mut Rng) -> Result<Case, TrialError> {
    let before = case.record_undamaged()?;
    let trial = Trial {
        left: Residuals::of(&as_judged(case), &before)?,
        peak_command_v: peak_command_v(&before),
        case,
    };
    let choices = choices(only)?;
    for _ in 0..EFFECT_TRIES {
        let definition = *rng.pick(&choices);
        let joint = if definition.whole_robot { 0 } else { rng.joint() };
        if let Some(changed) = trial.noticed(definition, joint, rng)? {
            return Ok(changed);
        }
    }
    let what = "changes".to_owned();
    Err(TrialError::NothingDetectable { case: case.number, tries: EFFECT_TRIES, what })
}

/// A robot as it was identified.
struct Trial<'a> {
    case: &'a Case,
    /// What its model leaves.
    left: Residuals,
    peak_command_v: [f64; 3],
}

impl Trial<'_> {
    /// The effect in a size that a user notices and that the arm withstands.
    fn noticed(
        &self,
        definition: &'static Definition,
        joint: u8,
        rng: &mut Rng,
    ) -> Result<Option<Case>, TrialError> {
        let i = usize::from(joint.max(1)) - 1;
        let effect = TrueEffect::Catalogue(definition);
        let peak_command_v = self.peak_command_v;
        let context = DrawContext { robot: &self.case.robot, peak_command_v, joint: i };
        let values = effect.draw(&context, rng);
        let mut part = 1.0;
        for _ in 0..SIZE_TRIES {
            let cause = scaled(effect, joint, &values, part, peak_command_v[i]);
            let case = Case { kind: Kind::Single, ..self.case.with_causes(vec![cause]) };
            let recorded = case.record_undamaged()?;
            if !is_stable(&case, &recorded) {
                part *= SMALLER;
                continue;
            }
            let visibility = self.visibility(&case, &recorded)?;
            if visibility.raw >= NOTICED {
                return Ok(Some(Case { visibility: Some(visibility), ..case }));
            }
            part *= LARGER;
        }
        Ok(None)
    }

    fn visibility(&self, case: &Case, recorded: &[Recorded]) -> Result<Visibility, TrialError> {
        Ok(Residuals::of(&as_judged(case), recorded)?.compared_with(&self.left))
    }
}

/// The case judged by the identified model, which is all that a user has.
fn as_judged(case: &Case) -> Case {
    Case { robot: case.nominal, ..case.clone() }
}

/// The effects to choose from.
fn choices(only: &[String]) -> Result<Vec<&'static Definition>, TrialError> {
    let catalogue = Catalogue::standard();
    if let Some(name) = only.iter().find(|name| catalogue.by_name(name).is_none()) {
        return Err(TrialError::UnknownEffect(name.clone()));
    }
    let is_wanted = |d: &&Definition| only.is_empty() || only.iter().any(|name| name == d.name);
    Ok(catalogue.iter().filter(is_wanted).collect())
}
