//! What ends a session, that it is found and how, and what makes the board ready again.

use emulator::registers::MS;
use emulator::registers::rcc::Reset;
use firmware::link::{Command, Refusal, Source};
use firmware::supervisor::State;

use super::ending::Ending;
use super::session::{HOST_TIMEOUT_MS, Soak};

/// Pins of port C: the emergency stop's contact, the amplifiers' power.
const NOT_PRESSED: usize = 5;
const POWER_GOOD: usize = 8;
/// A controlled stop takes 2 s.
const STOP_MS: u64 = 2_000;
/// Longest wait for what takes its time: a stall, the end of a range.
const FOUND_WITHIN_MS: u64 = 10_000;
/// The rig's limit of a host's silence [ms].
const CEILING_MS: u64 = 10_000;
/// Bytes of noise a millisecond, as many as the line carries, and for how long.
const NOISE_BYTES: usize = 90;
const NOISE_MS: u64 = 2_000;
/// The watchdog's clock in place of 32 kHz, as if the crystal were 12 % slow.
const CLOCK_HZ: u64 = 32_000;
const WRONG_CLOCK_HZ: u64 = 36_000;

impl Soak {
    /// Makes it happen.
    pub fn end(&mut self, ending: Ending) {
        let since = self.operator.machine.board().now;
        match ending {
            Ending::Stop | Ending::PowerCycle => self.stop(),
            Ending::Noise => self.make_noise(),
            Ending::Alone => self.pass(CEILING_MS + STOP_MS + 100),
            Ending::Silence => self.pass(u64::from(HOST_TIMEOUT_MS) + STOP_MS + 100),
            Ending::EmergencyStop => self.pull(NOT_PRESSED),
            Ending::DrivePower | Ending::DrivePowerWhileArmed => {
                self.switches.amplifiers.set(false);
                self.pull(POWER_GOOD);
            }
            Ending::Stall | Ending::Hold | Ending::Range => self.wait_for_the_fault(),
            Ending::Converter => {
                self.operator.machine.board().converter.supply_lost = true;
                self.pass(100);
            }
            Ending::Jump => {
                let mut jumped = self.switches.jumped.get();
                jumped[self.rng.below(3) as usize] += 5_000;
                self.switches.jumped.set(jumped);
                self.pass(20);
            }
            Ending::Overrun => self.delay_the_tick(),
            Ending::Watchdog => {
                self.operator.machine.hang_thread().unwrap();
                self.let_it_reset();
            }
            Ending::Crash => {
                self.operator.machine.crash_thread().unwrap();
                self.let_it_reset();
            }
            Ending::PinReset => self.reset(Reset::Pin),
            Ending::BrownOut => self.reset(Reset::BrownOut),
            Ending::Clock => {
                // The other clock, which is the same: their ratio is what the board sees.
                self.operator.machine.board().watchdog.clock_hz = WRONG_CLOCK_HZ;
                self.pass(400);
            }
        }
        self.assert_ended(ending, since);
    }

    fn stop(&mut self) {
        self.ask(Command::Stop);
        self.pass(100);
        self.ask(Command::Disarm);
    }

    /// Noise, then an upload that the board must refuse, for it runs.
    fn make_noise(&mut self) {
        for _ in 0..NOISE_MS / 2 {
            let noise: Vec<u8> = (0..NOISE_BYTES).map(|_| self.rng.below(256) as u8).collect();
            self.operator.send(&noise);
            self.pass(1);
            // The host's own frame between, in time; a zero ends what the noise has begun.
            if self.counters.ms.is_multiple_of(100) {
                self.operator.send(&[0]);
                self.pass(5);
                let _ = self.operator.query().unwrap();
            }
        }
        self.operator.send(&[0]);
        self.pass(10);
        let begin = Command::UploadBegin { length: 100, checksum: 1 };
        let refused = self.operator.ask(begin).unwrap();
        assert_eq!(refused, Some(Err(Refusal::NotNow { state: State::Running })));
        self.attend(1000);
        self.stop();
    }

    fn pull(&mut self, pin: usize) {
        self.operator.machine.board().gpio[2].wires &= !(1 << pin);
        self.pass(20);
    }

