//! The tick: three counts in, three voltages out, once a millisecond.
//!
//! Deadline: the next tick, 1 ms or 170,000 cycles. Needed are about 40 us, see
//! `docs/board.md`. Nothing here waits for a task, and nothing interrupts it.

use core::ptr;
use core::sync::atomic::Ordering::{Acquire, Relaxed, Release};
use core::sync::atomic::{AtomicPtr, AtomicU32};

use cortex_m::singleton;
use embassy_stm32::interrupt::{self, InterruptExt};
use embassy_stm32::peripherals::TIM6;
use embassy_stm32::time::Hertz;
use embassy_stm32::timer::low_level::Timer;
use embassy_stm32::{Peri, pac};
use firmware::ad5754r::Channel;
use firmware::link::SupervisorAccess;
use firmware::supervisor::{
    BootReport, Health, Kept, Order, OrderError, ParameterWatch, State, Supervisor, TickRecord,
};

use crate::converter::Converter;
use crate::drive::Drive;
use crate::encoders::Encoders;
use crate::exchange::{Inbox, Question, RecordReader, Remote, Reply, SHARED, channel};
use crate::latch;
use crate::loopback::Loopback;

const TIMER_CLOCK: Hertz = Hertz(10_000_000);
const COUNTS_PER_PERIOD: u16 = 10_000;
/// Longer from the end of a tick to the end of the next means that a whole one was missed [us].
const MISSED_US: u16 = 1_500;

/// Ticks between two registers of the converter that are read back: all four in 64 ms.
const WATCH_EVERY_TICKS: u32 = 16;

/// What the interrupt works on, once [`start`] has put it there.
static TICK: AtomicPtr<Tick> = AtomicPtr::new(ptr::null_mut());

/// What the tick reads and sets.
pub struct Wired {
    pub encoders: Encoders,
    pub converter: Converter,
    pub drive: Drive,
    /// Where the rig measures the converter's outputs.
    pub loopback: Option<Loopback>,
}

struct Tick {
    timer: Timer<'static, TIM6>,
    encoders: Encoders,
    converter: Converter,
    drive: Drive,
    loopback: Option<Loopback>,
    inbox: Inbox,
    supervisor: Supervisor,
    parameter_watch: ParameterWatch,
    /// What is in the memory that a reset leaves alone.
    kept: Kept,
    health: Health,
    /// Whether the outputs follow the codes.
    released: bool,
    /// The codes were there after the time at which they act.
    is_late: bool,
    /// When the last tick ended, by the executor's clock, which begins anew every 65 ms [us].
    ended_us: Option<u16>,
}

/// Sets the converter up and begins to tick; the outputs stay at 0 V.
pub fn start(
    timer: Peri<'static, TIM6>,
    wired: Wired,
    mut supervisor: Supervisor,
    report: BootReport,
) -> (Remote, RecordReader) {
    let Wired { encoders, mut converter, drive, mut loopback } = wired;
    let set_up = converter.set_up();
    if let Err(fault) = set_up {
        defmt::error!("the converter does not answer: {}", fault);
    }
    let converter_fault = set_up.is_err();
    supervisor.booted(BootReport { converter_fault, ..report });
    let kept = supervisor.kept();
    latch::write(&kept);
    let (remote, records, inbox) = defmt::unwrap!(channel());
    let tick = Tick {
        timer: millisecond_timer(timer, &mut converter, loopback.as_mut()),
        encoders,
        converter,
        drive,
        loopback,
        inbox,
        supervisor,
        parameter_watch: ParameterWatch::default(),
        kept,
        health: Health { converter_fault, ..Health::default() },
        released: false,
        is_late: false,
        ended_us: None,
    };
    TICK.store(defmt::unwrap!(singleton!(: Tick = tick)), Release);
    // SAFETY: no critical section is open that the interrupt could break.
    unsafe { interrupt::TIM6_DAC.enable() };
    (remote, records)
}

