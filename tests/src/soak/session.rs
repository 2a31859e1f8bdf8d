//! The soak itself: board, arm, line and host, tick by tick, session by session.

use std::collections::VecDeque;

use firmware::frame::FrameReader;
use firmware::link::checked::CHECKSUM;
use firmware::link::{
    Beginning, Command, Handler, Kept, PIECE_BYTES, Refusal, Reply, Report, Request, Source,
    Station, Telemetry, ToBoard, ToHost,
};
use firmware::store::{Layout, RamFlash, Store};
use firmware::supervisor::{BootReport, Fault, HardLimits, Health, State, Supervisor};
use firmware::{Controller, Mode, ParameterBlock};
use host_tool::simulation::Rig;

use super::Settings;
use super::arm::Arm;
use super::dice::Dice;
use super::draw;
use super::noisy_line::NoisyLine;
use super::tally::Tally;
use crate::operator::frame;

type Flash = RamFlash<Vec<u8>>;

/// What 921,600 baud carry in a tick, each way [bytes].
const BYTES_PER_TICK: usize = 92;
/// No answer for so long: ask again [ticks].
const PATIENCE_TICKS: u32 = 60;
/// The run ends if the host is silent for longer [ticks, ms].
const HOST_TIMEOUT: u16 = 1000;
/// The host's sign of life, every so many ticks.
const ALIVE_TICKS: u64 = 100;
/// Records remembered, to hold what arrives against.
const REMEMBERED: usize = 1024;
/// Ticks of a run until all motions have swollen.
const SETTLED_TICKS: u64 = 3000;

/// An answer without what it borrows.
#[derive(Clone, Debug)]
enum Told {
    Done,
    Report(Report),
    Piece(Vec<u8>),
}

/// Everything of a soak.
#[derive(Debug)]
pub struct Soak {
    settings: Settings,
    rig: Rig,
    dice: Dice,
    arm: Arm,
    station: Station<Store<Flash>>,
    to_board: NoisyLine,
    to_host: NoisyLine,
    reader: FrameReader,
    number: u32,
    answer: Option<(u32, Result<Told, Refusal>)>,
    true_records: VecDeque<Telemetry>,
    last_sequence: Option<u32>,
    committed: Option<Vec<u8>>,
    /// What the board is told to be wrong with it in the next tick.
    injected: Health,
    /// The fault that is due, if one is.
    expected: Option<Fault>,
    tally: Tally,
}

impl Soak {
    /// A board with an empty store at an arm that hangs at rest.
    pub fn new(settings: &Settings) -> Self {
        let bytes = vec![0xFF; Layout::G474.used_bytes() as usize];
        let line = |seed| NoisyLine::new(settings.bytes_per_error, settings.seed + seed);
        Self {
            settings: *settings,
            rig: Rig::new(model::reference_robot::reference_robot()),
            dice: Dice::new(settings.seed),
            arm: Arm::hanging(settings.seed),
            station: booted(RamFlash::new(bytes)).0,
            to_board: line(1),
            to_host: line(2),
            reader: FrameReader::new(),
            number: 0,
            answer: None,
            true_records: VecDeque::new(),
            last_sequence: None,
            committed: None,
            injected: Health::default(),
            expected: None,
            tally: Tally::default(),
        }
    }

    /// What was counted so far.
    pub fn tally(&self) -> Tally {
        Tally {
            bytes: self.to_board.carried + self.to_host.carried,
            bytes_broken: self.to_board.broken + self.to_host.broken,
            ..self.tally.clone()
        }
    }

    /// Upload, arm, run until the session's share of the time is over, disarm.
    ///
    /// # Panics
    /// Something did not hold.
    pub fn session(&mut self, index: u32) {
        let share = 1000 * u64::from(self.settings.duration_s) / u64::from(self.settings.sessions);
        let end = (share * u64::from(index + 1)).max(self.tally.ticks + 8_000);
        self.greet();
        self.rest();
        let mode = Mode::ALL[index as usize % 5];
        let block = draw::block(&self.rig, &mut self.dice, mode, self.arm.seen_rad());
        self.upload(&block, index.is_multiple_of(2));
        self.ask(Command::Stream { on: true }).expect("telemetry can be asked for");
        self.run(&block, index, end);
        self.ask(Command::Disarm).expect("a board can be disarmed");
        self.tally.sessions += 1;
        for mode in block.mode {
            self.tally.modes[Mode::ALL.iter().position(|m| *m == mode).unwrap_or(0)] += 1;
        }
        if index % 10 == 9 {
            self.reset();
        }
    }

