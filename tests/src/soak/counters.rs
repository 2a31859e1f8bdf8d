//! What a soak has counted.

use std::fmt::{Display, Formatter, Result};

/// Counts and figures of a soak.
#[derive(Clone, Debug, Default)]
pub struct SoakCounters {
    /// Ticks.
    pub ticks: u64,
    /// Of those, in runs.
    pub ticks_running: u64,
    /// Sessions, and in how many of them a joint was in each mode.
    pub sessions: u32,
    /// Joints run in each of the five modes.
    pub modes: [u32; 5],
    /// Blocks acknowledged, and read back the same.
    pub uploads: u32,
    /// Of those, committed to the store.
    pub commits: u32,
    /// Resets, each of which found the block that was committed last.
    pub resets: u32,
    /// Faults injected; as many were found, each in its tick.
    pub faults_injected: u32,
    /// Faults that nobody injected.
    pub faults_otherwise: u32,
    /// Requests answered.
    pub answered: u64,
    /// Requests sent again as no answer came.
    pub retries: u64,
    /// Bytes on the line, both ways.
    pub bytes: u64,
    /// Of those, broken.
    pub bytes_broken: u64,
    /// Telemetry records that came whole.
    pub records: u64,
    /// Records that the host missed, by their numbers.
    pub records_missed: u64,
    /// Of those, the board said it could not send.
    pub records_dropped: u64,
    /// Rms tracking error of a joint in `pd-model`: largest change from the first to the last
    /// quarter of a run [rad].
    pub worst_drift_rad: f64,
    /// Largest tracking error of a joint in `pd-model` [rad].
    pub worst_error_rad: f64,
}

impl Display for SoakCounters {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        writeln!(
            f,
            "simulated              {:.2} h, {} ticks",
            self.ticks as f64 / 3.6e6,
            self.ticks
        )?;
        writeln!(
            f,
            "running                {} ticks in {} sessions",
            self.ticks_running, self.sessions
        )?;
        writeln!(
            f,
            "joints by mode         {:?} (pd, pd-friction, pd-model, friction-only, open-loop)",
            self.modes
        )?;
        writeln!(
            f,
            "uploads acknowledged   {}, {} of them committed, all read back the same",
            self.uploads, self.commits
        )?;
        writeln!(f, "resets                 {}, each found the block committed last", self.resets)?;
        writeln!(
            f,
            "faults                 {} injected and found, {} others",
            self.faults_injected, self.faults_otherwise
        )?;
        writeln!(f, "requests answered      {}, {} asked again", self.answered, self.retries)?;
        writeln!(f, "bytes on the line      {}, {} broken", self.bytes, self.bytes_broken)?;
        writeln!(
            f,
            "telemetry records      {} whole, {} missed by number, {} of them dropped by the board",
            self.records, self.records_missed, self.records_dropped
        )?;
        writeln!(
            f,
            "tracking, pd-model     at most {:.3} mrad; rms changes by {:.4} mrad at most",
            1e3 * self.worst_error_rad,
            1e3 * self.worst_drift_rad
        )
    }
}
