//! What the handler of the tick takes: instructions and cycles, to the codes and in all.

use std::collections::BTreeMap;

use crate::registers::Time;

/// A point or a span in the handler.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Instructions.
    pub instructions: u64,
    /// Cycles of 170 MHz.
    pub cycles: Time,
}

impl Cost {
    fn since(self, earlier: Self) -> Self {
        Self {
            instructions: self.instructions - earlier.instructions,
            cycles: self.cycles - earlier.cycles,
        }
    }
}

/// One run of the handler, from its first instruction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// Until the first code goes out: SYNC falls for the first time.
    pub to_codes: Cost,
    /// Until the last of three is in the converter: SYNC rises for the third time.
    pub to_converter: Cost,
    /// All of it.
    pub whole: Cost,
}

/// What the handler of the tick took, from its first instruction to its last.
#[derive(Clone, Debug, Default)]
pub struct Handler {
    /// How often it ran.
    pub runs: u64,
    /// Instructions of all runs.
    pub instructions: u64,
    /// Of the runs that took most, each on its own account.
    pub most: Cost,
    is_kept: bool,
    /// Those runs, each with the updates of the timer that there had been.
    pub kept: Vec<(u64, Run)>,
    /// How often each instruction of those runs was executed, by its address; where it is kept.
    pub executed: BTreeMap<u32, u64>,
    begun: Option<Cost>,
    run: Run,
    edges: u32,
}

impl Handler {
    /// One that keeps the runs that put codes out.
    pub fn keeping() -> Self {
        Self { is_kept: true, ..Self::default() }
    }

    pub(crate) fn enter(&mut self, now: Cost) {
        (self.begun, self.run, self.edges) = (Some(now), Run::default(), 0);
    }

    /// An instruction is executed.
    #[inline]
    pub(crate) fn execute(&mut self, address: u32) {
        if self.is_kept && self.begun.is_some() {
            *self.executed.entry(address).or_default() += 1;
        }
    }

    /// SYNC has fallen or risen.
    pub(crate) fn sync(&mut self, now: Cost) {
        let Some(begun) = self.begun else { return };
        self.edges += 1;
        match self.edges {
            1 => self.run.to_codes = now.since(begun),
            6 => self.run.to_converter = now.since(begun),
            _ => {}
        }
    }

    pub(crate) fn leave(&mut self, now: Cost, updates: u64) {
        let Some(begun) = self.begun.take() else { return };
        self.run.whole = now.since(begun);
        let Cost { instructions, cycles } = self.run.whole;
        self.runs += 1;
        self.instructions += instructions;
        self.most.instructions = self.most.instructions.max(instructions);
        self.most.cycles = self.most.cycles.max(cycles);
        if self.is_kept && self.edges >= 6 {
            self.kept.push((updates, self.run));
        }
    }
}
