//! The host's end of the board's serial line, over a socket, for tests.

use std::io::{ErrorKind, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;

use firmware::checksum::CRC_32C;
use firmware::frame::FrameReader;
use firmware::link::{
    Command, MAX_FRAME_BYTES, PIECE_BYTES, Refusal, Reply, Report, Request, Telemetry, ToBoard,
    ToHost,
};

/// A frame that carries a message to the board.
///
/// # Panics
/// A piece in it is too long.
pub fn frame(message: &ToBoard<'_>) -> Vec<u8> {
    message.write(&mut [0; MAX_FRAME_BYTES]).expect("the message fits").to_vec()
}

/// A request without a proof, as a frame.
pub fn request(number: u32, command: Command<'_>) -> Vec<u8> {
    frame(&ToBoard::Request(Request { number, proof: None, command }))
}

/// The commands that upload an encoded block, in their order, without the last one.
pub fn upload(encoded: &[u8]) -> Vec<Command<'_>> {
    let checksum = CRC_32C.checksum(encoded);
    let begin = Command::UploadBegin { length: encoded.len() as u16, checksum };
    let pieces = encoded
        .chunks(PIECE_BYTES)
        .enumerate()
        .map(|(index, bytes)| Command::UploadPiece { offset: (index * PIECE_BYTES) as u16, bytes });
    std::iter::once(begin).chain(pieces).collect()
}

/// The serial line of a board, as a socket that never blocks.
#[derive(Debug)]
pub struct Line {
    socket: UnixStream,
    waiting: Vec<u8>,
    reader: FrameReader,
    number: u32,
    /// The last record of telemetry.
    pub telemetry: Option<Telemetry>,
    /// Records of telemetry that came.
    pub records: u32,
    /// What the last request brought.
    pub answer: Option<(u32, Result<(), Refusal>)>,
    /// The last report.
    pub report: Option<Report>,
}

impl Line {
    /// Connects to a socket that QEMU has opened.
    ///
    /// # Panics
    /// There is none.
    pub fn connect(path: &Path) -> Self {
        let socket = UnixStream::connect(path).expect("QEMU has opened the socket");
        socket.set_nonblocking(true).expect("a socket can be set so");
        Self {
            socket,
            waiting: Vec::new(),
            reader: FrameReader::new(),
            number: 0,
            telemetry: None,
            records: 0,
            answer: None,
            report: None,
        }
    }

    /// Has bytes sent, as the line takes them.
    pub fn send(&mut self, bytes: &[u8]) {
        self.waiting.extend_from_slice(bytes);
    }

    /// Bytes that the line has not taken yet.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Sends what goes, reads what has come.
    ///
    /// # Panics
    /// The socket is broken.
    pub fn exchange(&mut self) {
        if !self.waiting.is_empty() {
            match self.socket.write(&self.waiting) {
                Ok(length) => drop(self.waiting.drain(..length)),
                Err(error) if error.kind() == ErrorKind::WouldBlock => {}
                Err(error) => panic!("the line broke: {error}"),
            }
        }
        let mut bytes = [0; 4096];
        loop {
            match self.socket.read(&mut bytes) {
                Ok(length) => self.take(&bytes[..length]),
                Err(error) if error.kind() == ErrorKind::WouldBlock => return,
                Err(error) => panic!("the line broke: {error}"),
            }
        }
    }

    fn take(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            match self.reader.push(byte).map(ToHost::read) {
                Some(Ok(ToHost::Telemetry(record))) => {
                    self.telemetry = Some(record);
                    self.records += 1;
                }
                Some(Ok(ToHost::Answer(answer))) => {
                    if let Ok(Reply::Report(report)) = &answer.result {
                        self.report = Some(*report);
                    }
                    self.answer = Some((answer.number, answer.result.map(drop)));
                }
                Some(Ok(ToHost::Hello(_))) => self.answer = Some((0, Ok(()))),
                Some(Err(error)) => panic!("the board sent something else: {error}"),
                None => {}
            }
        }
    }

    /// Says Hello; `tick` keeps the board going until it answers.
    pub fn handshake(&mut self, tick: impl FnMut()) {
        self.number = 0;
        let hello = frame(&ToBoard::Hello { protocol_version: 1 });
        self.send(&hello);
        self.wait(0, tick).expect("a Hello is answered");
    }

    /// Asks and has the answer; `tick` keeps the board going until it comes.
    pub fn request(&mut self, command: Command<'_>, tick: impl FnMut()) -> Result<(), Refusal> {
        self.number += 1;
        let bytes = request(self.number, command);
        self.send(&bytes);
        self.wait(self.number, tick)
    }

    fn wait(&mut self, number: u32, mut tick: impl FnMut()) -> Result<(), Refusal> {
        self.answer = None;
        for _ in 0..200_000 {
            tick();
            self.exchange();
            if let Some((answered, result)) = self.answer.take()
                && answered == number
            {
                return result;
            }
        }
        panic!("no answer to request {number}");
    }
}
