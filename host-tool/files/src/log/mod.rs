//! A log: what the joints did, sample by sample.

mod board_message;
mod channel;
pub(crate) mod check;
mod format;
mod from_table;
mod growing_csv;
mod joint_columns;
mod joint_message;
pub mod live;
mod mcap_details;
mod read_mcap;
mod write_csv;
mod write_mcap;

pub use board_message::BoardSample;
pub use channel::Channel;
pub use check::check_joints;
pub use growing_csv::GrowingCsv;
pub use mcap_details::{McapDetails, unix_ns};

/// A recorded log.
///
/// Row `i` of a joint holds the position sampled at `time_s[i]` and the voltage that
/// the amplifier got during the interval that begins there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// Sample times [s], strictly increasing, not always evenly spaced.
    pub time_s: Vec<f64>,
    /// The joints that the log holds, in the order of their numbers.
    pub joints: Vec<JointLog>,
}

/// One joint's columns of a log, each as long as [`Log::time_s`].
#[derive(Clone, Debug, PartialEq)]
pub struct JointLog {
    /// Which joint, 1 to 3.
    pub joint: u8,
    /// Measured position.
    pub position: Position,
    /// Commanded voltage after quantisation and limits [V].
    pub command_v: Vec<f64>,
    /// Reference position [rad].
    pub reference_rad: Option<Vec<f64>>,
}

/// A joint's measured position.
#[derive(Clone, Debug, PartialEq)]
pub enum Position {
    /// Encoder counts since power-on, over many turns.
    Count(Vec<i64>),
    /// Radians.
    Radian(Vec<f64>),
}

impl Log {
    /// How many samples each joint has.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// Time from the first sample to the last [s].
    pub fn duration_s(&self) -> f64 {
        match (self.time_s.first(), self.time_s.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        }
    }

    /// The usual time from sample to sample [s]: the median, which gaps do not move.
    /// `None` below two samples.
    pub fn sample_period_s(&self) -> Option<f64> {
        let mut steps: Vec<f64> = self.time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if steps.is_empty() {
            return None;
        }
        let middle = steps.len() / 2;
        let (_, median, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
        Some(*median)
    }

    /// A joint by its number, 1 to 3.
    pub fn joint(&self, number: u8) -> Option<&JointLog> {
        self.joints.iter().find(|joint| joint.joint == number)
    }

    /// Whether a position is in encoder counts, for which the counts per turn are needed.
    pub fn needs_counts_per_rev(&self) -> bool {
        self.joints.iter().any(|joint| matches!(joint.position, Position::Count(_)))
    }
}

impl JointLog {
    /// The position in radians; `counts_per_rev` is not used where the log has radians.
    pub fn position_rad(&self, counts_per_rev: f64) -> Vec<f64> {
        self.position.radians(counts_per_rev)
    }
}

impl Position {
    /// How many samples there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Count(counts) => counts.len(),
            Self::Radian(angles) => angles.len(),
        }
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The position in radians; `counts_per_rev` is not used where it is in radians already.
    pub fn radians(&self, counts_per_rev: f64) -> Vec<f64> {
        let radians_per_count = std::f64::consts::TAU / counts_per_rev;
        match self {
            Self::Count(counts) => counts.iter().map(|&c| c as f64 * radians_per_count).collect(),
            Self::Radian(angles) => angles.clone(),
        }
    }
}
