//! What the host asks, again and again until there is an answer.

use firmware::ParameterBlock;
use firmware::link::{Command, Refusal, Report, Request, Source, ToBoard};

use super::{PATIENCE_TICKS, Soak, Told};
use crate::operator::{frame, upload};

impl Soak {
    pub(super) fn upload(&mut self, block: &ParameterBlock, commit: bool) {
        let mut buffer = [0; firmware::block::MAX_BYTES];
        let bytes = block.encode(&mut buffer).expect("the block fits").to_vec();
        for command in upload(&bytes) {
            let taken = self.ask(command);
            assert!(taken.is_ok(), "{taken:?}: {:?}", self.runtime.supervisor.fault());
        }
        self.ask(if commit { Command::Commit } else { Command::Use }).expect("a block is taken");
        self.tally.uploads += 1;
        assert_eq!(self.download(Source::InUse), bytes, "what was acknowledged is in use");
        if commit {
            self.tally.commits += 1;
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
            match self.ask(Command::Download { source, offset }) {
                Ok(Told::Piece(piece)) if piece.is_empty() => return bytes,
                Ok(Told::Piece(piece)) => bytes.extend(piece),
                other => panic!("a download brought {other:?}"),
            }
        }
    }

    pub(super) fn greet(&mut self) {
        self.number = 0;
        self.deliver(0, &frame(&ToBoard::Hello { protocol_version: 1 })).expect("a Hello");
    }

    pub(super) fn report(&mut self) -> Report {
        match self.ask(Command::Query) {
            Ok(Told::Report(report)) => report,
            other => panic!("a query brought {other:?}"),
        }
    }

    /// Asks without waiting for the answer.
    pub(super) fn say(&mut self, command: Command<'_>) {
        self.number += 1;
        let request = Request { number: self.number, proof: None, command };
        self.put(&frame(&ToBoard::Request(request)));
    }

    /// Asks until there is an answer.
    pub(super) fn ask(&mut self, command: Command<'_>) -> Result<Told, Refusal> {
        self.number += 1;
        let request = Request { number: self.number, proof: None, command };
        self.deliver(self.number, &frame(&ToBoard::Request(request)))
    }

    fn deliver(&mut self, number: u32, frame: &[u8]) -> Result<Told, Refusal> {
        for attempt in 0..20 {
            self.tally.asked_again += u64::from(attempt > 0);
            self.put(frame);
            for _ in 0..PATIENCE_TICKS {
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
    fn put(&mut self, frame: &[u8]) {
        self.to_board.push(0);
        frame.iter().for_each(|&byte| self.to_board.push(byte));
    }
}
