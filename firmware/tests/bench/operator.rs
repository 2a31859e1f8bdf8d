//! A host of few words, for tests of the board's end of the line.

use firmware::ParameterBlock;
use firmware::block::MAX_BYTES;
use firmware::checksum::CRC_32C;
use firmware::frame::FrameReader;
use firmware::link::{
    Command, Handler, HandlerConfig, Key, MAX_FRAME_BYTES, Nonce, PIECE_BYTES, Refusal, Reply,
    Report, Request, Source, ToBoard, ToHost, key,
};
use firmware::supervisor::{BootReport, Health, Supervisor};

use super::memory_store::MemoryStore;

/// A board with its link, and the host's side of the conversation.
pub struct Bench {
    pub handler: Handler<MemoryStore>,
    pub supervisor: Supervisor,
    pub number: u32,
    pub key: Option<Key>,
    pub nonce: Nonce,
}

/// A reply without what it borrows.
#[derive(Clone, Debug, PartialEq)]
pub enum Owned {
    Done,
    Report(Report),
    Challenge(Nonce),
    Piece(Vec<u8>),
    InUse,
}

/// An encoded block.
pub fn encoded(block: &ParameterBlock) -> Vec<u8> {
    let mut buffer = [0; MAX_BYTES];
    block.encode(&mut buffer).unwrap().to_vec()
}

/// The frame of a request.
pub fn frame(request: Request<'_>) -> Vec<u8> {
    ToBoard::Request(request).write(&mut [0; MAX_FRAME_BYTES]).unwrap().to_vec()
}

/// The number and the result in an answer's frame.
pub fn read_answer(frame: &[u8]) -> (u32, Result<Owned, Refusal>) {
    let mut reader = FrameReader::new();
    let content = frame.iter().find_map(|&byte| reader.push(byte).map(<[u8]>::to_vec)).unwrap();
    let Ok(ToHost::Answer(answer)) = ToHost::read(&content) else { panic!("{content:?}") };
    let result = answer.result.map(|reply| match reply {
        Reply::Done => Owned::Done,
        Reply::Report(report) => Owned::Report(report),
        Reply::Challenge { nonce } => Owned::Challenge(nonce),
        Reply::Piece { bytes, .. } => Owned::Piece(bytes.to_vec()),
        Reply::InUse(_) => Owned::InUse,
    });
    (answer.number, result)
}

impl Bench {
    /// A board just booted, without parameters, greeted.
    pub fn new(key: Option<Key>) -> Self {
        let store = MemoryStore { key, ..MemoryStore::default() };
        Self::with_store(store, Supervisor::default(), [7; 16])
    }

    /// A board just booted with this store.
    pub fn with_store(store: MemoryStore, mut supervisor: Supervisor, seed: [u8; 16]) -> Self {
        let config = HandlerConfig {
            board: "test",
            limits: Default::default(),
            nonce_seed: seed,
            key: store.key,
            fault: store.fault,
            in_use: None,
        };
        supervisor.booted(BootReport { latched: store.fault, ..BootReport::default() });
        let (key, handler) = (store.key, Handler::new(store, &config));
        let mut bench = Self { handler, supervisor, number: 0, key, nonce: [0; 16] };
        bench.greet();
        bench
    }

    /// Sends bytes; the frames that come back.
    pub fn send(&mut self, line: &[u8]) -> Vec<Vec<u8>> {
        let mut answers = Vec::new();
        for &byte in line {
            if let Some(frame) = self.handler.receive(byte, &mut self.supervisor) {
                answers.push(frame.to_vec());
            }
        }
        answers
    }

    /// Begins a conversation, with a challenge where there is a key.
    pub fn greet(&mut self) {
        let hello = ToBoard::Hello { protocol_version: 1 };
        let line = hello.write(&mut [0; MAX_FRAME_BYTES]).unwrap().to_vec();
        assert_eq!(self.send(&line).len(), 1);
        self.number = 0;
        if self.key.is_some() {
            let Ok(Owned::Challenge(nonce)) = self.ask(Command::Challenge) else { panic!() };
            self.nonce = nonce;
        }
    }

    /// The next request, proven where there is a key.
    pub fn request<'a>(&mut self, command: Command<'a>) -> Request<'a> {
        self.number += 1;
        let number = self.number;
        let proof = self.key.and_then(|key| key::proof(&key, &self.nonce, number, &command));
        Request { number, proof, command }
    }

    /// Asks and has the answer.
    pub fn ask(&mut self, command: Command<'_>) -> Result<Owned, Refusal> {
        let request = self.request(command);
        let answers = self.send(&frame(request));
        assert_eq!(answers.len(), 1);
        let (number, result) = read_answer(&answers[0]);
        assert_eq!(number, request.number);
        result
    }

    pub fn report(&mut self) -> Report {
        match self.ask(Command::Query) {
            Ok(Owned::Report(report)) => report,
            other => panic!("{other:?}"),
        }
    }

    /// Sends an encoded block, without its end.
    pub fn send_block(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let checksum = CRC_32C.checksum(bytes);
        self.ask(Command::UploadBegin { length: bytes.len() as u16, checksum })?;
        for (index, piece) in bytes.chunks(PIECE_BYTES).enumerate() {
            let offset = (index * PIECE_BYTES) as u16;
            self.ask(Command::UploadPiece { offset, bytes: piece })?;
        }
        Ok(())
    }

    /// Sends a block and has it used, or stored too.
    pub fn upload(&mut self, bytes: &[u8], end: Command<'_>) -> Result<Owned, Refusal> {
        self.send_block(bytes)?;
        self.ask(end)
    }

    pub fn download(&mut self, source: Source) -> Result<Vec<u8>, Refusal> {
        let mut bytes = Vec::new();
        loop {
            match self.ask(Command::Download { source, offset: bytes.len() as u16 })? {
                Owned::Piece(piece) if piece.is_empty() => return Ok(bytes),
                Owned::Piece(piece) => bytes.extend(piece),
                other => panic!("{other:?}"),
            }
        }
    }

    /// Ticks at rest.
    pub fn stand(&mut self, ticks: u32) {
        for _ in 0..ticks {
            let host_heard = self.handler.take_heard();
            self.supervisor.tick(&[0; 3], Health { host_heard, ..Health::default() });
            assert!(self.handler.store_fault(&self.supervisor));
        }
    }
}
