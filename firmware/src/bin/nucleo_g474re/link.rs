//! The serial line to the host, through the ST-LINK's virtual COM port.
//!
//! 921,600 baud, 8N1. A frame comes in, one status byte goes out; see
//! [`firmware::frame`] and [`firmware::message`].

use core::sync::atomic::Ordering::Relaxed;

use cortex_m::singleton;
use embassy_stm32::mode::Async;
use embassy_stm32::peripherals::{DMA1_CH1, DMA1_CH2, LPUART1, PA2, PA3};
use embassy_stm32::usart::{Config, InterruptHandler, RingBufferedUartRx, Uart, UartTx};
use embassy_stm32::{Peri, bind_interrupts, dma};
use embassy_time::Timer;
use firmware::frame::{FrameReader, one_byte_frame};
use firmware::message::{Message, Status};
use firmware::{BlockError, Controller, ParameterBlock};

use crate::exchange::{Command, Orders, REPORT};
use crate::tick::PERIOD_S;

const BAUD: u32 = 921_600;
/// 11 ms of a line that never pauses.
const RING_BYTES: usize = 1024;
/// By then the tick has taken an order, whenever it came.
const OBEYED_AFTER_MS: u64 = 3;

bind_interrupts!(struct Interrupts {
    LPUART1 => InterruptHandler<LPUART1>;
    DMA1_CHANNEL1 => dma::InterruptHandler<DMA1_CH1>;
    DMA1_CHANNEL2 => dma::InterruptHandler<DMA1_CH2>;
});

/// The port and its pins.
pub struct LinkPins {
    pub uart: Peri<'static, LPUART1>,
    pub receive: Peri<'static, PA3>,
    pub send: Peri<'static, PA2>,
}

/// The board's end of the line.
pub struct Link {
    receiver: RingBufferedUartRx<'static>,
    sender: UartTx<'static, Async>,
    orders: Orders,
}

impl Link {
    /// Takes the port.
    pub fn new(
        pins: LinkPins,
        send_dma: Peri<'static, DMA1_CH1>,
        receive_dma: Peri<'static, DMA1_CH2>,
        orders: Orders,
    ) -> Self {
        let mut config = Config::default();
        config.baudrate = BAUD;
        let LinkPins { uart, receive, send } = pins;
        let uart = Uart::new(uart, receive, send, send_dma, receive_dma, Interrupts, config);
        let (sender, receiver) = defmt::unwrap!(uart).split();
        let ring = defmt::unwrap!(singleton!(: [u8; RING_BYTES] = [0; RING_BYTES]));
        Self { receiver: receiver.into_ring_buffered(ring), sender, orders }
    }

    async fn answer(&mut self, frame: &[u8]) {
        let accepted = match Message::from_frame(frame) {
            Some(Message::Query) => true,
            Some(Message::Start) => self.command(Command::Start).await.running,
            Some(Message::Stop) => !self.command(Command::Stop).await.running,
            Some(Message::Block(bytes)) => self.load(bytes).await,
            None => false,
        };
        let status = REPORT.status(accepted).to_byte();
        if self.sender.write(&one_byte_frame(status)).await.is_err() {
            defmt::warn!("an answer did not go out");
        }
    }

    async fn command(&mut self, command: Command) -> Status {
        if !self.orders.command(command) {
            defmt::warn!("the tick takes no commands");
        }
        Timer::after_millis(OBEYED_AFTER_MS).await;
        REPORT.status(true)
    }

    async fn load(&mut self, bytes: &[u8]) -> bool {
        let accepted = match accept(bytes) {
            Ok(controller) => self.orders.replace(controller),
            Err(why) => {
                defmt::warn!("no new parameters: {}", why);
                false
            }
        };
        Timer::after_millis(OBEYED_AFTER_MS).await;
        accepted
    }
}

/// Answers for ever.
#[embassy_executor::task]
pub async fn serve(mut link: Link) -> ! {
    let mut frames = FrameReader::new();
    let mut bytes = [0; 64];
    loop {
        let Ok(length) = link.receiver.read(&mut bytes).await else {
            frames.lose();
            defmt::warn!("bytes lost on the line; frames dropped: {}", frames.dropped());
            continue;
        };
        for &byte in bytes.iter().take(length) {
            if let Some(frame) = frames.push(byte) {
                link.answer(frame).await;
            }
        }
    }
}

/// A controller with the block in these bytes, or why not.
fn accept(bytes: &[u8]) -> Result<Controller, &'static str> {
    if REPORT.running.load(Relaxed) {
        return Err("the controller is running");
    }
    let block = ParameterBlock::decode(bytes).map_err(reason)?;
    if (block.sample_period_s - PERIOD_S).abs() > 1e-6 * PERIOD_S {
        return Err("this board ticks once a millisecond");
    }
    Ok(Controller::new(block))
}

/// In a word: the host checks blocks before it sends them, and says more.
fn reason(error: BlockError) -> &'static str {
    match error {
        BlockError::Length { .. } => "length",
        BlockError::Version { .. } => "version",
        BlockError::Checksum => "checksum",
        BlockError::Layout => "layout",
        BlockError::Parameter(_) => "a value is out of its range",
    }
}