    /// Ticks, disarmed, until the whole time is over.
    pub fn rest_until_the_end(&mut self) {
        while self.tally.ticks < 1000 * u64::from(self.settings.duration_s) {
            self.tick();
        }
    }

    /// Waits until nothing moves any more.
    fn rest(&mut self) {
        let mut last = self.arm.counts();
        for _ in 0..600 {
            (0..100).for_each(|_| self.tick());
            let now = self.arm.counts();
            if std::mem::replace(&mut last, now).iter().zip(now).all(|(a, b)| a.abs_diff(b) < 20) {
                return;
            }
        }
        panic!("the arm does not come to rest");
    }

    fn upload(&mut self, block: &ParameterBlock, commit: bool) {
        let mut buffer = [0; firmware::block::MAX_BYTES];
        let bytes = block.encode(&mut buffer).expect("the block fits").to_vec();
        let checksum = CHECKSUM.checksum(&bytes);
        let begin = Command::UploadBegin { length: bytes.len() as u16, checksum };
        let begun = self.ask(begin);
        assert!(begun.is_ok(), "{begun:?}: {:?}", self.station.supervisor.fault());
        for (index, piece) in bytes.chunks(PIECE_BYTES).enumerate() {
            let offset = (index * PIECE_BYTES) as u16;
            self.ask(Command::UploadPiece { offset, bytes: piece }).expect("a piece is taken");
        }
        self.ask(if commit { Command::Commit } else { Command::Use }).expect("a block is taken");
        self.tally.uploads += 1;
        assert_eq!(self.download(Source::InUse), bytes, "what was acknowledged is in use");
        if commit {
            self.tally.commits += 1;
            self.committed = Some(bytes);
        }
        if let Some(committed) = self.committed.clone() {
            assert_eq!(self.download(Source::Stored), committed, "and what was committed stays");
        }
    }

    fn download(&mut self, source: Source) -> Vec<u8> {
        let mut bytes = Vec::new();
        loop {
            let offset = bytes.len() as u16;
            match self.ask(Command::Download { source, offset }) {
                Ok(Told::Piece(piece)) if piece.is_empty() => return bytes,
                Ok(Told::Piece(piece)) => bytes.extend(piece),
                other => panic!("a download brought {other:?}"),
            }
        }
    }

    fn run(&mut self, block: &ParameterBlock, index: u32, end: u64) {
        (0..300).for_each(|_| self.tick());
        self.ask(Command::Arm).expect("an arm at rest can be armed");
        let host_timeout_ms = Some(HOST_TIMEOUT);
        self.ask(Command::Run { host_timeout_ms }).expect("an armed board can be run");
        self.last_sequence = None;
        let begin = self.tally.ticks;
        let end = end.max(begin + 5_000);
        let injected_at = begin + (end - begin) / 2;
        let quarter = (end - begin - SETTLED_TICKS.min(end - begin)) / 4;
        let (mut first, mut last) = ([0.0; 3], [0.0; 3]);
        let faulty = index % 5 == 4;
        while self.tally.ticks < end {
            if self.tally.ticks.is_multiple_of(ALIVE_TICKS) {
                self.say(Command::Query);
            }
            self.tick();
            self.tally.ticks_running += 1;
            let since = self.tally.ticks - begin;
            if since > SETTLED_TICKS && since <= SETTLED_TICKS + quarter {
                self.add_squares(block, &mut first);
            } else if self.tally.ticks + quarter >= end {
                self.add_squares(block, &mut last);
            }
            if faulty && self.tally.ticks == injected_at {
                return self.inject(index / 5);
            }
        }
        self.judge_drift(first, last, quarter);
        let report = self.report();
        assert_eq!((report.state, report.fault), (State::Running, None));
    }

    /// Adds the squares of tracking errors in the mode that knows the model.
    fn add_squares(&mut self, block: &ParameterBlock, sums: &mut [f64; 3]) {
        let Some(record) = self.true_records.back() else { return };
        let seen = self.arm_at(record);
        for joint in (0..3).filter(|joint| block.mode[*joint] == Mode::PdModel) {
            let error_rad = f64::from(record.reference[joint].minus(seen[joint]));
            sums[joint] += error_rad * error_rad;
            self.tally.worst_error_rad = self.tally.worst_error_rad.max(error_rad.abs());
        }
    }