fn millisecond_timer(
    timer: Peri<'static, TIM6>,
    converter: &mut Converter,
    loopback: Option<&mut Loopback>,
) -> Timer<'static, TIM6> {
    let mut timer = Timer::new(timer);
    if let Some(loopback) = loopback {
        loopback.start();
    }
    timer.regs_core().arr().write(|w| w.set_arr(COUNTS_PER_PERIOD - 1));
    timer.set_tick_freq(TIMER_CLOCK);
    timer.clear_update_interrupt();
    timer.enable_update_interrupt(true);
    timer.start();
    converter.start_load(TIMER_CLOCK, COUNTS_PER_PERIOD - 1);
    timer
}

#[embassy_stm32::interrupt]
fn TIM6_DAC() {
    // SAFETY: the pointer is null or comes from a singleton that nothing else refers
    // to, and this interrupt, the only place that follows it, cannot interrupt itself.
    if let Some(tick) = unsafe { TICK.load(Acquire).as_mut() } {
        tick.run();
    }
}

impl Tick {
    fn run(&mut self) {
        self.timer.clear_update_interrupt();
        // First of all, so that the instant of sampling depends on nothing below.
        let counts = self.encoders.read();
        self.converter.begin_tick();
        self.health.host_heard = SHARED.host_heard.load(Relaxed);
        SHARED.host_heard.store(false, Relaxed);
        self.drive.read(&mut self.health);
        self.supervisor.act(&counts, &self.health);
        let record = self.put_out();
        self.answer();
        self.check_parameters(record.tick);
        // What the next tick can know already, whatever the orders have changed.
        self.supervisor.prepare();
        self.watch_outputs(&record);
        self.watch_converter(&record);
        self.measure_tick_time();
    }

    /// Answers a question of the tasks, one a tick at most, once the codes are out: what the
    /// line carries delays no voltage. Orders act from the next tick on.
    fn answer(&mut self) {
        if let Some(question) = self.inbox.questions.dequeue() {
            self.answer_to(question);
        }
    }

    // Apart from the tick, whose stack it would fill with a controller.
    #[cold]
    #[inline(never)]
    fn answer_to(&mut self, question: Question) {
        let outcome = match question {
            Question::Status => Ok(()),
            Question::Order(order) => {
                self.renew_converter(order);
                self.supervisor.execute(order)
            }
            Question::Replace => self.replace(),
        };
        // There is room: the tasks ask one thing at a time.
        let _ = self.inbox.replies.enqueue(Reply { outcome, status: self.supervisor.status() });
    }

    #[inline(never)]
    fn replace(&mut self) -> Result<(), OrderError> {
        match self.inbox.controllers.dequeue() {
            Some(controller) => self.supervisor.replace(controller),
            None => Ok(()),
        }
    }

    /// Sends the codes, where the supervisor lets them out, and completes the tick while the line
    /// to the converter is busy.
    #[inline]
    fn put_out(&mut self) -> TickRecord {
        let Some(codes) = self.supervisor.codes() else {
            self.converter.hold_at_zero();
            self.released = false;
            let record = self.supervisor.complete();
            self.drive.write(self.supervisor.drive_outputs());
            self.publish(&record);
            self.latch();
            self.is_late = false;
            return record;
        };
        if !self.released {
            self.converter.release();
            self.released = true;
        }
        let [first, second, third] = Channel::JOINTS;
        self.converter.begin(first, codes[0]);
        let record = self.supervisor.complete();
        let mut is_sent = self.converter.end().is_ok();
        self.drive.write(self.supervisor.drive_outputs());
        self.converter.begin(second, codes[1]);
        self.publish(&record);
        is_sent &= self.converter.end().is_ok();
        self.latch();
        self.converter.begin(third, codes[2]);
        is_sent &= self.converter.end().is_ok();
        self.is_late = is_sent && !self.converter.load();
        if !is_sent {
            // At once; the supervisor hears of it in the next tick.
            self.converter.hold_at_zero();
            self.health.converter_fault = true;
        }
        record
    }

