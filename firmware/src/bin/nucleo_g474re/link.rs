//! The serial line to the host, through the ST-LINK's virtual COM port.
//!
//! 921,600 baud, 8N1; what is said on it is in [`firmware::link`].

use core::sync::atomic::Ordering::Relaxed;

use cortex_m::singleton;
use embassy_futures::yield_now;
use embassy_stm32::mode::Async;
use embassy_stm32::peripherals::{DMA1_CH1, DMA1_CH2, LPUART1, PA2, PA3};
use embassy_stm32::usart::{Config, InterruptHandler, RingBufferedUartRx, Uart, UartTx};
use embassy_stm32::{Peri, bind_interrupts, dma};
use embassy_time::{Duration, Instant, with_timeout};
use firmware::link::{BAUD, Handler, MAX_FRAME_BYTES, SupervisorAccess, Telemetry, ToHost};
use firmware::store::Store;
use heapless::Vec;

use crate::exchange::{RecordReader, Remote, SHARED};
use crate::flash::BoardFlash;

/// 11 ms of a line that never pauses.
const RING_BYTES: usize = 1024;
/// Records are sent so many bytes at a time, 5 ms of the line.
const BATCH_BYTES: usize = 512;
/// So long is waited for bytes before records are sent.
const LISTEN: Duration = Duration::from_millis(1);
/// How often a new fault is looked for, to be stored.
const STORE_EVERY: Duration = Duration::from_millis(20);

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
    handler: Handler<Store<BoardFlash>>,
    remote: Remote,
    records: RecordReader,
    stored_at: Instant,
    /// Records that the port did not take.
    records_lost: u32,
}

impl Link {
    /// Takes the port.
    pub fn new(
        pins: LinkPins,
        send_dma: Peri<'static, DMA1_CH1>,
        receive_dma: Peri<'static, DMA1_CH2>,
        handler: Handler<Store<BoardFlash>>,
        remote: Remote,
        records: RecordReader,
    ) -> Self {
        let mut config = Config::default();
        config.baudrate = BAUD;
        let LinkPins { uart, receive, send } = pins;
        let uart = Uart::new(uart, receive, send, send_dma, receive_dma, Interrupts, config);
        let (sender, receiver) = defmt::unwrap!(uart).split();
        let ring = defmt::unwrap!(singleton!(: [u8; RING_BYTES] = [0; RING_BYTES]));
        let receiver = receiver.into_ring_buffered(ring);
        Self {
            receiver,
            sender,
            handler,
            remote,
            records,
            stored_at: Instant::MIN,
            records_lost: 0,
        }
    }

    async fn listen(&mut self) {
        let mut bytes = [0; 64];
        let length = match with_timeout(LISTEN, self.receiver.read(&mut bytes)).await {
            Ok(Ok(length)) => length,
            Ok(Err(_)) => return self.handler.discard(),
            Err(_) => return,
        };
        for &byte in bytes.iter().take(length) {
            let Some(frame) = self.handler.receive(byte, &mut self.remote) else { continue };
            if self.sender.write(frame).await.is_err() {
                defmt::warn!("an answer did not go out");
            }
            // A request may have waited for ticks: the watchdog's task comes in between.
            yield_now().await;
        }
        SHARED.streaming.store(self.handler.streaming(), Relaxed);
        if self.handler.take_heard() {
            SHARED.host_heard.store(true, Relaxed);
        }
    }

    async fn send_records(&mut self) {
        let dropped = SHARED.records_dropped.load(Relaxed).wrapping_add(self.records_lost);
        self.handler.set_telemetry_dropped(dropped);
        let mut batch = Vec::<u8, BATCH_BYTES>::new();
        let mut records = 0;
        while batch.len() + MAX_FRAME_BYTES <= BATCH_BYTES {
            let Some(record) = self.records.dequeue() else { break };
            records += 1;
            let mut buffer = [0; MAX_FRAME_BYTES];
            let message = ToHost::Telemetry(Telemetry::new(&record, dropped));
            // A frame is never longer than there is room for.
            let _ = batch.extend_from_slice(message.write(&mut buffer).unwrap_or_default());
        }
        if !batch.is_empty() && self.sender.write(&batch).await.is_err() {
            self.records_lost = self.records_lost.wrapping_add(records);
            defmt::warn!("records did not go out");
        }
    }

    fn store_fault(&mut self) {
        if self.stored_at.elapsed() >= STORE_EVERY {
            self.stored_at = Instant::now();
            self.remote.refresh();
            if !self.handler.store_fault(&self.remote) {
                defmt::warn!("the fault could not be stored");
            }
        }
    }
}

/// Answers and sends records for ever.
#[embassy_executor::task]
pub async fn serve(mut link: Link) -> ! {
    loop {
        link.listen().await;
        link.send_records().await;
        link.store_fault();
    }
}
