//! A conversation with a board: Hello, then requests, each asked until it is answered.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use firmware::frame::FrameReader;

use firmware::link::{
    Command, Hello, Key, MAX_FRAME_BYTES, Nonce, PROTOCOL_VERSION, Refusal, Report, Request,
    Telemetry, ToBoard, ToHost, key, schema,
};

use super::address::Address;
use super::error::LinkError;
use super::port::Port;
use super::told::{Told, name};

/// No answer for so long: ask again.
const ASK_AGAIN: Duration = Duration::from_millis(150);
/// So often is the first Hello said: at a line where nobody is, this is what one waits for.
const HELLO_TRIES: u32 = 14;

/// How long an answer is waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// So often is asked, every 150 ms.
    pub tries: u32,
    /// Once nothing whole at all has come for so long, no longer.
    pub silence: Duration,
}

impl Patience {
    /// As long as a very bad line needs.
    pub const USUAL: Self = Self { tries: 20, silence: Duration::MAX };
    /// While the arm may move: a silent board is one that is gone.
    pub const MOVING: Self = Self { tries: 20, silence: Duration::from_millis(1200) };
    /// Once it is gone.
    pub const SHORT: Self = Self { tries: 2, silence: Duration::MAX };
}

/// What came and is no telemetry.
#[derive(Debug)]
enum Came {
    Hello(Hello),
    Answer(u32, Result<Told, Refusal>),
}

/// What the host has counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Bytes that came.
    pub bytes: u64,
    /// Requests that were asked again.
    pub asked_again: u64,
    /// Frames that were broken or no message.
    pub broken: u64,
}

/// The host's end of a conversation.
#[derive(Debug)]
pub struct Client {
    port: Port,
    name: String,
    reader: FrameReader,
    hello: Hello,
    key: Option<Key>,
    nonce: Option<Nonce>,
    number: u32,
    came: VecDeque<Came>,
    records: Vec<Telemetry>,
    tally: Tally,
    patience: Patience,
    heard: Instant,
}

impl Client {
    /// Opens the line and says Hello.
    ///
    /// # Errors
    /// No line, no board, or one of another build.
    pub fn connect(address: &Address, key: Option<Key>) -> Result<Self, LinkError> {
        let name = address.to_string();
        let port =
            Port::open(address).map_err(|source| LinkError::Open { port: name.clone(), source })?;
        let mut client = Self {
            port,
            name,
            reader: FrameReader::new(),
            hello: Hello::of_this_build(""),
            key,
            nonce: None,
            number: 0,
            came: VecDeque::new(),
            records: Vec::new(),
            tally: Tally::default(),
            patience: Patience::USUAL,
            heard: Instant::now(),
        };
        client.greet()?;
        Ok(client)
    }

    /// Begins the conversation anew, as after a reset of the board.
    ///
    /// # Errors
    /// No board, or one of another build.
    pub fn greet(&mut self) -> Result<(), LinkError> {
        let frame = frame(&ToBoard::Hello { protocol_version: PROTOCOL_VERSION });
        let tries = self.patience.tries.min(HELLO_TRIES);
        let hello = self.until("Hello", &frame, tries, |came| match came {
            Came::Hello(hello) => Some(hello),
            Came::Answer(..) => None,
        })?;
        (self.hello, self.nonce, self.number) = (hello, None, 0);
        if hello.protocol_version != PROTOCOL_VERSION {
            return Err(LinkError::OtherProtocol(Box::new(hello)));
        }
        match hello.schema_hash == schema::HASH {
            true => Ok(()),
            false => Err(LinkError::OtherMessages(Box::new(hello))),
        }
    }

    /// The board's Hello.
    pub fn hello(&self) -> &Hello {
        &self.hello
    }

    /// The line's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What was counted.
    pub fn tally(&self) -> Tally {
        Tally { broken: self.tally.broken + u64::from(self.reader.dropped()), ..self.tally }
    }

    /// From now on answers are waited for so long.
    pub fn set_patience(&mut self, patience: Patience) {
        self.patience = patience;
    }

    /// Asks until there is an answer; telemetry that comes meanwhile is kept.
    ///
    /// # Errors
    /// The line is broken, the board is silent, or it says no.
    pub fn ask(&mut self, command: Command<'_>) -> Result<Told, LinkError> {
        let nonce = match self.key {
            Some(_) if command.needs_proof() => Some(self.challenged()?),
            _ => None,
        };
        self.number += 1;
        let number = self.number;
        let proof = self.key.zip(nonce);
        let proof = proof.and_then(|(key, nonce)| key::proof(&key, &nonce, number, &command));
        let frame = frame(&ToBoard::Request(Request { number, proof, command }));
        let what = name(&command);
        let result = self.until(what, &frame, self.patience.tries, |came| match came {
            Came::Answer(answered, result) if answered == number => Some(result),
            _ => None,
        })?;
        if matches!(command, Command::SetKey { .. }) {
            self.nonce = None;
        }
        result.map_err(|why| LinkError::Refused { what, why: Box::new(why) })
    }

