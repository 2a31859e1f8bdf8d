//! A record with the rigid body along it, and the rows that count.

use std::ops::Range;

use model::chain::SerialChain;

use crate::along::{AlongRow, along};
use crate::record::Record;
use crate::settings::Settings;

/// What hypotheses are judged on.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The log's stretch.
    pub record: Record,
    /// The rigid body along it, by joint and row.
    pub along: Vec<Vec<AlongRow>>,
    /// Which rows count, by joint and row: not those of contact.
    pub counts: Vec<Vec<bool>>,
    /// Rows of blocks that weigh alike in a fit.
    pub blocks: Vec<Range<usize>>,
}

impl Judged {
    /// All rows count; `links` has no rotors.
    pub fn of(links: &SerialChain<f64>, record: Record, settings: &Settings) -> Self {
        let along = along(links, &record);
        let counts = vec![vec![true; record.len()]; record.joints.len()];
        let blocks = blocks(&record.time_s, settings.block_s);
        Self { record, along, counts, blocks }
    }
}

/// Rows of blocks of about the same length [s].
fn blocks(time_s: &[f64], block_s: f64) -> Vec<Range<usize>> {
    let length = time_s.last().zip(time_s.first()).map_or(0.0, |(last, first)| last - first);
    let count = (length / block_s).round().max(1.0) as usize;
    let edge = |k: usize| k * time_s.len() / count;
    (0..count).map(|k| edge(k)..edge(k + 1)).collect()
}