    /// Compares what was measured at the outputs, where they are wired, with the codes that acted.
    #[inline]
    fn watch_outputs(&mut self, record: &TickRecord) {
        if let Some(loopback) = &mut self.loopback
            && !self.supervisor.outputs_measured(&loopback.volts(), record)
        {
            // At once, and the amplifiers too: the converter itself may be what is broken.
            self.converter.hold_at_zero();
            self.drive.write(self.supervisor.drive_outputs());
        }
    }

    /// Now and then, after the codes are out, so that it delays nothing.
    fn watch_converter(&mut self, record: &TickRecord) {
        if record.state.drives()
            && record.tick.is_multiple_of(WATCH_EVERY_TICKS)
            && self.converter.watch().is_err()
        {
            self.converter.hold_at_zero();
            self.health.converter_fault = true;
        }
    }

    /// Sets the converter up anew before arming and before a fault is cleared: its supply may have
    /// come and gone since power-on.
    fn renew_converter(&mut self, order: Order) {
        let is_idle = matches!(self.supervisor.state(), State::Disarmed | State::Faulted);
        if is_idle && matches!(order, Order::Arm | Order::ClearFault) {
            self.health.converter_fault = self.converter.set_up().is_err();
            self.released = false;
            self.supervisor.set_health(self.health);
        }
    }

    fn latch(&mut self) {
        let kept = self.supervisor.kept();
        if kept != self.kept {
            self.latch_anew(kept);
        }
    }

    #[cold]
    #[inline(never)]
    fn latch_anew(&mut self, kept: Kept) {
        self.kept = kept;
        latch::write(&kept);
    }

    /// A part now and then, all of them within a second; after the codes are out, so that it
    /// delays nothing.
    fn check_parameters(&mut self, tick: u32) {
        if ParameterWatch::is_due(tick) {
            self.check_parameters_now();
        }
    }

    #[cold]
    #[inline(never)]
    fn check_parameters_now(&mut self) {
        self.health.parameters_corrupt = self.parameter_watch.check(&self.supervisor);
        self.health.clock_wrong = SHARED.clock_wrong.load(Relaxed);
    }

    #[inline]
    fn publish(&mut self, record: &TickRecord) {
        SHARED.set_state(record.state);
        count(&SHARED.ticks);
        if SHARED.streaming.load(Relaxed) && !self.inbox.records.enqueue(*record) {
            count(&SHARED.records_dropped);
        }
    }

    fn measure_tick_time(&mut self) {
        let mut taken = u32::from(self.timer.regs_core().cnt().read().cnt());
        // The timer's event has come again: the interrupt follows at once, late.
        self.health.overrun =
            self.timer.regs_core().sr().read().uif() || self.missed_a_tick() || self.is_late;
        if self.health.overrun {
            taken += u32::from(COUNTS_PER_PERIOD);
            count(&SHARED.overruns);
        }
        self.health.tick_time_tenth_us = taken.min(u32::from(u16::MAX)) as u16;
        let longest = SHARED.longest_tenth_us.load(Relaxed).max(taken);
        SHARED.longest_tenth_us.store(longest, Relaxed);
    }

    /// Whether interrupts were held off for a whole period: the timer's event then has come twice
    /// and is seen once. The watchdog bites before this clock has gone round.
    fn missed_a_tick(&mut self) -> bool {
        let now_us = pac::TIM5.cnt().read() as u16;
        let before = self.ended_us.replace(now_us);
        before.is_some_and(|before_us| now_us.wrapping_sub(before_us) > MISSED_US)
    }
}

/// Only the tick writes these, so loading and storing need not be one step.
fn count(counter: &AtomicU32) {
    counter.store(counter.load(Relaxed).wrapping_add(1), Relaxed);
}
