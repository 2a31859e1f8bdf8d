//! Telemetry of a run, as a log.

use std::f64::consts::TAU;

use firmware::link::Telemetry;
use firmware::supervisor::State;
use firmware::{Mode, ParameterBlock};

use crate::files::{BoardSample, JointLog, Log, Position};
use crate::simulation::sensor::Unwrapper;

/// Turns the records of a run into a log, in the order in which they come.
#[derive(Debug)]
pub struct Recorder {
    /// The log so far; a record that is missing is a gap in its times.
    pub log: Log,
    /// What the board told beside the joints, row by row of the log.
    pub board: Vec<BoardSample>,
    /// Records that did not arrive, by their numbers.
    pub missed: u32,
    /// The ones of them that the board itself could not send.
    pub dropped: u32,
    /// Longest tick [0.1 us].
    pub longest_tick_tenth_us: u16,
    /// Ticks in which the command of a joint was cut at its limit.
    pub saturated: [u32; 3],
    counts_per_turn: f64,
    period_ns: f64,
    ticks: u32,
    begun: Option<Begun>,
}

/// What a run's first record tells, and the newest one.
#[derive(Debug)]
struct Begun {
    first: Telemetry,
    last: Telemetry,
    counts: [i64; 3],
    references: [Unwrapper; 3],
}

impl Recorder {
    /// For a run of so many ticks with this block.
    pub fn new(block: &ParameterBlock, ticks: u32) -> Self {
        let joint = |joint| JointLog {
            joint,
            position: Position::Count(Vec::new()),
            command_v: Vec::new(),
            reference_rad: Some(Vec::new()),
        };
        Self {
            log: Log { time_s: Vec::new(), joints: (1..=3).map(joint).collect() },
            board: Vec::new(),
            missed: 0,
            dropped: 0,
            longest_tick_tenth_us: 0,
            saturated: [0; 3],
            counts_per_turn: f64::from(block.encoder_counts_per_turn),
            // The block has it as an f32; in whole nanoseconds it is what was meant.
            period_ns: (f64::from(block.sample_period_s) * 1e9).round(),
            ticks,
            begun: None,
        }
    }

    /// Takes a record; those outside the run are nothing to it.
    pub fn push(&mut self, record: &Telemetry) {
        if record.state != State::Running {
            return;
        }
        let mut begun = self.begun.take().unwrap_or_else(|| self.begin(record));
        let since = record.sequence.wrapping_sub(begun.first.sequence);
        if since < self.ticks {
            let step = record.sequence.wrapping_sub(begun.last.sequence);
            self.missed += step.saturating_sub(1);
            self.dropped = record.dropped.wrapping_sub(begun.first.dropped);
            begun.follow(record);
            self.add_row(since, record, &mut begun);
        }
        begun.last = *record;
        self.begun = Some(begun);
    }

    /// How many ticks the run takes.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }

    /// How many ticks the run has gone on.
    pub fn ticks_seen(&self) -> u32 {
        match &self.begun {
            Some(begun) => begun.last.sequence.wrapping_sub(begun.first.sequence) + 1,
            None => 0,
        }
    }

    fn begin(&self, record: &Telemetry) -> Begun {
        let counts = record.counts.map(i64::from);
        let near_rad = counts.map(|count| count as f64 * TAU / self.counts_per_turn);
        let references = [0, 1, 2].map(|i| Unwrapper::near(record.reference[i], near_rad[i]));
        Begun { first: *record, last: *record, counts, references }
    }

    fn add_row(&mut self, since: u32, record: &Telemetry, begun: &mut Begun) {
        let t_s = f64::from(since) * self.period_ns / 1e9;
        self.log.time_s.push(t_s);
        self.board.push(BoardSample {
            t_s,
            state: record.state.name(),
            mode: record.mode.map(Mode::name),
            saturated: [0, 1, 2].map(|i| record.saturated >> i & 1 == 1),
            tick_time_us: f64::from(record.tick_time_tenth_us) / 10.0,
            telemetry_dropped: record.dropped,
        });
        for (i, joint) in self.log.joints.iter_mut().enumerate() {
            if let Position::Count(column) = &mut joint.position {
                column.push(begun.counts[i]);
            }
            joint.command_v.push(f64::from(record.codes[i].to_volts()));
            if let Some(column) = &mut joint.reference_rad {
                column.push(begun.references[i].update(record.reference[i]));
            }
            self.saturated[i] += u32::from(record.saturated >> i & 1);
        }
        self.longest_tick_tenth_us = self.longest_tick_tenth_us.max(record.tick_time_tenth_us);
    }
}

impl Begun {
    /// The board's counts wrap at 32 bits; a log's do not.
    fn follow(&mut self, record: &Telemetry) {
        for i in 0..3 {
            self.counts[i] += i64::from(record.counts[i].wrapping_sub(self.last.counts[i]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use firmware::{Angle, DacCode};

    use crate::simulation::{Rig, plan};

    fn record(sequence: u32, state: State) -> Telemetry {
        Telemetry {
            sequence,
            counts: [i32::MAX.wrapping_add(sequence as i32), 0, -5],
            codes: [DacCode(0), DacCode(16384), DacCode(0)],
            reference: [Angle(0); 3],
            mode: [Mode::Pd; 3],
            state,
            saturated: 0b100,
            fault: None,
            tick_time_tenth_us: 400,
            dropped: 7 + sequence / 10,
        }
    }

    fn block() -> ParameterBlock {
        plan::hold(0.02).block(&Rig::new(model::reference_robot::reference_robot()))
    }

    #[test]
    fn what_is_missing_is_a_gap_and_counted() {
        let mut recorder = Recorder::new(&block(), 20);
        recorder.push(&record(0, State::Armed));
        for sequence in (1..30).filter(|s| !(5..8).contains(s)) {
            recorder.push(&record(sequence, State::Running));
        }
        assert_eq!(recorder.ticks_seen(), 29);
        assert_eq!(recorder.log.len(), 17);
        assert_eq!((recorder.missed, recorder.dropped), (3, 2));
        assert_eq!(recorder.saturated, [0, 0, 17]);
        assert_eq!(recorder.log.time_s[4..6], [0.007, 0.008]);
        assert_eq!(recorder.log.time_s.last(), Some(&0.019));
        assert_eq!(recorder.log.joints[1].command_v[0], 5.0);
    }

    #[test]
    fn counts_do_not_wrap() {
        let mut recorder = Recorder::new(&block(), 5);
        (0..5).for_each(|sequence| recorder.push(&record(sequence, State::Running)));
        let Position::Count(counts) = &recorder.log.joints[0].position else { panic!() };
        let first = i64::from(i32::MAX);
        assert_eq!(*counts, [first, first + 1, first + 2, first + 3, first + 4]);
    }
}
