//! Telemetry of a run, as a log.

use std::f64::consts::TAU;

use firmware::link::{Report, Telemetry};
use firmware::supervisor::State;
use firmware::{Mode, ParameterBlock};

use super::tick_range::TickRange;
use files::{BoardSample, JointLog, Log, Position};
use signal::Unwrapper;

/// Turns the records of a run into a log, in the order in which they come.
#[derive(Debug)]
pub struct Recorder {
    /// The log so far; a record that is missing is a gap in its times.
    pub log: Log,
    /// What the board reported beside the joints, row by row of the log; then the tick that ended
    /// the run, if its record or one after it has come.
    pub board: Vec<BoardSample>,
    /// Longest tick [0.1 us].
    pub longest_tick_tenth_us: u16,
    /// Ticks in which the command of a joint was cut at its limit.
    pub saturated: [u32; 3],
    counts_per_turn: f64,
    period_ns: f64,
    ticks: u32,
    tick_range: TickRange,
    dropped: Dropped,
    /// The board may run from now on.
    run_expected: bool,
    /// Every record is a row, whatever the board's state; the first one's number.
    watched: Option<Watched>,
    unwrapped: Option<Unwrapped>,
}

/// The first record of a board that is watched.
#[derive(Debug, Default)]
struct Watched {
    first: Option<u32>,
}

/// What is carried on from record to record.
#[derive(Debug)]
struct Unwrapped {
    last: Telemetry,
    counts: [i64; 3],
    references: [Unwrapper; 3],
}

/// The board's count of records that it could not send.
#[derive(Debug, Default)]
struct Dropped {
    before: Option<u32>,
    newest: u32,
    is_after: bool,
}

impl Recorder {
    /// For a run of so many ticks with this block; its log has the joints that are there.
    pub fn new(block: &ParameterBlock, ticks: u32) -> Self {
        let joints = rig::joints::present(block);
        let joint = |joint| JointLog {
            joint,
            position: Position::Count(Vec::new()),
            command_v: Vec::new(),
            reference_rad: Some(Vec::new()),
        };
        Self {
            log: Log { time_s: Vec::new(), joints: joints.into_iter().map(joint).collect() },
            board: Vec::new(),
            longest_tick_tenth_us: 0,
            saturated: [0; 3],
            counts_per_turn: f64::from(block.encoder_counts_per_turn),
            // The block has it as an f32; in whole nanoseconds it is what was meant.
            period_ns: (f64::from(block.sample_period_s) * 1e9).round(),
            ticks,
            tick_range: TickRange::default(),
            dropped: Dropped::default(),
            run_expected: false,
            watched: None,
            unwrapped: None,
        }
    }

    /// For a board that is watched: every record is a row, whatever the board's state.
    pub fn watching(block: &ParameterBlock) -> Self {
        Self { watched: Some(Watched::default()), ..Self::new(block, u32::MAX) }
    }

    /// Forgets all rows but the last, of a board that is watched for long.
    pub fn forget_all_but_last(&mut self) {
        let forgotten = self.log.len().saturating_sub(1);
        self.log.time_s.drain(..forgotten);
        self.board.drain(..forgotten.min(self.board.len()));
        for joint in &mut self.log.joints {
            joint.command_v.drain(..forgotten);
            if let Position::Count(counts) = &mut joint.position {
                counts.drain(..forgotten);
            }
            if let Some(column) = &mut joint.reference_rad {
                column.drain(..forgotten);
            }
        }
    }

    /// Takes a report from before the run: of the ticks up to its own, none is of the run.
    pub fn begins_after(&mut self, report: &Report) {
        self.tick_range.begins_after(report.counters.ticks);
        self.dropped.before = Some(report.counters.telemetry_dropped);
    }

    /// The run command is sent: what the board reports from now on is of the run or after it.
    pub fn expect_run(&mut self) {
        self.run_expected = true;
    }

    /// Takes a report from within the run or after it; it also counts ticks whose records are lost.
    pub fn add_report(&mut self, report: &Report) {
        let ticks = report.counters.ticks;
        if !self.run_expected {
            return;
        }
        match (report.state, report.fault) {
            (State::Running, _) => return self.tick_range.runs_at(ticks),
            (State::Faulted | State::Stopping, Some(fault)) => {
                self.tick_range.ended_before(fault.tick)
            }
            _ => self.tick_range.ended_before(ticks.wrapping_add(1)),
        }
        self.dropped.see(report.counters.telemetry_dropped, true);
    }

    /// Takes a record; those from before the run only mark its beginning.
    pub fn add_record(&mut self, record: &Telemetry) {
        if self.watched.is_some() {
            return self.add_watched(record);
        }
        if self.tick_range.is_past(record.sequence) {
            return;
        }
        match record.state == State::Running {
            true => self.add_running(record),
            false
                if self.unwrapped.is_none()
                    && matches!(record.state, State::Faulted | State::Stopping) =>
            {
                self.tick_range.ended_before(record.sequence);
            }
            false if self.unwrapped.is_none() => {
                self.tick_range.begins_after(record.sequence);
                self.dropped.before = Some(record.dropped);
            }
            false => self.add_end(record),
        }
    }

    /// The last record of the run, or of what came right after it.
    pub fn last_record(&self) -> Option<&Telemetry> {
        self.unwrapped.as_ref().map(|unwrapped| &unwrapped.last)
    }