    /// Asks what is answered by nothing but that it is done.
    ///
    /// # Errors
    /// As of [`Client::ask`].
    pub fn order(&mut self, command: Command<'_>) -> Result<(), LinkError> {
        match self.ask(command)? {
            Told::Done => Ok(()),
            _ => Err(LinkError::OtherAnswer(name(&command))),
        }
    }

    /// How the board is; also the host's sign of life.
    ///
    /// # Errors
    /// As of [`Client::ask`].
    pub fn report(&mut self) -> Result<Report, LinkError> {
        match self.ask(Command::Query)? {
            Told::Report(report) => Ok(*report),
            _ => Err(LinkError::OtherAnswer(name(&Command::Query))),
        }
    }

    /// Takes another key, once the board has it.
    pub fn use_key(&mut self, key: Option<Key>) {
        (self.key, self.nonce) = (key, None);
    }

    /// Reads what has come; waits a few milliseconds if nothing has.
    ///
    /// # Errors
    /// The line is broken.
    pub fn listen(&mut self) -> Result<(), LinkError> {
        let mut buffer = [0; 4096];
        let received = self.port.receive(&mut buffer);
        let length = received.map_err(|source| self.broke(source))?;
        self.tally.bytes += length as u64;
        for &byte in &buffer[..length] {
            match self.reader.push(byte).map(ToHost::read) {
                None => continue,
                Some(Err(_)) => {
                    self.tally.broken += 1;
                    continue;
                }
                Some(Ok(ToHost::Telemetry(record))) => self.records.push(record),
                Some(Ok(ToHost::Hello(hello))) => self.came.push_back(Came::Hello(hello)),
                Some(Ok(ToHost::Answer(answer))) => {
                    let result = answer.result.map(Told::from);
                    self.came.push_back(Came::Answer(answer.number, result));
                }
            }
            self.heard = Instant::now();
        }
        Ok(())
    }

    /// The telemetry that has come since this was asked last.
    pub fn take_records(&mut self) -> Vec<Telemetry> {
        std::mem::take(&mut self.records)
    }

    fn challenged(&mut self) -> Result<Nonce, LinkError> {
        if let Some(nonce) = self.nonce {
            return Ok(nonce);
        }
        match self.ask(Command::Challenge)? {
            Told::Challenge(nonce) => {
                self.nonce = Some(nonce);
                Ok(nonce)
            }
            _ => Err(LinkError::OtherAnswer(name(&Command::Challenge))),
        }
    }

    /// Sends a frame, unchanged, until what is wanted has come.
    fn until<T>(
        &mut self,
        what: &'static str,
        frame: &[u8],
        tries: u32,
        mut wanted: impl FnMut(Came) -> Option<T>,
    ) -> Result<T, LinkError> {
        let (begin, bytes_before) = (Instant::now(), self.tally.bytes);
        let mut asked = 0;
        self.came.clear();
        self.heard = begin;
        while asked < tries && self.heard.elapsed() < self.patience.silence {
            self.tally.asked_again += u64::from(asked > 0);
            self.send(frame)?;
            asked += 1;
            let sent = Instant::now();
            while sent.elapsed() < ASK_AGAIN {
                self.listen()?;
                while let Some(came) = self.came.pop_front() {
                    if let Some(found) = wanted(came) {
                        return Ok(found);
                    }
                }
            }
        }
        Err(LinkError::Silent {
            port: self.name.clone(),
            what,
            tries: asked,
            waited_s: begin.elapsed().as_secs_f64(),
            bytes: self.tally.bytes - bytes_before,
        })
    }

    /// A zero first ends whatever noise has begun.
    fn send(&mut self, frame: &[u8]) -> Result<(), LinkError> {
        let sent = self.port.send(&[&[0], frame].concat());
        sent.map_err(|source| self.broke(source))
    }

    fn broke(&self, source: std::io::Error) -> LinkError {
        LinkError::Broke { port: self.name.clone(), source }
    }
}

/// A message's frame; empty, which nobody answers, if a piece in it is too long.
fn frame(message: &ToBoard<'_>) -> Vec<u8> {
    let mut buffer = [0; MAX_FRAME_BYTES];
    message.write(&mut buffer).unwrap_or_default().to_vec()
}
