//! A millisecond: board, arm, and what the line carries.

use firmware::link::{Refusal, Telemetry, ToHost};
use firmware::supervisor::{Health, State, TickRecord};

use super::{BYTES_PER_TICK, REMEMBERED, Soak, Told};

impl Soak {
    /// One millisecond of everything.
    pub(super) fn tick(&mut self) {
        let counts = self.arm.counts();
        let heard = self.runtime.health();
        let Health { overrun, converter_fault, .. } = std::mem::take(&mut self.injected);
        let health = Health { overrun, converter_fault, ..heard };
        let record = self.runtime.supervisor.tick(&counts, health);
        if health.host_heard {
            self.heard_at = record.tick;
        }
        self.runtime.after_tick(&record);
        self.assert_as_it_should_be(&record);
        self.arm.advance(record.codes.map(|code| f64::from(code.to_volts())));
        self.tally.ticks += 1;
        if self.true_records.len() == REMEMBERED {
            self.true_records.pop_front();
        }
        self.true_records.push_back(record);
        self.carry();
    }

    fn assert_as_it_should_be(&mut self, record: &TickRecord) {
        let zero = record.codes.iter().all(|code| code.0 == 0);
        assert!(zero || record.state == State::Running, "voltage while {}", record.state);
        let Some(found) = self.runtime.supervisor.fault() else { return };
        if self.expected.is_some() && self.expected != Some(found.fault) {
            self.tally.faults_otherwise += 1;
            panic!("instead of {:?}: {found}", self.expected);
        }
        if self.expected.is_none() && record.tick == found.tick {
            self.tally.faults_otherwise += 1;
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
            let Some(told) = self.reader.push(byte).and_then(told) else { continue };
            match told {
                Came::Answer(number, result) => {
                    self.tally.answered += 1;
                    self.answer = Some((number, result));
                }
                Came::Record(record) => self.note(&record),
            }
        }
    }

    /// A record that arrived is one that was sent, and those between were missed.
    fn note(&mut self, record: &Telemetry) {
        let sent = self.true_records.iter().rev().find(|sent| sent.tick == record.sequence);
        let sent = sent.expect("nothing comes that was not sent a moment ago");
        assert_eq!(*record, Telemetry::new(sent, record.dropped), "what came is what was sent");
        self.tally.records += 1;
        if let Some(last) = self.last_sequence {
            let missed = record.sequence.wrapping_sub(last).wrapping_sub(1);
            self.tally.records_missed += u64::from(missed);
        }
        self.last_sequence = Some(record.sequence);
    }
}

/// What came over the line.
enum Came {
    Answer(u32, Result<Told, Refusal>),
    Record(Telemetry),
}

/// What a frame says; `None` if it is broken.
fn told(content: &[u8]) -> Option<Came> {
    Some(match ToHost::read(content).ok()? {
        ToHost::Answer(answer) => Came::Answer(answer.number, answer.result.map(Told::of)),
        ToHost::Hello(_) => Came::Answer(0, Ok(Told::Done)),
        ToHost::Telemetry(record) => Came::Record(record),
    })
}
