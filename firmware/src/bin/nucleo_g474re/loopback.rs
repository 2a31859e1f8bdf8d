//! The converter's outputs, measured by ADC1 at each event of the tick's timer, where the rig has the
//! dividers of `docs/board.md`.
//!
//! TIM6 itself starts the three conversions, done 2.6 us later: 22 us before LDAC, so they see the
//! codes of the tick before, and no instruction is spent on it before the codes are out.

use core::ptr;

use cortex_m::asm;
use embassy_stm32::pac::adc::vals::{Exten, SampleTime};
use embassy_stm32::pac::adccommon::vals::Ckmode;
use embassy_stm32::pac::timer::vals::Mms;
use embassy_stm32::peripherals::{ADC1, PC0, PC1, PC2};
use embassy_stm32::{Peri, pac};
use firmware::loopback::volts;

/// Named at the build: `wired`, or nothing.
const LOOPBACK: Option<&str> = option_env!("RRR_RIG_LOOPBACK");

/// A wrong text ends the build.
const _: () = assert!(is_well_formed(LOOPBACK), "RRR_RIG_LOOPBACK: give `wired`, or leave it out");

/// One byte of the image, so that the code is the same with and without.
#[unsafe(no_mangle)]
static RRR_RIG_HAS_LOOPBACK: u8 = LOOPBACK.is_some() as u8;

/// Inputs of ADC1 at PC0, PC1 and PC2.
const CHANNELS: [u8; 3] = [6, 7, 8];
/// TIM6's update as it starts injected conversions (RM0440, table of their triggers).
const BY_TIM6: u8 = 14;
/// The regulator of the ADC takes 20 us to start.
const REGULATOR_CYCLES: u32 = 20 * 170;
/// Between calibration and switching on, four clocks of the ADC of four cycles each.
const CALIBRATED_CYCLES: u32 = 16;
/// Looks at a bit that comes within microseconds.
const LOOKS: u32 = 10_000;

/// ADC1, measuring.
pub struct Loopback {
    _adc: Peri<'static, ADC1>,
}

impl Loopback {
    /// `None` where the rig has no dividers; the pins are analog inputs from the reset on.
    pub fn where_wired(
        adc: Peri<'static, ADC1>,
        _pins: (Peri<'static, PC0>, Peri<'static, PC1>, Peri<'static, PC2>),
    ) -> Option<Self> {
        // SAFETY: a byte of the image; read as it is there, not as the compiler has seen it.
        let is_wired = unsafe { ptr::read_volatile(&raw const RRR_RIG_HAS_LOOPBACK) } == 1;
        is_wired.then_some(Self { _adc: adc })
    }

    /// Switches the ADC on and has TIM6 start it, before TIM6 counts.
    ///
    /// An ADC that does not start counts nothing, which no code explains.
    #[cold]
    #[inline(never)]
    pub fn start(&mut self) {
        pac::RCC.ahb2enr().modify(|w| w.set_adc12en(true));
        // A quarter of the buses' clock, 42.5 MHz, and in step with the timer.
        pac::ADC12_COMMON.ccr().modify(|w| w.set_ckmode(Ckmode::SYNC_DIV4));
        pac::ADC1.cr().write(|w| w.set_advregen(true));
        asm::delay(REGULATOR_CYCLES);
        pac::ADC1.cr().write(|w| {
            w.set_advregen(true);
            w.set_adcal(true);
        });
        wait_for(|| !pac::ADC1.cr().read().adcal());
        asm::delay(CALIBRATED_CYCLES);
        pac::ADC1.cr().write(|w| {
            w.set_advregen(true);
            w.set_aden(true);
        });
        wait_for(|| pac::ADC1.isr().read().adrdy());
        set_sequence();
        pac::TIM6.cr2().write(|w| w.set_mms(Mms::UPDATE));
    }

    /// The voltages at the outputs at the timer's event [V].
    #[inline]
    pub fn volts(&mut self) -> [f32; 3] {
        let is_there = pac::ADC1.isr().read().jeos();
        pac::ADC1.isr().write(|w| w.set_jeos(true));
        let counts = |n| if is_there { pac::ADC1.jdr(n).read().jdata() } else { 0 };
        [0, 1, 2].map(|n| volts(counts(n)))
    }
}

/// The three outputs at each event; 24.5 clocks suffice, as the dividers have capacitors.
fn set_sequence() {
    pac::ADC1.smpr().write(|w| {
        CHANNELS.iter().for_each(|channel| {
            w.set_smp(usize::from(*channel), SampleTime::CYCLES24_5);
        });
    });
    pac::ADC1.jsqr().write(|w| {
        w.set_jl(CHANNELS.len() as u8 - 1);
        w.set_jextsel(BY_TIM6);
        w.set_jexten(Exten::RISING_EDGE);
        for (n, channel) in CHANNELS.into_iter().enumerate() {
            w.set_jsq(n, channel);
        }
    });
    pac::ADC1.cr().write(|w| {
        w.set_advregen(true);
        w.set_jadstart(true);
    });
}

fn wait_for(is_there: impl Fn() -> bool) {
    for _ in 0..LOOKS {
        if is_there() {
            return;
        }
    }
}

const fn is_well_formed(text: Option<&str>) -> bool {
    let Some(text) = text else { return true };
    matches!(text.as_bytes(), b"wired")
}
