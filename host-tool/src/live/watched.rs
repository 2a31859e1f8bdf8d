//! Records of a board that is watched, whatever its state, as rows.

use firmware::ParameterBlock;
use firmware::link::Telemetry;

use super::Server;
use link::Recorder;

/// The rows since the last that were sent.
pub struct Watched {
    recorder: Recorder,
    sent: usize,
}

impl Watched {
    /// Of a board with this block.
    pub fn of(block: &ParameterBlock) -> Self {
        Self { recorder: Recorder::watching(block), sent: 0 }
    }

    /// Takes records and sends them.
    pub fn send(&mut self, records: &[Telemetry], server: &mut Server) {
        records.iter().for_each(|record| self.recorder.add_record(record));
        let rows = self.recorder.log.len();
        server.send(&self.recorder.log, &self.recorder.board, self.sent..rows);
        // The last row stays: velocity is the difference from it.
        self.recorder.forget_all_but_last();
        self.sent = self.recorder.log.len();
    }
}
