//! The simulated robot at the other end of two FIFOs.

use firmware::block::MAX_BYTES;
use firmware::lockstep::{REQUEST_BYTES, Reply, Request, Responder, commit};

use crate::board::Board;
use crate::host_file::{HostFile, Mode};
use crate::timer;

/// Requests come in here.
const REQUESTS: &core::ffi::CStr = c"to-board";
/// Replies go out here.
const REPLIES: &core::ffi::CStr = c"from-board";

/// The link to it.
pub struct Robot {
    requests: HostFile,
    replies: HostFile,
    /// Drives the robot in the supervisor's place once a block was loaded through the FIFO.
    bench: Responder,
}

impl Robot {
    /// Opens the FIFOs; `None` where there are none.
    pub fn connect() -> Option<Self> {
        let requests = HostFile::open(REQUESTS, Mode::Read)?;
        let replies = HostFile::open(REPLIES, Mode::Write)?;
        Some(Self { requests, replies, bench: Responder::default() })
    }

    /// Answers requests until the robot's side quits; `None` when the link breaks.
    pub fn converse(&mut self, board: &mut Board) -> Option<()> {
        loop {
            let mut bytes = [0; REQUEST_BYTES];
            self.requests.read(&mut bytes)?;
            let reply = match Request::decode(&bytes)? {
                Request::Quit => return Some(()),
                Request::Tick(counts) if !self.bench.is_loaded() => board.tick(&counts),
                request => self.answer(request, board)?,
            };
            self.replies.write(&reply.encode())?;
            board.serve_line();
        }
    }

    fn answer(&mut self, request: Request, board: &mut Board) -> Option<Reply> {
        let store = board.runtime.handler.store();
        let mut buffer = [0; MAX_BYTES];
        Some(match request {
            Request::Load { length } => {
                let block = self.block(length, &mut buffer)?;
                self.bench.load(block)
            }
            Request::Commit { length } => commit(store, self.block(length, &mut buffer)?),
            Request::Boot => self.bench.boot(&store.boot()),
            request => self.bench.answer(request, timer::now),
        })
    }

    /// Reads a block of `length` bytes.
    fn block<'a>(&mut self, length: u32, buffer: &'a mut [u8; MAX_BYTES]) -> Option<&'a [u8]> {
        let block = buffer.get_mut(..length as usize)?;
        self.requests.read(block)?;
        Some(block)
    }
}
