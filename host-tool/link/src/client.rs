//! A conversation with a board: Hello, then numbered requests, each repeated until answered.

use firmware::link::{
    Command, Hello, Key, MAX_FRAME_BYTES, Nonce, PROTOCOL_VERSION, Report, Request, Telemetry,
    ToBoard, key, schema,
};

use super::address::Address;
use super::connection::{Connection, LineCounters, Received, RetryPolicy};
use super::error::LinkError;
use super::reply::{OwnedReply, command_name};

/// Attempts of the first Hello: where no board is connected, this is what one waits for.
const HELLO_ATTEMPTS: u32 = 14;

/// The host's end of a conversation.
#[derive(Debug)]
pub struct Client {
    connection: Connection,
    policy: RetryPolicy,
    hello: Hello,
    key: Option<Key>,
    nonce: Option<Nonce>,
    /// Number of the last request.
    number: u32,
}

impl Client {
    /// Opens the line and exchanges Hellos.
    ///
    /// # Errors
    /// No line, no board, or a board of another build.
    pub fn connect(address: &Address, key: Option<Key>) -> Result<Self, LinkError> {
        let mut client = Self {
            connection: Connection::open(address)?,
            policy: RetryPolicy::DEFAULT,
            hello: Hello::of_this_build(""),
            key,
            nonce: None,
            number: 0,
        };
        client.handshake()?;
        Ok(client)
    }

    /// Begins the conversation again, as after a reset of the board.
    ///
    /// # Errors
    /// No board, or one of another build.
    pub fn handshake(&mut self) -> Result<(), LinkError> {
        let frame = frame(&ToBoard::Hello { protocol_version: PROTOCOL_VERSION });
        let attempts = self.policy.attempts.min(HELLO_ATTEMPTS);
        let policy = RetryPolicy { attempts, ..self.policy };
        let hello = self.connection.request("Hello", &frame, policy, |message| match message {
            Received::Hello(hello) => Some(hello),
            Received::Answer(..) => None,
        })?;
        (self.hello, self.nonce, self.number) = (hello, None, 0);
        if hello.protocol_version != PROTOCOL_VERSION {
            return Err(LinkError::ProtocolMismatch(Box::new(hello)));
        }
        match hello.schema_hash == schema::HASH {
            true => Ok(()),
            false => Err(LinkError::SchemaMismatch(Box::new(hello))),
        }
    }

    /// The board's Hello.
    pub fn hello(&self) -> &Hello {
        &self.hello
    }

    /// The line's name.
    pub fn name(&self) -> &str {
        &self.connection.name
    }

    /// What was counted on the line.
    pub fn counters(&self) -> LineCounters {
        self.connection.counters()
    }

    /// How long answers are waited for from now on.
    pub fn set_retry_policy(&mut self, policy: RetryPolicy) {
        self.policy = policy;
    }

    /// Sends a request until it is answered; telemetry that comes meanwhile is kept.
    ///
    /// # Errors
    /// The line is broken, the board does not answer, or it refuses.
    pub fn request(&mut self, command: Command<'_>) -> Result<OwnedReply, LinkError> {
        let nonce = match self.key {
            Some(_) if command.needs_proof() => Some(self.nonce()?),
            _ => None,
        };
        self.number += 1;
        let number = self.number;
        let proof = self.key.zip(nonce);
        let proof = proof.and_then(|(key, nonce)| key::proof(&key, &nonce, number, &command));
        let frame = frame(&ToBoard::Request(Request { number, proof, command }));
        let what = command_name(&command);
        let result =
            self.connection.request(what, &frame, self.policy, |message| match message {
                Received::Answer(answered, result) if answered == number => Some(result),
                _ => None,
            })?;
        if matches!(command, Command::SetKey { .. }) {
            self.nonce = None;
        }
        result.map_err(|why| LinkError::Refused { what, why: Box::new(why) })
    }

    /// A request whose only answer is that it was carried out.
    ///
    /// # Errors
    /// As of [`Client::request`].
    pub fn execute(&mut self, command: Command<'_>) -> Result<(), LinkError> {
        match self.request(command)? {
            OwnedReply::Done => Ok(()),
            _ => Err(LinkError::UnexpectedAnswer(command_name(&command))),
        }
    }

    /// The board's state; the request also keeps a run alive.
    ///
    /// # Errors
    /// As of [`Client::request`].
    pub fn report(&mut self) -> Result<Report, LinkError> {
        match self.request(Command::Query)? {
            OwnedReply::Report(report) => Ok(*report),
            _ => Err(LinkError::UnexpectedAnswer(command_name(&Command::Query))),
        }
    }

    /// Takes another key, once the board has it.
    pub fn set_key(&mut self, key: Option<Key>) {
        (self.key, self.nonce) = (key, None);
    }

    /// Reads what has come; waits a few milliseconds if nothing has.
    ///
    /// # Errors
    /// The line is broken.
    pub fn receive(&mut self) -> Result<(), LinkError> {
        self.connection.receive()
    }

    /// The telemetry received since the last call.
    pub fn take_records(&mut self) -> Vec<Telemetry> {
        std::mem::take(&mut self.connection.records)
    }

    fn nonce(&mut self) -> Result<Nonce, LinkError> {
        if let Some(nonce) = self.nonce {
            return Ok(nonce);
        }
        match self.request(Command::Challenge)? {
            OwnedReply::Challenge(nonce) => {
                self.nonce = Some(nonce);
                Ok(nonce)
            }
            _ => Err(LinkError::UnexpectedAnswer(command_name(&Command::Challenge))),
        }
    }
}

/// A message's frame; empty, which nobody answers, if a piece in it is too long.
fn frame(message: &ToBoard<'_>) -> Vec<u8> {
    let mut buffer = [0; MAX_FRAME_BYTES];
    message.write(&mut buffer).unwrap_or_default().to_vec()
}