    /// How many ticks the run takes.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }

    /// How many ticks the run has gone on, braking at its end included.
    pub fn ticks_seen(&self) -> u32 {
        self.tick_range.ticks()
    }

    /// How many of the run's ticks there have been: all of them, or those up to its early end.
    pub fn ticks_done(&self) -> u32 {
        self.tick_range.ticks().min(self.ticks)
    }

    /// Records that did not arrive: with the log's rows, they are the ticks there have been.
    pub fn missed(&self) -> u32 {
        self.ticks_done().saturating_sub(self.log.len() as u32)
    }

    /// The ones of them that the board itself could not send.
    pub fn dropped(&self) -> u32 {
        let before = self.dropped.before.unwrap_or(self.dropped.newest);
        self.dropped.newest.wrapping_sub(before).min(self.missed())
    }

    fn add_watched(&mut self, record: &Telemetry) {
        let Some(watched) = &mut self.watched else { return };
        let since = record.sequence.wrapping_sub(*watched.first.get_or_insert(record.sequence));
        let mut unwrapped = self.unwrapped.take().unwrap_or_else(|| self.begin(record));
        unwrapped.follow(record);
        self.add_row(since, record, &mut unwrapped);
        self.unwrapped = Some(unwrapped);
    }

    fn add_running(&mut self, record: &Telemetry) {
        self.tick_range.runs_at(record.sequence);
        let since = self.tick_range.since(record.sequence);
        self.dropped.see(record.dropped, since >= self.ticks);
        let mut unwrapped = self.unwrapped.take().unwrap_or_else(|| self.begin(record));
        unwrapped.follow(record);
        if since < self.ticks {
            self.add_row(since, record, &mut unwrapped);
        }
        self.unwrapped = Some(unwrapped);
    }

    /// Keeps the first record after a run that ended early: it shows what ended it.
    fn add_end(&mut self, record: &Telemetry) {
        self.tick_range.ended_before(record.sequence);
        self.dropped.see(record.dropped, true);
        let since = self.tick_range.since(record.sequence);
        let is_first = self.board.len() == self.log.len();
        if !is_first || (since >= self.ticks && record.fault.is_none()) {
            return;
        }
        let Some(mut unwrapped) = self.unwrapped.take() else { return };
        unwrapped.follow(record);
        self.board.push(BoardSample {
            position_count: Some(unwrapped.counts),
            command_v: Some(record.codes.map(|code| f64::from(code.to_volts()))),
            ..self.sample(since, record)
        });
        self.unwrapped = Some(unwrapped);
    }

    fn begin(&self, record: &Telemetry) -> Unwrapped {
        let counts = record.counts.map(i64::from);
        let near_rad = counts.map(|count| count as f64 * TAU / self.counts_per_turn);
        let references = [0, 1, 2].map(|i| Unwrapper::near(record.reference[i].0, near_rad[i]));
        Unwrapped { last: *record, counts, references }
    }

    fn add_row(&mut self, since: u32, record: &Telemetry, unwrapped: &mut Unwrapped) {
        let sample = self.sample(since, record);
        self.log.time_s.push(sample.t_s);
        self.board.push(sample);
        for joint in &mut self.log.joints {
            let i = usize::from(joint.joint) - 1;
            if let Position::Count(column) = &mut joint.position {
                column.push(unwrapped.counts[i]);
            }
            joint.command_v.push(f64::from(record.codes[i].to_volts()));
            if let Some(column) = &mut joint.reference_rad {
                column.push(unwrapped.references[i].update(record.reference[i].0));
            }
            self.saturated[i] += u32::from(record.saturated >> i & 1);
        }
        self.longest_tick_tenth_us = self.longest_tick_tenth_us.max(record.tick_time_tenth_us);
    }

    fn sample(&self, since: u32, record: &Telemetry) -> BoardSample {
        board_sample(f64::from(since) * self.period_ns / 1e9, record)
    }
}

/// What a record tells beside the joints, at this time [s].
pub fn board_sample(t_s: f64, record: &Telemetry) -> BoardSample {
    BoardSample {
        t_s,
        state: record.state.name(),
        mode: record.mode.map(Mode::name),
        saturated: [0, 1, 2].map(|i| record.saturated >> i & 1 == 1),
        tick_time_us: f64::from(record.tick_time_tenth_us) / 10.0,
        telemetry_dropped: record.dropped,
        fault: record.fault.map_or("none", |(fault, _)| fault.name()),
        fault_joint: record.fault.map_or(0, |(_, joint)| joint),
        position_count: None,
        command_v: None,
    }
}

impl Unwrapped {
    /// The board's counts wrap at 32 bits; a log's do not.
    fn follow(&mut self, record: &Telemetry) {
        for i in 0..3 {
            self.counts[i] += i64::from(record.counts[i].wrapping_sub(self.last.counts[i]));
        }
        self.last = *record;
    }
}

impl Dropped {
    /// The count as it stood, within the run or after it, where only the first counts.
    fn see(&mut self, count: u32, is_after: bool) {
        if !self.is_after {
            (self.newest, self.is_after) = (count, is_after);
            self.before.get_or_insert(count);
        }
    }
}

#[cfg(test)]
mod tests;
