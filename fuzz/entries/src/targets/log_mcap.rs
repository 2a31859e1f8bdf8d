//! Logs as MCAP.

use files::Log;

/// Reads a log.
pub fn run(bytes: &[u8]) {
    if let Ok(log) = Log::parse("log.mcap", bytes.to_vec()) {
        let _ = (log.len(), log.duration_s());
    }
}