    fn arm_at(&self, record: &Telemetry) -> [firmware::Angle; 3] {
        record.counts.map(|count| {
            let within = count.rem_euclid(super::arm::COUNTS_PER_TURN as i32) as f64;
            let units = within / f64::from(super::arm::COUNTS_PER_TURN) * 2f64.powi(32);
            firmware::Angle(units as u32 as i32)
        })
    }

    fn judge_drift(&mut self, first: [f64; 3], last: [f64; 3], ticks: u64) {
        for joint in 0..3 {
            let [before, after] = [first, last].map(|sums| (sums[joint] / ticks as f64).sqrt());
            let drift = (after - before).abs();
            self.tally.worst_drift_rad = self.tally.worst_drift_rad.max(drift);
            assert!(after <= 1.3 * before + 5e-4, "joint {}: {before} to {after} rad", joint + 1);
        }
    }

    /// Makes something go wrong, sees it found in its tick, and clears it.
    fn inject(&mut self, which: u32) {
        let fault = [Fault::EncoderJump, Fault::TickOverrun, Fault::LinkLost, Fault::Converter]
            [which as usize % 4];
        self.expected = Some(fault);
        match fault {
            Fault::EncoderJump => self.arm.jump(which as usize % 3, 5000),
            Fault::TickOverrun => self.injected.overrun = true,
            Fault::Converter => self.injected.converter_fault = true,
            // Nothing is said from now on; the last sign of life is at most 100 ticks old.
            _ => (0..u64::from(HOST_TIMEOUT) - 2 * ALIVE_TICKS).for_each(|_| self.tick()),
        }
        let due_ticks = if fault == Fault::LinkLost { 3 * ALIVE_TICKS } else { 1 };
        (0..due_ticks).for_each(|_| self.tick());
        assert_eq!(self.station.supervisor.fault().map(|record| record.fault), Some(fault));
        self.tally.faults_injected += 1;
        self.expected = None;
        self.arm.forget_jumps();
        let report = self.report();
        assert_eq!(report.fault.map(|record| record.fault), Some(fault), "the host is told");
        self.rest_faulted();
        self.ask(Command::ClearFault).expect("a fault that is gone can be cleared");
    }

    fn rest_faulted(&mut self) {
        (0..200).for_each(|_| self.tick());
    }

    /// Power off and on; the arm stays where it is.
    fn reset(&mut self) {
        self.rest();
        self.tally.records_dropped += u64::from(self.report().counters.telemetry_dropped);
        let empty = Store::new(RamFlash::new(Vec::new()), 0, Layout::G474);
        let flash = std::mem::replace(self.station.handler.store(), empty).into_flash();
        let (station, kept) = booted(flash);
        self.station = station;
        self.last_sequence = None;
        self.true_records.clear();
        assert_eq!(Some(kept.encoded.to_vec()), self.committed, "the block committed last");
        assert_eq!((kept.fault, kept.corrupt), (None, false));
        self.tally.resets += 1;
    }

    /// One millisecond of everything.
    fn tick(&mut self) {
        let counts = self.arm.counts();
        let heard = self.station.health();
        let Health { overrun, converter_fault, .. } = std::mem::take(&mut self.injected);
        let health = Health { overrun, converter_fault, ..heard };
        let record = self.station.supervisor.tick(&counts, health);
        self.station.after_tick(&record);
        self.assert_as_it_should_be(&record);
        self.arm.advance(record.codes.map(|code| f64::from(code.to_volts())));
        self.tally.ticks += 1;
        if self.true_records.len() == REMEMBERED {
            self.true_records.pop_front();
        }
        self.true_records.push_back(record);
        self.carry();
    }

    fn assert_as_it_should_be(&mut self, record: &Telemetry) {
        let zero = record.codes.iter().all(|code| code.0 == 0);
        assert!(zero || record.state == State::Running, "voltage while {}", record.state);
        let Some(found) = self.station.supervisor.fault() else { return };
        if self.expected.is_some() && self.expected != Some(found.fault) {
            self.tally.faults_otherwise += 1;
            panic!("instead of {:?}: {found}", self.expected);
        }
        if self.expected.is_none() && record.sequence == found.tick {
            self.tally.faults_otherwise += 1;
            panic!("nobody injected it: {found}; {record:?}");
        }
    }

