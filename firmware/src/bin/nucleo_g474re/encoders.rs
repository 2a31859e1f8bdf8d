//! Three quadrature encoders, each counted by a timer, four counts a line.

use embassy_stm32::Peri;
use embassy_stm32::gpio::Pull;
use embassy_stm32::pac;
use embassy_stm32::pac::timer::vals::FilterValue;
use embassy_stm32::peripherals::{PA0, PA1, PA6, PA7, PA8, PA9, TIM1, TIM2, TIM3};
use embassy_stm32::timer::qei::{Config, Qei};
use firmware::encoder::CounterExtender;

/// A level counts after eight samples at 42.5 MHz, 188 ns, alike.
///
/// At full speed, 983 counts a tick, an edge comes every 1.02 us.
const FILTER: FilterValue = FilterValue::FDTS_DIV4_N8;

/// An input that nothing is connected to, or whose wire is broken, has a level and does not count.
fn pulled_up() -> Config {
    Config { ch1_pull: Pull::Up, ch2_pull: Pull::Up, ..Config::default() }
}

/// A timer and its channels A and B.
type Wires<T, A, B> = (Peri<'static, T>, Peri<'static, A>, Peri<'static, B>);

/// The encoders of joints 1, 2 and 3.
pub struct Encoders {
    first: Qei<'static, TIM2>,
    second: Qei<'static, TIM3>,
    third: Qei<'static, TIM1>,
    extenders: [CounterExtender; 3],
}

impl Encoders {
    /// Starts counting, from zero.
    pub fn new(
        first: Wires<TIM2, PA0, PA1>,
        second: Wires<TIM3, PA6, PA7>,
        third: Wires<TIM1, PA8, PA9>,
    ) -> Self {
        let mut encoders = Self {
            first: Qei::new(first.0, first.1, first.2, pulled_up()),
            second: Qei::new(second.0, second.1, second.2, pulled_up()),
            third: Qei::new(third.0, third.1, third.2, pulled_up()),
            extenders: [CounterExtender::default(); 3],
        };
        encoders.filter_and_zero();
        encoders
    }

    /// Counts since power-on.
    #[inline]
    pub fn read(&mut self) -> [i32; 3] {
        let counts = [self.first.count(), self.second.count(), self.third.count()];
        let [first, second, third] = &mut self.extenders;
        [first.update(counts[0]), second.update(counts[1]), third.update(counts[2])]
    }

    /// What was counted before the filters were on does not count.
    fn filter_and_zero(&mut self) {
        for channel in [0, 1] {
            pac::TIM2.ccmr_input(0).modify(|w| w.set_icf(channel, FILTER));
            pac::TIM3.ccmr_input(0).modify(|w| w.set_icf(channel, FILTER));
            pac::TIM1.ccmr_input(0).modify(|w| w.set_icf(channel, FILTER));
        }
        self.first.reset();
        self.second.reset();
        self.third.reset();
    }
}
