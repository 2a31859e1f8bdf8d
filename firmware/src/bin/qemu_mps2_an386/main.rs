//! The controller on QEMU's `mps2-an386`, a Cortex-M4F.
//!
//! Encoders and converter are a lockstep link to a simulated robot: QEMU's
//! semihosting opens two FIFOs in its working directory, [`firmware::lockstep`] says
//! what goes through them. Where there are none, the board ticks by its own clock and
//! its encoders stand still. The serial line to the host is the first UART, served
//! after each tick; the flash is a file. The CMSDK timer counts the tick's instructions.
#![no_std]
#![no_main]

mod board;
mod flash;
mod host_file;
mod line;
mod robot;
mod timer;

use cortex_m as _;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use firmware::link::BoardRuntime;

use crate::board::{Board, Store};
use crate::host_file::HostFile;
use crate::robot::Robot;

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
    let mut board = Board::new(boot()?);
    match Robot::connect() {
        Some(mut robot) => robot.converse(&mut board),
        None => board.tick_alone(),
    }
}

/// Boots with what the flash holds; `None` where there can be no flash.
fn boot() -> Option<BoardRuntime<Store>> {
    Some(BoardRuntime::boot(flash::store()?, NAME, random()?, false).0)
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
