//! The firmware's library on this machine, beside the image: the same counts, the same codes.

use firmware::encoder::CounterExtender;
use firmware::link::{BoardRuntime, Telemetry};
use firmware::store::{Layout, RamFlash, Store};
use firmware::supervisor::{Health, Order, State, TickRecord};
use firmware::{Angle, DacCode};

use crate::memory_map::BANK_BYTES;
use crate::trace::Tick;

/// Where the two differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The tick.
    pub tick: Tick,
    /// What the library makes of its counts.
    pub codes: [DacCode; 3],
    /// The state in which the library ends it.
    pub state: State,
}

/// What a comparison came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Ticks compared.
    pub ticks: usize,
    /// Of those, in the state Running.
    pub running: usize,
    /// Where they differ first.
    pub first: Option<Difference>,
}

/// The library's board after a boot with the same flash.
pub struct Replica {
    runtime: BoardRuntime<Store<RamFlash<Vec<u8>>>>,
    extenders: [CounterExtender; 3],
    home: [Angle; 3],
}

impl Replica {
    /// Boots with what bank 2 holds; `home` is what the host tells, where it does.
    pub fn new(flash: &[u8], home: [Angle; 3]) -> Self {
        let flash = RamFlash::new(flash[BANK_BYTES..].to_vec());
        let store = Store::new(flash, Layout::G474.bank_start, Layout::G474);
        let (runtime, _) = BoardRuntime::boot(store, "replica", [0; 16], true);
        Self { runtime, extenders: Default::default(), home }
    }

    /// Plays all ticks since the boot, with the orders that telemetry shows to have been obeyed.
    pub fn compare(mut self, ticks: &[Tick], telemetry: &[Telemetry]) -> Comparison {
        let mut seen = telemetry.iter().peekable();
        let mut comparison = Comparison::default();
        for tick in ticks {
            let counts = self.extended(tick.counts);
            let record = match seen.next_if(|record| u64::from(record.sequence) == tick.number) {
                Some(told) => self.as_told(counts, told),
                None => self.tick(counts),
            };
            let running = record.state.drives();
            comparison.ticks += 1;
            comparison.running += usize::from(running);
            let codes = if running { record.codes.map(|code| code.0) } else { [0; 3] };
            if codes != tick.codes || running != tick.released {
                let (codes, state) = (record.codes, record.state);
                comparison.first = Some(Difference { tick: *tick, codes, state });
                return comparison;
            }
        }
        comparison
    }

    fn extended(&mut self, counts: [u32; 3]) -> [i32; 3] {
        let mut extended = [0; 3];
        for (i, extender) in self.extenders.iter_mut().enumerate() {
            extended[i] = extender.update(counts[i] as u16);
        }
        extended
    }

    /// A tick, after the order without which it would have gone otherwise.
    fn as_told(&mut self, counts: [i32; 3], told: &Telemetry) -> TickRecord {
        let orders = [
            Order::Home { position: self.home },
            Order::Arm,
            Order::Run { host_timeout_ticks: None },
            Order::Stop,
            Order::Disarm,
        ];
        let before = self.runtime.supervisor.clone();
        let record = self.tick(counts);
        let fits = |record: &TickRecord| (record.state, record.counts) == (told.state, told.counts);
        if fits(&record) {
            return record;
        }
        for order in orders {
            self.runtime.supervisor = before.clone();
            let obeyed = self.runtime.supervisor.execute(order).is_ok();
            let record = self.tick(counts);
            if obeyed && fits(&record) {
                return record;
            }
        }
        record
    }

    fn tick(&mut self, counts: [i32; 3]) -> TickRecord {
        let health = Health { host_heard: true, ..Health::default() };
        self.runtime.supervisor.tick(&counts, health)
    }
}
