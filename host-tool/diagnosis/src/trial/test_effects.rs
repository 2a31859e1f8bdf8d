//! Effects for tests.

use super::hypothesis::EffectInstance;
use rig::effects::{Catalogue, Kind};

/// A wave of an order on a joint (from 1), all its other values 0.1.
pub fn wave(name: &str, joint: u8, order: f64) -> EffectInstance {
    let definition = Catalogue::standard().by_name(name).unwrap();
    let value = |kind| if kind == Kind::Harmonic { order } else { 0.1 };
    let values = definition.parameters.iter().map(|p| value(p.kind)).collect();
    EffectInstance { definition, joint, values }
}
