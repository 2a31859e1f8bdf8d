//! Instructions and cycles, added up or compared each on its own account.

/// What a path takes at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Instructions.
    pub instructions: u64,
    /// Cycles.
    pub cycles: u64,
}

impl Cost {
    /// One path, then the other.
    pub fn then(self, next: Self) -> Self {
        Self {
            instructions: self.instructions + next.instructions,
            cycles: self.cycles + next.cycles,
        }
    }

    /// One path or the other.
    pub fn or(self, other: Self) -> Self {
        Self {
            instructions: self.instructions.max(other.instructions),
            cycles: self.cycles.max(other.cycles),
        }
    }

    /// So many rounds.
    pub fn times(self, rounds: u64) -> Self {
        Self { instructions: self.instructions * rounds, cycles: self.cycles * rounds }
    }
}
