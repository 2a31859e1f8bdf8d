//! What is done while the arm moves: the table is drawn, the log is written.

use std::io::IsTerminal;
use std::time::Instant;

use firmware::link::Report;

use super::super::board_table::{PERIOD, redrawn, table};
use crate::live::Server;
use crate::terminal::json_mode::is_json;
use crate::terminal::output;
use crate::terminal::progress::Progress;
use files::GrowingCsv;
use link::Recorder;
use link::run::RunWatcher;

/// Sees a phase of a run: a table where the standard output is a terminal, else a bar, if the
/// standard error is one.
pub struct Live<'a> {
    phase: &'static str,
    counts_per_turn: f64,
    bar: Option<Progress>,
    /// The log so far; none any more once the disk has refused a row.
    growing: Option<GrowingCsv>,
    report: Option<Report>,
    drawn: Option<Instant>,
    lines: usize,
    foxglove: Option<&'a mut Server>,
    /// Rows that were served.
    served: usize,
}

impl<'a> Live<'a> {
    /// For a phase of so many ticks, whose log grows in this file.
    pub fn new(phase: &'static str, ticks: u32, counts: u32, growing: GrowingCsv) -> Self {
        let is_terminal = std::io::stdout().is_terminal() && !is_json();
        Self {
            phase,
            counts_per_turn: f64::from(counts),
            bar: (!is_terminal).then(|| Progress::new(phase, u64::from(ticks))),
            growing: Some(growing),
            report: None,
            drawn: None,
            lines: 0,
            foxglove: None,
            served: 0,
        }
    }

    /// The same with a server that gets every row.
    pub fn served_by(mut self, mut server: Option<&'a mut Server>) -> Self {
        if let Some(server) = &mut server {
            server.begin();
        }
        self.foxglove = server;
        self
    }

    /// Takes table or bar away; the file that grew, where it holds every row.
    pub fn finish(self) -> Option<GrowingCsv> {
        match &self.bar {
            Some(bar) => bar.finish(),
            None => drop(output::write(&redrawn("", self.lines))),
        }
        self.growing
    }

    fn draw(&mut self, recorder: &Recorder) {
        let (Some(report), Some(record)) = (&self.report, recorder.last_record()) else { return };
        if self.drawn.is_some_and(|drawn| drawn.elapsed() < PERIOD) {
            return;
        }
        let (phase, done, ticks) = (self.phase, recorder.ticks_seen(), recorder.ticks());
        let text = table(record, report, self.counts_per_turn);
        let text = format!("{text}{phase}  {:.1} of {:.1} s\n", seconds(done), seconds(ticks));
        // An arm that moves does not depend on the terminal.
        let _ = output::write(&redrawn(&text, self.lines));
        self.lines = text.lines().count();
        self.drawn = Some(Instant::now());
    }
}

/// Ticks of a millisecond, as all boards have.
fn seconds(ticks: u32) -> f64 {
    f64::from(ticks) / 1e3
}

impl RunWatcher for Live<'_> {
    fn see(&mut self, recorder: &Recorder) {
        let refused = self.growing.as_mut().is_some_and(|file| file.follow(&recorder.log).is_err());
        if refused {
            // The whole log is tried again in the end, and that tells why.
            self.growing = None;
        }
        if let Some(server) = &mut self.foxglove {
            server.send(&recorder.log, &recorder.board, self.served..recorder.log.len());
            self.served = recorder.log.len();
        }
        match &self.bar {
            Some(bar) => bar.at(u64::from(recorder.ticks_seen())),
            None => self.draw(recorder),
        }
    }

    fn see_report(&mut self, report: &Report) {
        self.report = Some(*report);
    }
}