    /// A millisecond of the line.
    fn carry(&mut self) {
        for _ in 0..BYTES_PER_TICK {
            let Some(byte) = self.to_board.pop() else { break };
            self.station.receive(byte);
        }
        for _ in 0..BYTES_PER_TICK {
            let Some(byte) = self.station.send() else { break };
            self.to_host.push(byte);
        }
        while let Some(byte) = self.to_host.pop() {
            let told = match self.reader.push(byte).map(ToHost::read) {
                Some(Ok(ToHost::Answer(answer))) => {
                    let result = answer.result.map(|reply| match reply {
                        Reply::Report(report) => Told::Report(report),
                        Reply::Piece { bytes, .. } => Told::Piece(bytes.to_vec()),
                        Reply::Done | Reply::InUse(_) | Reply::Challenge { .. } => Told::Done,
                    });
                    Some((answer.number, result))
                }
                Some(Ok(ToHost::Hello(_))) => Some((0, Ok(Told::Done))),
                Some(Ok(ToHost::Telemetry(record))) => {
                    self.note(&record);
                    None
                }
                Some(Err(_)) | None => None,
            };
            if told.is_some() {
                self.tally.answered += 1;
                self.answer = told;
            }
        }
    }

    /// A record that arrived is one that was sent, and those between were missed.
    fn note(&mut self, record: &Telemetry) {
        let sent = self.true_records.iter().rev().find(|sent| sent.sequence == record.sequence);
        if let Some(sent) = sent {
            assert_eq!(Telemetry { dropped: 0, ..*record }, *sent, "what came is what was sent");
        }
        self.tally.records += 1;
        if let Some(last) = self.last_sequence {
            let missed = record.sequence.wrapping_sub(last).wrapping_sub(1);
            self.tally.records_missed += u64::from(missed);
        }
        self.last_sequence = Some(record.sequence);
    }

    fn greet(&mut self) {
        self.number = 0;
        self.deliver(0, &frame(&ToBoard::Hello { protocol_version: 1 })).expect("a Hello");
    }

    fn report(&mut self) -> Report {
        match self.ask(Command::Query) {
            Ok(Told::Report(report)) => report,
            other => panic!("a query brought {other:?}"),
        }
    }

    /// Asks without waiting for the answer.
    fn say(&mut self, command: Command<'_>) {
        self.number += 1;
        let request = Request { number: self.number, proof: None, command };
        self.put(&frame(&ToBoard::Request(request)));
    }

    /// Asks until there is an answer.
    fn ask(&mut self, command: Command<'_>) -> Result<Told, Refusal> {
        self.number += 1;
        let request = Request { number: self.number, proof: None, command };
        self.deliver(self.number, &frame(&ToBoard::Request(request)))
    }

    fn deliver(&mut self, number: u32, frame: &[u8]) -> Result<Told, Refusal> {
        for attempt in 0..20 {
            self.tally.asked_again += u64::from(attempt > 0);
            self.put(frame);
            for _ in 0..PATIENCE_TICKS {
                self.tick();
                match self.answer.take() {
                    Some((answered, result)) if answered == number => return result,
                    _ => {}
                }
            }
        }
        panic!("no answer to request {number}");
    }

    /// A zero first ends whatever noise has begun.
    fn put(&mut self, frame: &[u8]) {
        self.to_board.push(0);
        frame.iter().for_each(|&byte| self.to_board.push(byte));
    }
}

/// A board that has just found this in its flash.
fn booted(flash: Flash) -> (Station<Store<Flash>>, Kept) {
    let mut store = Store::new(flash, Layout::G474.bank_start, Layout::G474);
    let kept = Kept::of(&mut store);
    let beginning = Beginning {
        board: "soak",
        limits: HardLimits::default(),
        nonce_seed: [0; 16],
        key: kept.key,
        fault: kept.fault,
        in_use: Some((&kept.encoded, kept.origin)),
    };
    let handler = Handler::new(store, &beginning);
    let mut supervisor = Supervisor::default();
    supervisor.replace(Controller::new(kept.block.clone())).expect("a board that boots takes it");
    supervisor.booted(BootReport {
        latched: kept.fault,
        parameters_corrupt: kept.corrupt,
        ..BootReport::default()
    });
    (Station::new(supervisor, handler), kept)
}
