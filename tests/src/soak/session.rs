//! The soak itself: board, arm, line and host, session by session.

mod conversation;
mod faults;
mod reply;
mod tick;
mod tracking;

use std::collections::VecDeque;

use firmware::frame::FrameReader;
use firmware::link::{BoardRuntime, BootState, Command, Refusal};
use firmware::store::{Layout, RamFlash, Store};
use firmware::supervisor::{Fault, Health, State, TickRecord};
use firmware::{Mode, ParameterBlock};
use rig::Rig;

use self::reply::OwnedReply;
use super::arm::Arm;
use super::counters::SoakCounters;
use super::draw;
use super::noisy_line::NoisyLine;
use super::settings::Settings;
use random_motions::Rng;

type Flash = RamFlash<Vec<u8>>;

/// What 921,600 baud carry in a tick, each way [bytes].
const BYTES_PER_TICK: usize = 92;
/// A line that is too narrow for a record a tick [bytes].
const NARROW_BYTES_PER_TICK: usize = 40;
/// No answer for so long: ask again [ticks].
const RETRY_TICKS: u32 = 60;
/// The run ends if the host is silent for longer [ticks, ms].
const HOST_TIMEOUT: u16 = 1000;
/// The host's sign of life, every so many ticks.
const HEARTBEAT_TICKS: u64 = 100;
/// Records remembered, to hold what arrives against.
const HISTORY_RECORDS: usize = 1024;
/// Ticks of a run until all motions have swollen.
const SETTLED_TICKS: u64 = 3000;

/// Everything of a soak.
#[derive(Debug)]
pub struct Soak {
    settings: Settings,
    rig: Rig,
    rng: Rng,
    arm: Arm,
    runtime: BoardRuntime<Store<Flash>>,
    to_board: NoisyLine,
    to_host: NoisyLine,
    reader: FrameReader,
    number: u32,
    answer: Option<(u32, Result<OwnedReply, Refusal>)>,
    true_records: VecDeque<TickRecord>,
    last_sequence: Option<u32>,
    committed: Option<Vec<u8>>,
    /// The faults injected into the next tick.
    injected: Health,
    /// The tick in which the board heard the host last.
    heard_at: u32,
    /// What the line takes to the host in a tick.
    bytes_per_tick: usize,
    /// The fault that is due, if one is.
    expected: Option<Fault>,
    counters: SoakCounters,
}

impl Soak {
    /// A board with an empty store at an arm that hangs at rest.
    pub fn new(settings: &Settings) -> Self {
        let bytes = vec![0xFF; Layout::G474.used_bytes() as usize];
        let line = |seed| NoisyLine::new(settings.bytes_per_error, settings.seed + seed);
        Self {
            settings: *settings,
            rig: Rig::new(model::reference_robot::reference_robot()),
            rng: Rng::new(settings.seed),
            arm: Arm::hanging(settings.seed),
            runtime: booted(RamFlash::new(bytes)).0,
            to_board: line(1),
            to_host: line(2),
            reader: FrameReader::new(),
            number: 0,
            answer: None,
            true_records: VecDeque::new(),
            last_sequence: None,
            committed: None,
            injected: Health::default(),
            heard_at: 0,
            bytes_per_tick: BYTES_PER_TICK,
            expected: None,
            counters: SoakCounters::default(),
        }
    }

    /// What was counted so far.
    pub fn counters(&self) -> SoakCounters {
        SoakCounters {
            bytes: self.to_board.carried + self.to_host.carried,
            bytes_broken: self.to_board.broken + self.to_host.broken,
            ..self.counters.clone()
        }
    }

    /// Upload, arm, run until the session's share of the time is over, disarm.
    ///
    /// # Panics
    /// Something did not hold.
    pub fn session(&mut self, index: u32) {
        let share = 1000 * u64::from(self.settings.duration_s) / u64::from(self.settings.sessions);
        let end = (share * u64::from(index + 1)).max(self.counters.ticks + 8_000);
        self.bytes_per_tick = if index % 10 == 3 { NARROW_BYTES_PER_TICK } else { BYTES_PER_TICK };
        self.handshake();
        self.rest();
        let mode = Mode::ALL[index as usize % 5];
        let block = draw::block(&self.rig, &mut self.rng, mode, self.arm.seen_rad());
        self.upload(&block, index.is_multiple_of(2));
        self.request(Command::Stream { on: true }).expect("telemetry can be asked for");
        self.run(&block, index, end);
        self.request(Command::Disarm).expect("a board can be disarmed");
        self.counters.sessions += 1;
        let dropped = self.report().counters.telemetry_dropped;
        assert!(index % 10 != 3 || dropped > 0, "a narrow line cannot take every record");
        for mode in block.mode {
            self.counters.modes[Mode::ALL.iter().position(|m| *m == mode).unwrap_or(0)] += 1;
        }
        if index % 10 == 9 {
            self.reset();
        }
    }

    /// Ticks, disarmed, until the whole time is over.
    pub fn rest_until_the_end(&mut self) {
        while self.counters.ticks < 1000 * u64::from(self.settings.duration_s) {
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

    fn run(&mut self, block: &ParameterBlock, index: u32, end: u64) {
        (0..300).for_each(|_| self.tick());
        self.request(Command::Arm).expect("an arm at rest can be armed");
        let host_timeout_ms = Some(HOST_TIMEOUT);
        self.request(Command::Run { host_timeout_ms }).expect("an armed board can be run");
        self.last_sequence = None;
        let begin = self.counters.ticks;
        let end = end.max(begin + 5_000);
        let injected_at = begin + (end - begin) / 2;
        let quarter = (end - begin - SETTLED_TICKS.min(end - begin)) / 4;
        let (mut first, mut last) = ([0.0; 3], [0.0; 3]);
        let faulty = index % 5 == 4;
        while self.counters.ticks < end {
            self.send_heartbeat_when_due();
            self.tick();
            self.counters.ticks_running += 1;
            let since = self.counters.ticks - begin;
            if since > SETTLED_TICKS && since <= SETTLED_TICKS + quarter {
                self.add_squares(block, &mut first);
            } else if self.counters.ticks + quarter >= end {
                self.add_squares(block, &mut last);
            }
            if faulty && self.counters.ticks == injected_at {
                return self.inject(index / 5);
            }
        }
        self.assert_no_drift(first, last, quarter);
        let report = self.report();
        assert_eq!((report.state, report.fault), (State::Running, None));
    }

    /// Power off and on; the arm stays where it is.
    fn reset(&mut self) {
        self.rest();
        let boot_state = self.power_cycle();
        assert_eq!((boot_state.fault, boot_state.corrupt), (None, false));
        self.counters.resets += 1;
    }

    /// Boots again; what was committed last must be there.
    fn power_cycle(&mut self) -> BootState {
        self.counters.records_dropped += u64::from(self.report().counters.telemetry_dropped);
        let empty = Store::new(RamFlash::new(Vec::new()), 0, Layout::G474);
        let flash = std::mem::replace(self.runtime.handler.store(), empty).into_flash();
        let (runtime, boot_state) = booted(flash);
        self.runtime = runtime;
        self.last_sequence = None;
        self.true_records.clear();
        assert_eq!(Some(boot_state.encoded.to_vec()), self.committed, "the block committed last");
        boot_state
    }
}

/// A board that has just found this in its flash.
fn booted(flash: Flash) -> (BoardRuntime<Store<Flash>>, BootState) {
    let store = Store::new(flash, Layout::G474.bank_start, Layout::G474);
    BoardRuntime::boot(store, "soak", [0; 16], false)
}
