//! The tick: three counts in, three voltages out, once a millisecond.
//!
//! Deadline: the next tick, 1 ms or 170,000 cycles. Needed are about 40 us, see
//! `docs/board.md`. Nothing here waits for a task, and nothing interrupts it.

use core::ptr;
use core::sync::atomic::Ordering::{Acquire, Relaxed, Release};
use core::sync::atomic::{AtomicPtr, AtomicU32};

use cortex_m::singleton;
use embassy_stm32::Peri;
use embassy_stm32::interrupt::{self, InterruptExt};
use embassy_stm32::peripherals::TIM6;
use embassy_stm32::time::Hertz;
use embassy_stm32::timer::low_level::Timer;
use firmware::{Controller, DacCode};

use crate::converter::Converter;
use crate::encoders::Encoders;
use crate::exchange::{Command, Inbox, Orders, REPORT, channel};

/// Time from tick to tick; a parameter block for another one is refused [s].
pub const PERIOD_S: f32 = 1e-3;

const TIMER_CLOCK: Hertz = Hertz(10_000_000);
const COUNTS_PER_PERIOD: u16 = 10_000;

/// What the interrupt works on, once [`start`] has put it there.
static TICK: AtomicPtr<Tick> = AtomicPtr::new(ptr::null_mut());

struct Tick {
    timer: Timer<'static, TIM6>,
    encoders: Encoders,
    converter: Converter,
    inbox: Inbox,
    controller: Option<Controller>,
    running: bool,
    converter_fault: bool,
}

/// Sets the converter up and begins to tick; the outputs stay at 0 V.
pub fn start(timer: Peri<'static, TIM6>, encoders: Encoders, mut converter: Converter) -> Orders {
    let set_up = converter.set_up();
    if let Err(fault) = set_up {
        defmt::error!("the converter does not answer: {}", fault);
    }
    let (orders, inbox) = defmt::unwrap!(channel());
    let tick = Tick {
        timer: millisecond_timer(timer),
        encoders,
        converter,
        inbox,
        controller: None,
        running: false,
        converter_fault: set_up.is_err(),
    };
    TICK.store(defmt::unwrap!(singleton!(: Tick = tick)), Release);
    // SAFETY: no critical section is open that the interrupt could break.
    unsafe { interrupt::TIM6_DAC.enable() };
    orders
}

fn millisecond_timer(timer: Peri<'static, TIM6>) -> Timer<'static, TIM6> {
    let mut timer = Timer::new(timer);
    timer.regs_core().arr().write(|w| w.set_arr(COUNTS_PER_PERIOD - 1));
    timer.set_tick_freq(TIMER_CLOCK);
    timer.clear_update_interrupt();
    timer.enable_update_interrupt(true);
    timer.start();
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
        self.obey();
        let codes = match &mut self.controller {
            Some(controller) => controller.tick(&counts).codes,
            None => [DacCode::default(); 3],
        };
        self.put_out(&codes);
        self.report();
    }

    fn obey(&mut self) {
        if !self.running
            && let Some(controller) = self.inbox.controllers.dequeue()
        {
            self.controller = Some(controller);
        }
        while let Some(command) = self.inbox.commands.dequeue() {
            match command {
                Command::Start => self.begin(),
                Command::Stop => self.stop(),
            }
        }
    }

    fn begin(&mut self) {
        if self.running || self.converter_fault {
            return;
        }
        if let Some(controller) = &mut self.controller {
            controller.start();
            self.converter.release();
            self.running = true;
        }
    }

    fn stop(&mut self) {
        self.converter.hold_at_zero();
        self.running = false;
        if let Some(controller) = &mut self.controller {
            controller.stop();
        }
    }

    fn put_out(&mut self, codes: &[DacCode; 3]) {
        if self.running && self.converter.put_out(codes).is_err() {
            self.converter_fault = true;
            self.stop();
        }
    }

    fn report(&self) {
        REPORT.loaded.store(self.controller.is_some(), Relaxed);
        REPORT.running.store(self.running, Relaxed);
        REPORT.converter_fault.store(self.converter_fault, Relaxed);
        count(&REPORT.ticks);
        let mut taken = u32::from(self.timer.regs_core().cnt().read().cnt());
        // The timer's event has come again: the interrupt follows at once, late.
        if self.timer.regs_core().sr().read().uif() {
            taken += u32::from(COUNTS_PER_PERIOD);
            count(&REPORT.overruns);
        }
        let longest = REPORT.longest_tenth_us.load(Relaxed).max(taken);
        REPORT.longest_tenth_us.store(longest, Relaxed);
    }
}

/// Only the tick writes these, so loading and storing need not be one step.
fn count(counter: &AtomicU32) {
    counter.store(counter.load(Relaxed).wrapping_add(1), Relaxed);
}
