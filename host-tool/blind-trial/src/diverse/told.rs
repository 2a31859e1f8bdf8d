//! The shares that true causes have by the report's own measure.

use std::collections::BTreeMap;

use crate::case::Case;
use crate::cause::TrueCause;
use diagnosis::{Criteria, told_shares};
use files::EffectTable;
use recordings::Campaign;
use rig::effects::Catalogue;

/// The share of each cause of a case, told with its values to a model that is refitted to the very logs
/// that are diagnosed, with as much doubt as the report's own models; `None` where the catalogue does not
/// have it. Shares follow from how far parameters may make up for a cause, so they are held against
/// those of the same doubt.
pub fn told(case: &Case, campaign: &Campaign, criteria: &Criteria) -> Vec<Option<f64>> {
    let tables = tables(case);
    let mut campaign = campaign.clone();
    campaign.robot_file.effects = tables.values().cloned().collect();
    let shares = told_shares(&campaign, &Catalogue::standard(), criteria).unwrap_or_default();
    let of_known: BTreeMap<usize, Option<f64>> = tables.into_keys().zip(shares).collect();
    (0..case.causes.len()).map(|k| of_known.get(&k).copied().flatten()).collect()
}

/// The true causes that the catalogue has, with their values.
pub fn true_effects(case: &Case) -> Vec<EffectTable> {
    tables(case).into_values().collect()
}

/// The same by their places among all causes.
fn tables(case: &Case) -> BTreeMap<usize, EffectTable> {
    case.causes.iter().enumerate().filter_map(|(k, cause)| Some((k, table(cause)?))).collect()
}

/// As a model's file has it.
fn table(cause: &TrueCause) -> Option<EffectTable> {
    if cause.is_foreign() {
        return None;
    }
    toml::Value::try_from(cause).ok()?.try_into().ok()
}
