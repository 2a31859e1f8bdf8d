//! Which of the board's ticks a run took, from their sequence numbers.

/// The ticks of a run. Numbers wrap as the board's do.
///
/// Where the records at a run's beginning or end are lost, every tick counts for the run that
/// may have been of it: at most those between the host's last query and its run command.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TickRange {
    before: Option<u32>,
    newest: Option<u32>,
    after: Option<u32>,
}

impl TickRange {
    /// The run begins after this tick.
    pub fn begins_after(&mut self, tick: u32) {
        if self.before.is_none_or(|before| is_later(tick, before)) {
            self.before = Some(tick);
        }
    }

    /// The board runs, as of this tick.
    pub fn runs_at(&mut self, tick: u32) {
        let before = *self.before.get_or_insert(tick.wrapping_sub(1));
        if is_later(tick, self.newest.unwrap_or(before)) {
            self.newest = Some(tick);
        }
    }

    /// The run has ended before this tick.
    pub fn ended_before(&mut self, tick: u32) {
        if self.after.is_none_or(|after| is_later(after, tick)) {
            self.after = Some(tick);
        }
    }

    /// Whether a tick is not of this run but from before it.
    pub fn is_past(&self, tick: u32) -> bool {
        self.before.is_some_and(|before| !is_later(tick, before))
    }

    /// How many ticks of the run came before this one.
    pub fn since(&self, tick: u32) -> u32 {
        let since = |before: &u32| tick.wrapping_sub(*before).wrapping_sub(1);
        self.before.filter(|before| is_later(tick, *before)).as_ref().map_or(0, since)
    }

    /// How many ticks the run has taken; once it has ended, how many it took.
    pub fn ticks(&self) -> u32 {
        match (self.after, self.newest) {
            (Some(after), _) => self.since(after),
            (None, Some(newest)) => self.since(newest) + 1,
            (None, None) => 0,
        }
    }
}

fn is_later(tick: u32, other: u32) -> bool {
    (1..=u32::MAX / 2).contains(&tick.wrapping_sub(other))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_wrap() {
        let mut range = TickRange::default();
        range.begins_after(u32::MAX - 2);
        range.begins_after(u32::MAX - 5);
        assert!(range.is_past(u32::MAX - 2) && !range.is_past(1));
        range.runs_at(3);
        range.runs_at(1);
        assert_eq!((range.since(u32::MAX - 1), range.since(3), range.ticks()), (0, 5, 6));
        range.ended_before(9);
        range.ended_before(5);
        assert_eq!(range.ticks(), 7);
    }

    #[test]
    fn a_run_that_ended_before_it_began_has_no_tick() {
        let mut range = TickRange::default();
        range.begins_after(100);
        range.ended_before(98);
        assert_eq!(
            (range.since(98), range.since(100), range.since(101), range.ticks()),
            (0, 0, 0, 0)
        );
    }

    #[test]
    fn without_any_report_there_is_no_tick() {
        let mut range = TickRange::default();
        assert_eq!(range.ticks(), 0);
        range.begins_after(7);
        assert_eq!(range.ticks(), 0);
    }
}
