//! The board above the simulated pins: a tick, and its serial line.

use firmware::link::BoardRuntime;
use firmware::lockstep::Reply;

use crate::flash::FileFlash;
use crate::line::Line;
use crate::timer;

/// The store in the file that stands for the flash.
pub type Store = firmware::store::Store<FileFlash>;

/// Counts of the timer in a tick of 1 ms.
const COUNTS_PER_TICK: u32 = 25_000;

/// The board above the simulated pins.
pub struct Board {
    pub runtime: BoardRuntime<Store>,
    line: Line,
    /// Counts of the timer that the last tick took.
    last_tick_counts: u32,
}

impl Board {
    /// A board that has booted.
    pub fn new(runtime: BoardRuntime<Store>) -> Self {
        Self { runtime, line: Line::open(), last_tick_counts: 0 }
    }

    /// A tick. What is done after it is [`Board::serve_line`].
    pub fn tick(&mut self, counts: &[i32; 3]) -> Reply {
        let mut health = self.runtime.health();
        health.tick_time_tenth_us = tenth_us(self.last_tick_counts);
        let before = timer::now();
        self.runtime.supervisor.act(counts, &health);
        let timer_counts = timer::now().wrapping_sub(before);
        let record = self.runtime.supervisor.complete();
        self.last_tick_counts = timer_counts;
        self.runtime.after_tick(&record);
        Reply {
            accepted: true,
            saturated: record.saturated,
            codes: record.codes,
            reference: record.reference,
            timer_counts,
            ..Reply::default()
        }
    }

    /// Serves the line; what it has changed is in the next tick.
    pub fn serve_line(&mut self) {
        self.line.serve(&mut self.runtime);
        self.runtime.supervisor.prepare();
    }

    /// Ticks by the board's own clock for ever, at encoders that stand still.
    pub fn tick_alone(&mut self) -> ! {
        let mut last = timer::now();
        loop {
            self.serve_line();
            if timer::now().wrapping_sub(last) >= COUNTS_PER_TICK {
                last = timer::now();
                self.tick(&[0; 3]);
            }
        }
    }
}

/// Counts of 25 MHz of the emulated clock as time [0.1 us].
fn tenth_us(counts: u32) -> u16 {
    (counts / 5 * 2).min(u32::from(u16::MAX)) as u16
}
