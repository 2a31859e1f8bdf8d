//! A log as the simulation takes it.

use files::Role;
use recordings::ArmRecording;

use crate::motion::derivatives;
use crate::settings::Settings;

/// An unbroken stretch of a log: goals and positions of all joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The log's file.
    pub file: String,
    /// What the log is for.
    pub role: Role,
    /// Times of the rows since the log began [s].
    pub time_s: Vec<f64>,
    /// The joints, base to tip.
    pub joints: Vec<Track>,
}

/// One joint of a record, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// Goals [rad; m].
    pub goal: Vec<f64>,
    /// Measured positions [rad; m].
    pub position: Vec<f64>,
    /// Their smoothed velocity [rad/s; m/s].
    pub velocity: Vec<f64>,
    /// Their smoothed acceleration [rad/s^2; m/s^2].
    pub acceleration: Vec<f64>,
}

impl Record {
    /// The stretches of a log that are long enough.
    pub fn of(recording: &ArmRecording, settings: &Settings) -> Vec<Self> {
        let time = &recording.log.time_s;
        let limit = settings.gap_periods * period(time);
        let breaks = (1..time.len()).filter(|k| time[*k] - time[*k - 1] > limit);
        let mut ends: Vec<usize> = breaks.collect();
        ends.push(time.len());
        let mut from = 0;
        let mut records = Vec::new();
        for to in ends {
            let part = from..to;
            from = to;
            if to > part.start && time[to - 1] - time[part.start] >= settings.shortest_s {
                records.push(Self::stretch(recording, part, settings));
            }
        }
        records
    }

    fn stretch(
        recording: &ArmRecording,
        rows: std::ops::Range<usize>,
        settings: &Settings,
    ) -> Self {
        let log = &recording.log;
        let begin = log.time_s.first().copied().unwrap_or(0.0);
        let time_s: Vec<f64> = log.time_s[rows.clone()].iter().map(|t| t - begin).collect();
        let track = |joint: &files::ArmJointLog| {
            let position = joint.position[rows.clone()].to_vec();
            let (velocity, acceleration) = derivatives(&time_s, &position, settings.half_window_s);
            Track { goal: joint.command[rows.clone()].to_vec(), position, velocity, acceleration }
        };
        let joints = log.joints.iter().map(track).collect();
        Self { file: recording.file.clone(), role: recording.role, time_s, joints }
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }
}

/// The median distance of rows [s].
pub fn period(time_s: &[f64]) -> f64 {
    let mut steps: Vec<f64> = time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied().unwrap_or(0.0)
}
