//! Goals that never reached the drive: whoever recorded the log clipped them.

use crate::judged::Judged;
use crate::settings::Settings;

/// A joint that stops at one and the same place while its goals go on.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalClip {
    /// The log.
    pub file: String,
    /// The joint, from 1.
    pub joint: usize,
    /// Where it stops [rad; m].
    pub at: f64,
    /// Which goals are clipped: 1 those above, -1 those below.
    pub side: f64,
}

/// Clipped goals of a log, by the joints' deviations: wherever the goal is far beyond the joint's
/// furthest position, the joint stands just there.
pub fn goal_clips(judged: &Judged, deviations: &[f64], settings: &Settings) -> Vec<GoalClip> {
    /// A second at 50 Hz.
    const FEWEST_ROWS: usize = 50;
    let mut found = Vec::new();
    for (joint, track) in judged.record.joints.iter().enumerate() {
        let near = settings.contact_deviations * deviations[joint];
        for side in [-1.0, 1.0] {
            let end = track.position.iter().map(|q| side * q).fold(f64::NEG_INFINITY, f64::max);
            let beyond = |row: &usize| {
                judged.counts[joint][*row] && side * track.goal[*row] > end + 5.0 * near
            };
            let rows: Vec<usize> = (0..judged.record.len()).filter(beyond).collect();
            let stands = rows.iter().filter(|row| side * track.position[**row] > end - 0.5 * near);
            if rows.len() >= FEWEST_ROWS && 5 * stands.count() > 3 * rows.len() {
                let file = judged.record.file.clone();
                found.push(GoalClip { file, joint: joint + 1, at: side * end, side });
            }
        }
    }
    found
}

/// Takes the rows out of what counts from the first clipped goal on: what follows began elsewhere.
pub fn cut(judged: &mut Judged, clips: &[GoalClip], settings: &Settings) {
    let time = judged.record.time_s.clone();
    for clip in clips.iter().filter(|clip| clip.file == judged.record.file) {
        let goals = &judged.record.joints[clip.joint - 1].goal;
        let mut until = f64::NEG_INFINITY;
        for (row, now) in time.iter().enumerate() {
            if clip.side * goals[row] > clip.side * clip.at {
                until = now + settings.contact_margin_s;
            }
            if *now <= until {
                judged.counts[clip.joint - 1][row] = false;
            }
        }
    }
}
