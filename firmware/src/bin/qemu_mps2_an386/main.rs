//! The controller on QEMU's `mps2-an386`, a Cortex-M4F.
//!
//! Encoders and converter are a lockstep link to a simulated robot: QEMU's
//! semihosting opens two FIFOs in its working directory, [`firmware::lockstep`] says
//! what goes through them. Where there are none, the board ticks by its own clock and
//! its encoders stand still. The serial line to the host is the first UART, served
//! after each tick; the flash is a file. The CMSDK timer counts the tick's instructions.
#![no_std]
#![no_main]

mod flash;
mod host_file;
mod line;
mod robot;
mod timer;

use cortex_m as _;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use firmware::link::Station;
use firmware::lockstep::Reply;

use crate::flash::FileFlash;
use crate::host_file::HostFile;
use crate::line::Line;
use crate::robot::Robot;

type Store = firmware::store::Store<FileFlash>;

/// Counts of the timer in a tick of 1 ms.
const COUNTS_PER_TICK: u32 = 25_000;
/// The name in the board's Hello.
const NAME: &str = "qemu-mps2-an386";

#[entry]
fn main() -> ! {
    timer::start();
    let status = match run() {
        Some(()) => debug::EXIT_SUCCESS,
        None => debug::EXIT_FAILURE,
    };
    loop {
        debug::exit(status);
    }
}

/// Runs until the robot's side quits; `None` when something breaks.
fn run() -> Option<()> {
    let mut board = Board { station: boot()?, line: Line::open(), last_tick_counts: 0 };
    match Robot::connect() {
        Some(mut robot) => robot.converse(&mut board),
        None => board.tick_alone(),
    }
}

/// The board above the simulated pins.
struct Board {
    station: Station<Store>,
    line: Line,
    /// Counts of the timer that the last tick took.
    last_tick_counts: u32,
}

impl Board {
    /// A tick. What is done after it is [`Board::serve_line`].
    fn tick(&mut self, counts: &[i32; 3]) -> Reply {
        let mut health = self.station.health();
        health.tick_time_tenth_us = tenth_us(self.last_tick_counts);
        let before = timer::now();
        let record = self.station.supervisor.tick(counts, health);
        let timer_counts = timer::now().wrapping_sub(before);
        self.last_tick_counts = timer_counts;
        self.station.after_tick(&record);
        Reply {
            accepted: true,
            saturated: record.saturated,
            codes: record.codes,
            reference: record.reference,
            timer_counts,
            ..Reply::default()
        }
    }

    fn serve_line(&mut self) {
        self.line.serve(&mut self.station);
    }

    /// Ticks by the board's own clock for ever, at encoders that stand still.
    fn tick_alone(&mut self) -> ! {
        let mut last = timer::now();
        loop {
            self.serve_line();
            if timer::now().wrapping_sub(last) >= COUNTS_PER_TICK {
                last = timer::now();
                self.tick(&[0; 3]);
            }
        }
    }
}

/// Counts of 25 MHz of the emulated clock as time [0.1 us].
fn tenth_us(counts: u32) -> u16 {
    (counts / 5 * 2).min(u32::from(u16::MAX)) as u16
}

/// Takes what the flash has kept; `None` where there can be no flash.
fn boot() -> Option<Station<Store>> {
    Some(Station::boot(flash::store()?, NAME, random()?, false).0)
}

/// Bytes of the host's random generator.
fn random() -> Option<[u8; 16]> {
    let mut bytes = [0; 16];
    HostFile::open(c"/dev/urandom", host_file::Mode::Read)?.read(&mut bytes)?;
    Some(bytes)
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {
        debug::exit(debug::EXIT_FAILURE);
    }
}
