//! When a counter passes a value.

/// A counter that counts up from a value and begins anew after its period.
#[derive(Clone, Copy, Debug)]
pub struct Events {
    /// Values from 0 to this less one.
    pub period: u64,
    /// Cycles of a count.
    pub cycles: u64,
    /// The value now.
    pub from: u64,
}

impl Events {
    /// Cycles until it next becomes this value; `None` if it never does.
    pub fn until(&self, value: u64) -> Option<u64> {
        self.distance(value).map(|counts| counts * self.cycles)
    }

    /// How often it becomes this value in so many counts.
    pub fn times(&self, value: u64, counts: u64) -> u64 {
        match self.distance(value) {
            Some(first) if first <= counts => 1 + (counts - first) / self.period,
            _ => 0,
        }
    }

    /// Counts until it next becomes this value, at least one.
    fn distance(&self, value: u64) -> Option<u64> {
        if value >= self.period {
            return None;
        }
        // A counter beyond its period goes on until it begins anew.
        let here = self.from % self.period;
        Some(1 + (value + self.period - here - 1) % self.period)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counter_passes_each_value_once_a_period() {
        let events = Events { period: 10, cycles: 17, from: 8 };
        assert_eq!(events.until(0), Some(2 * 17));
        assert_eq!(events.until(8), Some(10 * 17));
        assert_eq!(events.until(10), None);
        assert_eq!([1, 2, 11, 12].map(|counts| events.times(0, counts)), [0, 1, 1, 2]);
    }
}
