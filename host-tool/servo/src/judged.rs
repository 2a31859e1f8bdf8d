//! A record with the rigid body along it, and the rows that count.

use std::ops::Range;

use model::chain::SerialChain;

use crate::along::along;
use crate::along_row::AlongRow;
use crate::moves::{Moves, measured};
use crate::record::Record;
use crate::settings::Settings;

/// What hypotheses are judged on.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The log's stretch.
    pub record: Record,
    /// The motion along which the rigid body is computed, by joint.
    pub moves: Vec<Moves>,
    /// The rigid body along it, by joint and row.
    pub along: Vec<Vec<AlongRow>>,
    /// Which rows count, by joint and row: not those of contact.
    pub counts: Vec<Vec<bool>>,
    /// Rows of blocks that weigh alike in a fit.
    pub blocks: Vec<Range<usize>>,
}

impl Judged {
    /// All rows count but those of the start; `links` has no rotors.
    pub fn of(links: &SerialChain<f64>, record: Record, settings: &Settings) -> Self {
        let moves = measured(&record);
        let along = along(links, &moves);
        let begin = record.time_s.first().map_or(0.0, |first| first + settings.start_s);
        let started: Vec<bool> = record.time_s.iter().map(|t| *t >= begin).collect();
        let counts = vec![started; record.joints.len()];
        let blocks = blocks(&record.time_s, settings.block_s);
        Self { record, moves, along, counts, blocks }
    }
}

/// Rows of blocks of about the same length [s].
fn blocks(time_s: &[f64], block_s: f64) -> Vec<Range<usize>> {
    let length = time_s.last().zip(time_s.first()).map_or(0.0, |(last, first)| last - first);
    let count = (length / block_s).round().max(1.0) as usize;
    let edge = |k: usize| k * time_s.len() / count;
    (0..count).map(|k| edge(k)..edge(k + 1)).collect()
}
