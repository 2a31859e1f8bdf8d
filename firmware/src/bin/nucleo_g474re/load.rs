//! LDAC of the converter, pulled low by a compare of TIM4: all outputs change at the same time
//! after each event of TIM6, however long the tick has computed.
//!
//! TIM4 counts as TIM6 does, started a few cycles later. Its output is high until the counter
//! reaches the compare value, then low until the counter begins anew: a tick that has not put its
//! codes out moves the compare value out of reach, so the outputs keep what they have.

use cortex_m::asm;
use embassy_stm32::Peri;
use embassy_stm32::gpio::{AfType, Flex, Level, OutputType, Speed};
use embassy_stm32::pac::TIM4;
use embassy_stm32::pac::timer::vals::Ocm;
use embassy_stm32::peripherals::{PB6, TIM4 as Tim4};
use embassy_stm32::time::Hertz;
use embassy_stm32::timer::low_level::Timer;

/// From TIM6's event to LDAC [0.1 us]: twice what the longest way to the codes takes in the
/// emulation, since a critical section may delay the tick by 6 us and the chip takes more cycles.
const LOAD_AT: u16 = 250;
/// From SYNC high to LDAC low, 130 ns: in counts, rounded up, and in cycles.
const SYNC_TO_LOAD: u16 = 3;
const SYNC_TO_LOAD_CYCLES: u32 = 23;
/// The counter never gets there: the output stays high.
const NEVER: u16 = u16::MAX;
/// More looks at the counter than it takes to get there, at least four cycles each.
const POLLS: u32 = 4 * LOAD_AT as u32 + 100;
/// The function of PB6 that is channel 1 of TIM4.
const FUNCTION: u8 = 2;

/// The pin LDAC and its timer.
pub struct Load {
    timer: Timer<'static, Tim4>,
    _pin: Flex<'static>,
}

impl Load {
    /// Takes the pin, which stays high.
    pub fn new(timer: Peri<'static, Tim4>, pin: Peri<'static, PB6>) -> Self {
        let mut pin = Flex::new(pin);
        pin.set_level(Level::High);
        pin.set_as_output(Speed::High);
        let timer = Timer::new(timer);
        TIM4.ccr(0).write(|w| w.set_ccr(NEVER));
        TIM4.ccmr_output(0).modify(|w| w.set_ocm(0, Ocm::PWM_MODE1));
        TIM4.ccer().modify(|w| w.set_cce(0, true));
        pin.set_as_af_unchecked(FUNCTION, AfType::output(OutputType::PushPull, Speed::High));
        Self { timer, _pin: pin }
    }

    /// Begins to count with the tick's timer, of this clock and period.
    pub fn start(&mut self, clock: Hertz, period: u16) {
        self.timer.set_tick_freq(clock);
        TIM4.arr().write(|w| w.set_arr(period));
        self.timer.start();
    }

    /// LDAC stays high.
    #[inline]
    pub fn hold(&mut self) {
        TIM4.ccr(0).write(|w| w.set_ccr(NEVER));
    }

    /// Waits until LDAC has fallen, so that no frame is on the line while it does.
    pub fn wait(&mut self) {
        for _ in 0..POLLS {
            if TIM4.cnt().read().cnt() > LOAD_AT {
                return;
            }
        }
    }

    /// LDAC falls at its time, or at once where that is over; whether it lay ahead.
    #[inline]
    pub fn release(&mut self) -> bool {
        let in_time = TIM4.cnt().read().cnt() < LOAD_AT - SYNC_TO_LOAD;
        if !in_time {
            asm::delay(SYNC_TO_LOAD_CYCLES);
        }
        TIM4.ccr(0).write(|w| w.set_ccr(LOAD_AT));
        in_time
    }
}
