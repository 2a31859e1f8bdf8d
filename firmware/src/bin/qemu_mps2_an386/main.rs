//! The controller on QEMU's `mps2-an386`, a Cortex-M4F.
//!
//! Encoders and converter are a lockstep link to a simulated robot: QEMU's
//! semihosting opens two FIFOs in its working directory, [`lockstep`] says what
//! goes through them. The CMSDK timer counts the tick's instructions.
#![no_std]
#![no_main]

mod flash;
mod host_file;
mod timer;

use cortex_m as _;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use firmware::block::MAX_BYTES;
use firmware::lockstep::{REQUEST_BYTES, Request, Responder, commit};

use crate::host_file::HostFile;

/// Requests come in here.
const REQUESTS: &core::ffi::CStr = c"to-board";
/// Replies go out here.
const REPLIES: &core::ffi::CStr = c"from-board";

#[entry]
fn main() -> ! {
    timer::start();
    let status = match converse() {
        Some(()) => debug::EXIT_SUCCESS,
        None => debug::EXIT_FAILURE,
    };
    loop {
        debug::exit(status);
    }
}

/// Answers requests until the host quits; `None` when the link breaks.
fn converse() -> Option<()> {
    let mut requests = HostFile::open(REQUESTS, host_file::Mode::Read)?;
    let mut replies = HostFile::open(REPLIES, host_file::Mode::Write)?;
    let mut store = flash::store()?;
    let mut responder = Responder::default();
    loop {
        let mut bytes = [0; REQUEST_BYTES];
        requests.read(&mut bytes)?;
        let reply = match Request::decode(&bytes)? {
            Request::Quit => return Some(()),
            Request::Load { length } => {
                let mut buffer = [0; MAX_BYTES];
                responder.load(read_block(&mut requests, length, &mut buffer)?)
            }
            Request::Commit { length } => {
                let mut buffer = [0; MAX_BYTES];
                commit(&mut store, read_block(&mut requests, length, &mut buffer)?)
            }
            Request::Boot => responder.boot(&store.boot()),
            request => responder.answer(request, timer::now),
        };
        replies.write(&reply.encode())?;
    }
}

/// Reads a block of `length` bytes.
fn read_block<'a>(
    requests: &mut HostFile,
    length: u32,
    buffer: &'a mut [u8; MAX_BYTES],
) -> Option<&'a [u8]> {
    let block = buffer.get_mut(..length as usize)?;
    requests.read(block)?;
    Some(block)
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {
        debug::exit(debug::EXIT_FAILURE);
    }
}
