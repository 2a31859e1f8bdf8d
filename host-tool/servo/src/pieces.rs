//! Records cut where there are too few, so that there is something to leave out and to hold out.

use files::Role;

use crate::record::{Record, Track};
use crate::settings::Settings;

/// Part of each log that confirms where none is held out.
const HELD_OUT: f64 = 0.3;

/// The records with enough pieces to fit to and some to confirm on.
pub fn pieces(records: Vec<Record>, is_held_out: bool, settings: &Settings) -> Vec<Record> {
    let records: Vec<Record> = match is_held_out {
        true => records,
        false => records.into_iter().flat_map(split).collect(),
    };
    let train = records.iter().filter(|record| record.role == Role::Train).count().max(1);
    let parts = (2 * settings.folds).div_ceil(train);
    let cut = |record: Record| {
        let length = record.time_s.last().zip(record.time_s.first()).map_or(0.0, |(l, f)| l - f);
        // Shorter pieces begin before they have settled.
        let most = (length / (4.0 * settings.shortest_s)).floor().max(1.0) as usize;
        let parts = if record.role == Role::Train { parts.min(most) } else { 1 };
        let edge = |k: usize| k * record.len() / parts;
        (0..parts).map(|k| part(&record, edge(k)..edge(k + 1), record.role)).collect::<Vec<_>>()
    };
    records.into_iter().flat_map(cut).collect()
}

/// The first part to fit to, the last to confirm on.
fn split(record: Record) -> [Record; 2] {
    let at = ((1.0 - HELD_OUT) * record.len() as f64) as usize;
    [part(&record, 0..at, Role::Train), part(&record, at..record.len(), Role::Holdout)]
}

fn part(record: &Record, rows: std::ops::Range<usize>, role: Role) -> Record {
    let of = |values: &[f64]| values[rows.clone()].to_vec();
    let track = |track: &Track| Track {
        goal: of(&track.goal),
        position: of(&track.position),
        velocity: of(&track.velocity),
        acceleration: of(&track.acceleration),
    };
    Record {
        file: record.file.clone(),
        role,
        time_s: of(&record.time_s),
        joints: record.joints.iter().map(track).collect(),
    }
}
