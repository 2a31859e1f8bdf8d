//! A millisecond: board, arm, and what the line carries.

use firmware::link::{Refusal, Telemetry, ToHost};
use firmware::supervisor::{Health, TickRecord};

use super::reply::OwnedReply;
use super::{BYTES_PER_TICK, HISTORY_RECORDS, Soak};

/// What is wrong on purpose, and what the board has found itself.
fn with_injected(injected: Health, found: Health) -> Health {
    Health {
        host_heard: found.host_heard,
        parameters_corrupt: found.parameters_corrupt,
        tick_time_tenth_us: found.tick_time_tenth_us,
        ..injected
    }
}

impl Soak {
    /// One millisecond of everything.
    pub(super) fn tick(&mut self) {
        let counts = self.arm.counts();
        let heard = self.runtime.health();
        let health = with_injected(std::mem::take(&mut self.injected), heard);
        let record = self.runtime.supervisor.tick(&counts, health);
        if health.host_heard {
            self.heard_at = record.tick;
        }
        self.runtime.after_tick(&record);
        self.assert_safe(&record);
        self.arm.advance(record.codes.map(|code| f64::from(code.to_volts())));
        self.counters.ticks += 1;
        if self.true_records.len() == HISTORY_RECORDS {
            self.true_records.pop_front();
        }
        self.true_records.push_back(record);
        self.carry();
    }

    fn assert_safe(&mut self, record: &TickRecord) {
        let zero = record.codes.iter().all(|code| code.0 == 0);
        assert!(zero || record.state.drives(), "voltage while {}", record.state);
        let Some(found) = self.runtime.supervisor.fault() else { return };
        if self.expected.is_some() && self.expected != Some(found.fault) {
            self.counters.faults_otherwise += 1;
            panic!("instead of {:?}: {found}", self.expected);
        }
        if self.expected.is_none() && record.tick == found.tick {
            self.counters.faults_otherwise += 1;
            panic!("nobody injected it: {found}; {record:?}");
        }
    }

    /// A millisecond of the line.
    fn carry(&mut self) {
        for _ in 0..BYTES_PER_TICK {
            let Some(byte) = self.to_board.pop() else { break };
            self.runtime.receive(byte);
        }
        for _ in 0..self.bytes_per_tick {
            let Some(byte) = self.runtime.send() else { break };
            self.to_host.push(byte);
        }
        while let Some(byte) = self.to_host.pop() {
            let Some(message) = self.reader.push(byte).and_then(received) else { continue };
            match message {
                Received::Answer(number, result) => {
                    self.counters.answered += 1;
                    self.answer = Some((number, result));
                }
                Received::Record(record) => self.check_record(&record),
            }
        }
    }

    /// A record that arrived is one that was sent, and those between were missed.
    fn check_record(&mut self, record: &Telemetry) {
        let sent = self.true_records.iter().rev().find(|sent| sent.tick == record.sequence);
        let sent = sent.expect("nothing comes that was not sent a moment ago");
        assert_eq!(*record, Telemetry::new(sent, record.dropped), "what came is what was sent");
        self.counters.records += 1;
        if let Some(last) = self.last_sequence {
            let missed = record.sequence.wrapping_sub(last).wrapping_sub(1);
            self.counters.records_missed += u64::from(missed);
        }
        self.last_sequence = Some(record.sequence);
    }
}

/// What came over the line.
enum Received {
    Answer(u32, Result<OwnedReply, Refusal>),
    Record(Telemetry),
}

/// The message in a frame; `None` if it is broken.
fn received(content: &[u8]) -> Option<Received> {
    Some(match ToHost::read(content).ok()? {
        ToHost::Answer(answer) => {
            Received::Answer(answer.number, answer.result.map(OwnedReply::of))
        }
        ToHost::Hello(_) => Received::Answer(0, Ok(OwnedReply::Done)),
        ToHost::Telemetry(record) => Received::Record(record),
    })
}
