//! What the host asks, again and again until there is an answer.

use firmware::ParameterBlock;
use firmware::link::{Command, Refusal, Report, Request, Source, ToBoard};

use super::reply::OwnedReply;
use super::{HEARTBEAT_TICKS, RETRY_TICKS, Soak};
use crate::operator::{frame, upload};

impl Soak {
    pub(super) fn upload(&mut self, block: &ParameterBlock, commit: bool) {
        let mut buffer = [0; firmware::block::MAX_BYTES];
        let bytes = block.encode(&mut buffer).expect("the block fits").to_vec();
        for command in upload(&bytes) {
            let taken = self.request(command);
            assert!(taken.is_ok(), "{taken:?}: {:?}", self.runtime.supervisor.fault());
        }
        self.request(if commit { Command::Commit } else { Command::Use })
            .expect("a block is taken");
        self.counters.uploads += 1;
        assert_eq!(self.download(Source::InUse), bytes, "what was acknowledged is in use");
        if commit {
            self.counters.commits += 1;
            self.committed = Some(bytes);
        }
        if let Some(committed) = self.committed.clone() {
            assert_eq!(self.download(Source::Stored), committed, "and what was committed stays");
        }
    }

    fn download(&mut self, source: Source) -> Vec<u8> {
        let mut bytes = Vec::new();
        loop {
            let offset = bytes.len() as u16;
            match self.request(Command::Download { source, offset }) {
                Ok(OwnedReply::Piece(piece)) if piece.is_empty() => return bytes,
                Ok(OwnedReply::Piece(piece)) => bytes.extend(piece),
                other => panic!("a download brought {other:?}"),
            }
        }
    }

    pub(super) fn handshake(&mut self) {
        self.number = 0;
        self.deliver(0, &frame(&ToBoard::Hello { protocol_version: 1 })).expect("a Hello");
    }

    pub(super) fn report(&mut self) -> Report {
        match self.request(Command::Query) {
            Ok(OwnedReply::Report(report)) => report,
            other => panic!("a query brought {other:?}"),
        }
    }

    /// Asks without waiting for the answer.
    pub(super) fn send_without_answer(&mut self, command: Command<'_>) {
        self.number += 1;
        let request = Request { number: self.number, proof: None, command };
        self.push_frame(&frame(&ToBoard::Request(request)));
    }

    /// The host's sign of life in a run.
    pub(super) fn send_heartbeat_when_due(&mut self) {
        if self.counters.ticks.is_multiple_of(HEARTBEAT_TICKS) {
            self.send_without_answer(Command::Query);
        }
    }

    /// Asks until there is an answer.
    pub(super) fn request(&mut self, command: Command<'_>) -> Result<OwnedReply, Refusal> {
        self.number += 1;
        let request = Request { number: self.number, proof: None, command };
        self.deliver(self.number, &frame(&ToBoard::Request(request)))
    }

    fn deliver(&mut self, number: u32, frame: &[u8]) -> Result<OwnedReply, Refusal> {
        for attempt in 0..20 {
            self.counters.retries += u64::from(attempt > 0);
            self.push_frame(frame);
            for _ in 0..RETRY_TICKS {
                self.tick();
                match self.answer.take() {
                    Some((answered, result)) if answered == number => return result,
                    _ => {}
                }
            }
        }
        panic!("no answer to request {number}");
    }

    /// A zero first ends whatever noise has begun.
    fn push_frame(&mut self, frame: &[u8]) {
        self.to_board.push(0);
        frame.iter().for_each(|&byte| self.to_board.push(byte));
    }
}
