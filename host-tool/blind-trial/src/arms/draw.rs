//! Draws cases.

use rayon::prelude::*;
use recordings::ArmCampaign;
use rig::effects::Random;

use super::case::{ArmCase, plant};
use super::kind::ArmKind;
use super::oracle::oracle;
use super::typical::typical;
use super::{places, sizes, truth};
use crate::case::Kind;
use crate::cause::{TrueCause, TrueEffect};
use crate::error::TrialError;
use crate::rng::Rng;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmTrialSettings {
    /// The kind of arm.
    pub arm: ArmKind,
    /// Same seed, same cases.
    pub seed: u32,
    /// Number of the first case.
    pub first: u32,
    /// How many.
    pub cases: u32,
    /// All of this kind.
    pub kind: Option<Kind>,
}

/// Part of the cases in which nothing is hidden.
const CLEAN_PART: f64 = 0.3;
/// Draws of effects until the arm still follows its motion.
const TRIES: u32 = 16;
/// How far what is hidden may take a joint from where it was without [rad; m].
const FURTHEST: f64 = 0.8;

/// Draws all cases; `progress` is called after each.
///
/// # Errors
/// A case for which nothing fit was drawn.
pub fn draw_arms(
    settings: &ArmTrialSettings,
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<ArmCase>, TrialError> {
    let numbers: Vec<u32> = (settings.first..settings.first + settings.cases).collect();
    let draw = |number: u32| {
        let case = drawn(settings, number);
        progress();
        case
    };
    numbers.into_par_iter().map(draw).collect()
}

fn drawn(settings: &ArmTrialSettings, number: u32) -> Result<ArmCase, TrialError> {
    let mut rng = Rng::new(settings.seed, number);
    let is_clean = rng.unit() < CLEAN_PART;
    let kind = settings.kind.unwrap_or(if is_clean { Kind::None } else { Kind::Single });
    let nominal = settings.arm.nominal();
    let truth = truth::drawn(settings.arm, &nominal, &mut rng);
    let seed = u64::from(rng.seed());
    let (arm, cause, oracle) = (settings.arm, None, None);
    let bare = ArmCase { number, kind, arm, nominal, truth, cause, oracle, seed };
    if kind == Kind::None { Ok(bare) } else { with_cause(&bare, &mut rng) }
}

/// The case with an effect under which it still follows its motion.
fn with_cause(bare: &ArmCase, rng: &mut Rng) -> Result<ArmCase, TrialError> {
    let clean = bare.record()?;
    for _ in 0..TRIES {
        let (definition, joint) = places::drawn(bare.arm, bare.truth.joints.len(), rng);
        let values = sizes::drawn(definition, &typical(bare, &clean, joint)?, rng);
        if !sizes::can_be(definition, joint, &values, &plant(&bare.truth)?) {
            continue;
        }
        let cause = TrueCause::new(TrueEffect::Catalogue(definition), joint, values);
        let case = ArmCase { cause: Some(cause), ..bare.clone() };
        let recorded = case.record()?;
        if is_near(&recorded, &clean) {
            let oracle = oracle(&case, &recorded);
            return Ok(ArmCase { oracle, ..case });
        }
    }
    let what = "effects".into();
    Err(TrialError::NothingDetectable { case: bare.number, tries: TRIES, what })
}

fn is_near(recorded: &ArmCampaign, clean: &ArmCampaign) -> bool {
    recorded.recordings.iter().zip(&clean.recordings).all(|(one, other)| {
        one.log.joints.iter().zip(&other.log.joints).all(|(one, other)| {
            let pairs = one.position.iter().zip(&other.position);
            let (mut pairs, usable) = (pairs, one.command.iter().all(|u| u.is_finite()));
            usable && pairs.all(|(a, b)| (a - b).abs() < FURTHEST)
        })
    })
}