    /// As a host that attends the run.
    fn wait_for_the_fault(&mut self) {
        let end = self.counters.ms + FOUND_WITHIN_MS;
        while self.counters.ms < end && self.report().state != State::Faulted {
            self.pass(90);
        }
    }

    fn delay_the_tick(&mut self) {
        let end = self.operator.machine.board().now + 3 * MS;
        self.operator.machine.mask_interrupts(true).unwrap();
        self.operator.machine.run_until(end).unwrap();
        self.operator.machine.mask_interrupts(false).unwrap();
        self.pass(20);
    }

    fn reset(&mut self, reset: Reset) {
        self.operator.machine.reset(reset).unwrap();
        self.let_it_reset();
        self.forget_half_a_frame();
    }

    /// What the board was sending when it was reset.
    fn forget_half_a_frame(&mut self) {
        assert!(self.operator.strange <= 1);
        self.operator.strange = 0;
    }

    fn let_it_reset(&mut self) {
        self.is_reset();
        self.counters.resets += 1;
        self.pass(100);
        assert!(self.operator.hello().unwrap());
    }

    /// The fault that belongs to it, 0 V in time, and no way to arm before it is cleared.
    fn assert_ended(&mut self, ending: Ending, since: u64) {
        let report = self.report();
        assert_eq!(report.fault.map(|record| record.fault), ending.fault(), "{ending:?}");
        assert!(!self.operator.machine.board().converter.is_released(), "{ending:?}");
        let Some(_) = ending.fault() else { return };
        self.counters.faults += 1;
        assert_eq!(report.state, State::Faulted);
        let cleared_at = self.operator.machine.board().trace.cleared_at.unwrap_or(since);
        if let Some(within_ms) = ending.zero_within_ms() {
            let ms = (cleared_at - since) as f64 / MS as f64;
            let worst_ms = &mut self.counters.worst_ms[ending as usize];
            *worst_ms = worst_ms.max(ms);
            assert!(ms < within_ms, "{ending:?}: {ms} ms");
        }
        let refused = self.operator.ask(Command::Arm).unwrap();
        assert_eq!(refused, Some(Err(Refusal::NotNow { state: State::Faulted })), "{ending:?}");
    }

    /// Takes its cause away, and sees that nothing moves before somebody asks for it.
    pub fn recover(&mut self, ending: Ending) {
        self.operator.machine.board().gpio[2].wires |= 1 << NOT_PRESSED | 1 << POWER_GOOD;
        self.operator.machine.board().converter.supply_lost = false;
        self.operator.machine.board().watchdog.clock_hz = CLOCK_HZ;
        self.switches.amplifiers.set(true);
        self.pass(300);
        assert!(!self.operator.machine.board().converter.is_released(), "{ending:?}");
        if ending.fault().is_some() {
            self.ask(Command::ClearFault);
            // Records of before are still on their way.
            self.pass(20);
        }
        self.expected = None;
        match ending {
            Ending::Jump => self.tell_where_it_is(),
            Ending::PowerCycle => self.power_cycle(),
            _ => {}
        }
    }

    /// After a jump an encoder must be seen to move, and be told where it is.
    fn tell_where_it_is(&mut self) {
        self.is_reset();
        self.switches.turn_by_hand.set(true);
    }

    fn power_cycle(&mut self) {
        self.is_reset();
        self.counters.resets += 1;
        self.operator.machine.reset(Reset::PowerOn).unwrap();
        self.pass(100);
        assert!(self.operator.hello().unwrap());
        self.forget_half_a_frame();
        let report = self.report();
        assert_eq!((report.state, report.fault), (State::Disarmed, None));
        let block = self.committed.as_ref().map(super::common::encoded);
        let found = report.parameters.expect("a block");
        assert_eq!(Some(usize::from(found.length)), block.as_ref().map(Vec::len));
        let checksum = block.map(|bytes| firmware::checksum::CRC_32C.checksum(&bytes));
        assert_eq!(Some(found.checksum), checksum);
        self.ask(Command::Download { source: Source::Stored, offset: 0 });
    }
}
