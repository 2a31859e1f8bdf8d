//! What was seen of the board, tick by tick.

use crate::converter::Converter;
use crate::handler::Handler;
use crate::registers::Time;

/// A tick as it looks from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tick {
    /// Updates of the timer since the last reset.
    pub number: u64,
    /// When the timer's event came.
    pub at: Time,
    /// What the counters had then.
    pub counts: [u32; 3],
    /// Codes of outputs A, B and C when the tick was over.
    pub codes: [i16; 3],
    /// Whether CLR let the outputs follow then.
    pub released: bool,
    /// From the timer's event to LDAC; `None` where nothing was put out.
    pub latency: Option<Time>,
}

/// What was seen.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// Whether ticks are kept.
    pub is_on: bool,
    /// What the tick took.
    pub handler: Handler,
    /// The ticks.
    pub ticks: Vec<Tick>,
    /// What the counters have in the tick that is going on.
    pub counts: [u32; 3],
    /// Faults of the core, with their places.
    pub faults: Vec<String>,
    /// When CLR last fell.
    pub cleared_at: Option<Time>,
    released: bool,
    begun: Time,
    loads: u64,
}

impl Trace {
    /// CLR, as it is now.
    pub(crate) fn released(&mut self, now: Time, released: bool) {
        if self.released && !released {
            self.cleared_at = Some(now);
        }
        self.released = released;
    }

    /// Another tick begins; what the converter has is the result of the one before.
    pub(crate) fn tick(&mut self, now: Time, converter: &Converter, number: u64) {
        if self.is_on && number > 1 {
            let loaded = converter.loads != self.loads;
            let [a, b, c, _] = converter.codes;
            self.ticks.push(Tick {
                number: number - 1,
                at: self.begun,
                counts: self.counts,
                codes: [a, b, c],
                released: converter.is_released(),
                latency: loaded.then(|| converter.loaded_at - self.begun),
            });
        }
        self.loads = converter.loads;
        self.begun = now;
    }
}
