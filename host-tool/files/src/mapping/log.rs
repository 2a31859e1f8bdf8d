//! A log as it comes together: its own stream, and others put onto its times.

use super::align::at_times;
use super::assemble::Wanted;
use super::clock::Origin;
use super::lag::{Lag, lag};
use super::lane::{Lane, Times};
use super::source::Source;
use super::spec::Clock;
use super::view::View;
use crate::error::{LocatedProblem, Problem};
use crate::foreign::LOG_TIME;
use crate::table::{Table, Values};

/// A log as a table with the columns of a log.
#[derive(Debug)]
pub struct Mapped {
    /// Its columns.
    pub table: Table,
    /// What was done to it that its user should know.
    pub notes: Vec<String>,
}

/// Lags that are looked for between clocks that are the same [s]: a bus, or a drive's filter.
const LARGEST_LAG_S: f64 = 0.5;
/// How far a stream with a clock of its own may begin before the log or end after it [s].
const BEYOND_S: f64 = 5.0;
/// Correlation below which a copy is not believed to be one.
const LEAST_CORRELATION: f64 = 0.7;

/// A log as it comes together.
pub(super) struct Log<'a> {
    own: &'a Source,
    lane: Lane,
    columns: Vec<(Wanted, Vec<f64>)>,
    notes: Vec<String>,
}

impl<'a> Log<'a> {
    /// With the columns of its own stream.
    pub(super) fn of(
        own: &'a Source,
        times: &Times,
        wanted: &[Wanted],
        origin: Origin,
        view: &View,
    ) -> Result<Self, LocatedProblem> {
        let mut lane = own.lane(times, wanted, origin, view)?;
        let notes = std::mem::take(&mut lane.notes);
        let mut log = Self { own, lane, columns: Vec::new(), notes };
        for wanted in wanted {
            let values = own.values(wanted, &log.lane);
            log.take(wanted, values);
        }
        Ok(log)
    }

    fn take(&mut self, wanted: &Wanted, values: Vec<f64>) {
        self.notes.extend(wanted.note());
        if wanted.source.unsigned {
            let name = wanted.quantity.name();
            self.notes.push(format!("{name} lacks its sign and is not used"));
        } else {
            self.columns.push((wanted.clone(), values));
        }
    }

    /// Takes in a stream with times of its own.
    pub(super) fn add(
        &mut self,
        other: &Source,
        times: &Times,
        wanted: &[Wanted],
        origin: Origin,
        view: &View,
    ) -> Result<(), LocatedProblem> {
        let own_clock = other.said.clock == Clock::Own;
        let origin = if own_clock { times.origin(&other.stream.table) } else { origin };
        let mut lane = other.lane(times, wanted, origin, view)?;
        let name = &other.name;
        self.notes.extend(lane.notes.drain(..).map(|note| format!("stream {name}: {note}")));
        lane.time_s.iter_mut().for_each(|time_s| *time_s += other.said.shift_s);
        let before = self.notes.len();
        self.settle_clock(other, &mut lane, wanted)?;
        self.tell_rates(name, &lane, times, self.notes.len() > before);
        for wanted in wanted {
            let values = other.values(wanted, &lane);
            let role = wanted.quantity.role;
            let aligned = at_times(role, &lane.time_s, &values, &self.lane.time_s);
            self.take(wanted, aligned);
        }
        self.keep_common(name, &lane)
    }

    /// Finds the lag of a stream by the copies that the log's own stream has of its signals; applies
    /// it where the clocks are not the same, else says it.
    fn settle_clock(
        &mut self,
        other: &Source,
        lane: &mut Lane,
        wanted: &[Wanted],
    ) -> Result<(), LocatedProblem> {
        let name = &other.name;
        match (self.lag_of(other, lane, wanted)?, other.said.clock) {
            (Some((column, lag)), Clock::Own) => {
                lane.time_s.iter_mut().for_each(|time_s| *time_s += lag.seconds);
                self.notes.push(format!(
                    "stream {name}: its clock is {:.4} s behind that of the log by {column} (correlation \
                     {:.4}), and was set right",
                    lag.seconds, lag.correlation
                ));
            }
            (Some((column, lag)), Clock::Same) => self.tell_lag(other, &column, lag),
            (None, Clock::Own) => {
                return Err(contradiction(format!(
                    "[streams.{name}] has clock = \"own\", but no column of it has a `copy` in the log's \
                     stream that tells when; give one, or shift_s with clock = \"same\""
                )));
            }
            (None, Clock::Same) => {}
        }
        Ok(())
    }

    /// Says a lag that was not taken away.
    fn tell_lag(&mut self, other: &Source, column: &str, lag: Lag) {
        let name = &other.name;
        let (late_ms, doubt_ms) = (1e3 * lag.seconds, 1e3 * lag.doubt_s);
        let shift_s = other.said.shift_s + lag.seconds;
        let cure = match lag.seconds.abs() > lag.doubt_s {
            true => format!("shift_s = {shift_s:.5} in [streams.{name}] would take that away"),
            false => "which is none".to_owned(),
        };
        self.notes.push(format!(
            "stream {name}: {column} is seen {late_ms:.2} +- {doubt_ms:.2} ms after it was sent (correlation \
             {:.4}); nothing was shifted, {cure}",
            lag.correlation
        ));
    }

