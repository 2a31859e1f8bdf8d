//! Frames over an open line: what is sent, what comes, and what the host counts of it.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use firmware::frame::FrameReader;
use firmware::link::{Hello, Refusal, Telemetry, ToHost};

use super::address::Address;
use super::error::LinkError;
use super::port::Port;
use super::reply::OwnedReply;

/// Without an answer for so long, a request is sent again.
const RETRY_PERIOD: Duration = Duration::from_millis(150);

/// How long an answer is waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RetryPolicy {
    /// How often a request is sent at most, every 150 ms.
    pub attempts: u32,
    /// No further attempt once no valid frame at all has come for so long.
    pub max_silence: Duration,
}

impl RetryPolicy {
    /// As long as a very bad line needs.
    pub const DEFAULT: Self = Self { attempts: 20, max_silence: Duration::MAX };
    /// While the arm may move: a silent board is taken for lost.
    pub const WHILE_MOVING: Self = Self { attempts: 20, max_silence: Duration::from_millis(1200) };
    /// Once the link is lost.
    pub const LAST_ATTEMPT: Self = Self { attempts: 2, max_silence: Duration::MAX };
}

/// A message that came and is no telemetry.
#[derive(Debug)]
pub(super) enum Received {
    Hello(Hello),
    Answer(u32, Result<OwnedReply, Refusal>),
}

/// What the host has counted on the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LineCounters {
    /// Bytes received.
    pub bytes: u64,
    /// Requests sent again.
    pub retries: u64,
    /// Frames that were damaged or no message.
    pub broken_frames: u64,
}

/// An open line with the frames on it.
#[derive(Debug)]
pub(super) struct Connection {
    pub(super) name: String,
    /// Telemetry that nobody has taken yet.
    pub(super) records: Vec<Telemetry>,
    port: Port,
    reader: FrameReader,
    received: VecDeque<Received>,
    counters: LineCounters,
    last_frame_at: Instant,
}

impl Connection {
    pub(super) fn open(address: &Address) -> Result<Self, LinkError> {
        let name = address.to_string();
        let port =
            Port::open(address).map_err(|source| LinkError::Open { port: name.clone(), source })?;
        Ok(Self {
            port,
            name,
            reader: FrameReader::new(),
            received: VecDeque::new(),
            records: Vec::new(),
            counters: LineCounters::default(),
            last_frame_at: Instant::now(),
        })
    }

    pub(super) fn counters(&self) -> LineCounters {
        let broken_frames = self.counters.broken_frames + u64::from(self.reader.dropped());
        LineCounters { broken_frames, ..self.counters }
    }

    /// Reads what has come; waits a few milliseconds if nothing has.
    pub(super) fn receive(&mut self) -> Result<(), LinkError> {
        let mut buffer = [0; 4096];
        let received = self.port.receive(&mut buffer);
        let length = received.map_err(|source| self.line_error(source))?;
        self.counters.bytes += length as u64;
        for &byte in &buffer[..length] {
            match self.reader.push(byte).map(ToHost::read) {
                None => continue,
                Some(Err(_)) => {
                    self.counters.broken_frames += 1;
                    continue;
                }
                Some(Ok(ToHost::Telemetry(record))) => self.records.push(record),
                Some(Ok(ToHost::Hello(hello))) => self.received.push_back(Received::Hello(hello)),
                Some(Ok(ToHost::Answer(answer))) => {
                    let result = answer.result.map(OwnedReply::from);
                    self.received.push_back(Received::Answer(answer.number, result));
                }
            }
            self.last_frame_at = Instant::now();
        }
        Ok(())
    }

    /// Sends a frame, the same at every attempt, until `accept` takes a message.
    pub(super) fn request<T>(
        &mut self,
        what: &'static str,
        frame: &[u8],
        policy: RetryPolicy,
        mut accept: impl FnMut(Received) -> Option<T>,
    ) -> Result<T, LinkError> {
        let (begin, bytes_before) = (Instant::now(), self.counters.bytes);
        let mut attempts = 0;
        self.received.clear();
        self.last_frame_at = begin;
        while attempts < policy.attempts && self.last_frame_at.elapsed() < policy.max_silence {
            self.counters.retries += u64::from(attempts > 0);
            self.send(frame)?;
            attempts += 1;
            let sent = Instant::now();
            while sent.elapsed() < RETRY_PERIOD {
                self.receive()?;
                while let Some(message) = self.received.pop_front() {
                    if let Some(accepted) = accept(message) {
                        return Ok(accepted);
                    }
                }
            }
        }
        Err(LinkError::NoAnswer {
            port: self.name.clone(),
            what,
            attempts,
            waited_s: begin.elapsed().as_secs_f64(),
            bytes: self.counters.bytes - bytes_before,
        })
    }

    /// Sends a frame; a zero before it ends whatever line noise has begun.
    fn send(&mut self, frame: &[u8]) -> Result<(), LinkError> {
        let sent = self.port.send(&[&[0], frame].concat());
        sent.map_err(|source| self.line_error(source))
    }

    fn line_error(&self, source: std::io::Error) -> LinkError {
        LinkError::Line { port: self.name.clone(), source }
    }
}
