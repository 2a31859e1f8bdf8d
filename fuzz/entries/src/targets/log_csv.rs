//! Logs as text, plain and compressed.

use files::Log;

/// Reads a log; what is read can be asked for what logs are asked for.
pub fn run(bytes: &[u8]) {
    for name in ["log.csv", "log.csv.gz"] {
        if let Ok(log) = Log::parse(name, bytes.to_vec()) {
            let _ = (log.len(), log.duration_s());
        }
    }
}