    /// The lag by the first copy that is believed, and the column's name.
    fn lag_of(
        &self,
        other: &Source,
        lane: &Lane,
        wanted: &[Wanted],
    ) -> Result<Option<(String, Lag)>, LocatedProblem> {
        let (centre_s, range_s) = self.search(other, lane);
        let step_s = self.lane.period_s().max(lane.period_s()).max(1e-4);
        for wanted in wanted {
            let Some(copy) = &wanted.source.copy else { continue };
            let values = self.own.stream.table.get(copy).ok_or_else(|| {
                let name = wanted.quantity.name();
                contradiction(format!(
                    "the copy of {name}, {copy}, is not among the log's own rows"
                ))
            })?;
            let (signal, copy) = (other.values(wanted, lane), self.lane.values(values));
            let (from_s, to_s) = (lane.time_s.as_slice(), self.lane.time_s.as_slice());
            let found = lag((from_s, &signal), (to_s, &copy), centre_s, range_s, step_s);
            if let Some(mut lag) = found.filter(|lag| lag.correlation.abs() >= LEAST_CORRELATION) {
                // What is held stands for what was sent up to a period before.
                lag.doubt_s = lag.doubt_s.max(lane.period_s() / 2.0);
                return Ok(Some((wanted.quantity.name(), lag)));
            }
        }
        Ok(None)
    }

    /// Around which lag is looked for one, and how far [s].
    fn search(&self, other: &Source, lane: &Lane) -> (f64, f64) {
        let [(first_s, last_s), (other_first_s, other_last_s)] =
            [&self.lane, lane].map(|lane| ends(&lane.time_s));
        let middles_s = (first_s + last_s - other_first_s - other_last_s) / 2.0;
        let lengths_s = (last_s - first_s) - (other_last_s - other_first_s);
        match other.said.clock {
            Clock::Own => (middles_s, lengths_s.abs() / 2.0 + BEYOND_S),
            Clock::Same => (0.0, LARGEST_LAG_S),
        }
    }

    /// Says how a stream was put onto the log's times, where these are not its own.
    fn tell_rates(&mut self, name: &str, lane: &Lane, times: &Times, is_lag_told: bool) {
        let is_same = lane.time_s.len() == self.lane.time_s.len()
            && lane.time_s.iter().zip(&self.lane.time_s).all(|(a, b)| (a - b).abs() < 1e-9);
        if is_same {
            return;
        }
        let unknown = match is_lag_told {
            true => "",
            false => "; a lag between their stamps would show as a delay of the drive",
        };
        let [rate, own_rate] = [lane, &self.lane].map(|lane| 1.0 / lane.period_s());
        self.notes.push(format!(
            "stream {name}: {rate:.1} Hz put onto the log's {own_rate:.1} Hz by time stamps{unknown}"
        ));
        if times.source.column == LOG_TIME {
            self.notes.push(format!(
                "stream {name}: its messages have no stamps; the times at which they were recorded stand for \
                 them"
            ));
        }
    }

    /// Leaves out the rows that a stream does not reach.
    fn keep_common(&mut self, name: &str, lane: &Lane) -> Result<(), LocatedProblem> {
        let (first_s, last_s) = ends(&lane.time_s);
        let end_s = last_s + 1.5 * lane.period_s().max(self.lane.period_s());
        let is_kept: Vec<bool> =
            self.lane.time_s.iter().map(|t| (first_s - 1e-9..=end_s).contains(t)).collect();
        let left_out = is_kept.iter().filter(|kept| !**kept).count();
        if left_out == is_kept.len() {
            let (own_first_s, own_last_s) = ends(&self.lane.time_s);
            let what = format!(
                "the log's rows are from {own_first_s:.3} to {own_last_s:.3} s and those of stream {name} from \
                 {first_s:.3} to {last_s:.3} s: no time in common; give shift_s or clock = \"own\" in \
                 [streams.{name}]"
            );
            return Err(contradiction(what));
        }
        if left_out > 0 {
            self.notes.push(format!(
                "{left_out} of the log's rows lie before or after stream {name} and were left out"
            ));
            for (_, values) in &mut self.columns {
                keep(values, &is_kept);
            }
            keep(&mut self.lane.time_s, &is_kept);
            keep(&mut self.lane.rows, &is_kept);
        }
        Ok(())
    }

    /// The log as a table.
    pub(super) fn mapped(self) -> Result<Mapped, LocatedProblem> {
        let mut columns = vec![("t_s".to_owned(), Values::Float(self.lane.time_s))];
        for (wanted, values) in self.columns {
            columns.push(wanted.column(values)?);
        }
        Ok(Mapped { table: Table::of(columns)?, notes: self.notes })
    }
}

fn contradiction(what: String) -> LocatedProblem {
    Problem::Contradiction(what).into()
}

fn keep<T>(values: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    values.retain(|_| kept.next().copied().unwrap_or(false));
}

/// First and last time [s].
fn ends(time_s: &[f64]) -> (f64, f64) {
    (time_s.first().copied().unwrap_or(0.0), time_s.last().copied().unwrap_or(0.0))
}
