//! The host's end of the serial line, in the board's own time, for tests.

use firmware::checksum::CRC_32C;
use firmware::frame::FrameReader;
use firmware::link::{
    Command, MAX_FRAME_BYTES, PIECE_BYTES, Refusal, Reply, Report, Request, Telemetry, ToBoard,
    ToHost,
};

use crate::failure::Failure;
use crate::machine::Machine;
use crate::registers::MS;

/// Longest wait for an answer [ms]; a commit erases a page and writes 250 double words.
const ANSWERED_WITHIN_MS: u64 = 1000;

/// A board that was reset in the middle of a frame spoils the first answer after it.
const HELLOS: u32 = 2;

/// Talks to a board that executes its image.
pub struct Operator {
    /// The board.
    pub machine: Machine,
    reader: FrameReader,
    number: u32,
    answer: Option<(u32, Result<(), Refusal>)>,
    /// Records of telemetry that came.
    pub telemetry: Vec<Telemetry>,
    /// The last report.
    pub report: Option<Report>,
    /// Frames that were none of the board's.
    pub strange: u64,
}

/// What a request came to.
pub type Answer = Option<Result<(), Refusal>>;

impl Operator {
    /// At a board.
    pub fn new(machine: Machine) -> Self {
        Self {
            machine,
            reader: FrameReader::new(),
            number: 0,
            answer: None,
            telemetry: Vec::new(),
            report: None,
            strange: 0,
        }
    }

    /// Lets the board run [ms].
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn run_ms(&mut self, ms: u64) -> Result<(), Failure> {
        for _ in 0..ms {
            let end = self.machine.board().now + MS;
            self.machine.run_until(end)?;
            self.listen();
        }
        Ok(())
    }

    /// Bytes for the board, as they are.
    pub fn send(&mut self, bytes: &[u8]) {
        self.machine.board().lpuart.incoming.extend(bytes);
    }

    fn listen(&mut self) {
        let bytes = std::mem::take(&mut self.machine.board().lpuart.outgoing);
        for byte in bytes {
            match self.reader.push(byte).map(ToHost::read) {
                Some(Ok(ToHost::Telemetry(record))) => self.telemetry.push(record),
                Some(Ok(ToHost::Answer(answer))) => {
                    if let Ok(Reply::Report(report)) = &answer.result {
                        self.report = Some(*report);
                    }
                    self.answer = Some((answer.number, answer.result.map(drop)));
                }
                Some(Ok(ToHost::Hello(_))) => self.answer = Some((0, Ok(()))),
                Some(Err(_)) => self.strange += 1,
                None => {}
            }
        }
    }

    /// Says Hello; whether it was answered.
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn hello(&mut self) -> Result<bool, Failure> {
        self.number = 0;
        let hello = frame(&ToBoard::Hello { protocol_version: 1 });
        for _ in 0..HELLOS {
            self.send(&hello);
            if self.wait(0)?.is_some() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Asks, and has the answer; none where none came.
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn ask(&mut self, command: Command<'_>) -> Result<Answer, Failure> {
        self.number += 1;
        let number = self.number;
        let request = Request { number, proof: None, command };
        self.send(&frame(&ToBoard::Request(request)));
        self.wait(number)
    }

    /// Uploads an encoded block, up to the last command.
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn upload(&mut self, encoded: &[u8]) -> Result<Answer, Failure> {
        let checksum = CRC_32C.checksum(encoded);
        let mut answer =
            self.ask(Command::UploadBegin { length: encoded.len() as u16, checksum })?;
        for (index, bytes) in encoded.chunks(PIECE_BYTES).enumerate() {
            let offset = (index * PIECE_BYTES) as u16;
            answer = self.ask(Command::UploadPiece { offset, bytes })?;
        }
        Ok(answer)
    }

    /// The board's report.
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn query(&mut self) -> Result<Option<Report>, Failure> {
        self.report = None;
        self.ask(Command::Query)?;
        Ok(self.report)
    }

    fn wait(&mut self, number: u32) -> Result<Answer, Failure> {
        self.answer = None;
        for _ in 0..ANSWERED_WITHIN_MS {
            self.run_ms(1)?;
            if let Some((answered, result)) = self.answer.take()
                && answered == number
            {
                return Ok(Some(result));
            }
        }
        Ok(None)
    }
}

/// A frame that carries a message to the board; one that is too long is empty.
fn frame(message: &ToBoard<'_>) -> Vec<u8> {
    message.write(&mut [0; MAX_FRAME_BYTES]).unwrap_or_default().to_vec()
}
