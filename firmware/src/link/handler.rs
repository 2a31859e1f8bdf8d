//! The command handler: bytes of the line in, answers out.
//!
//! Runs outside the tick and never waits for the line. A request is carried out once,
//! however often it comes: a repeated request gets the last answer again.

use heapless::Vec;

use super::answer::{Answer, Parameters, Refusal, Reply};
use super::block_store::BlockStore;
use super::checked::MAX_FRAME_BYTES;
use super::conversation::{Conversation, HandlerConfig, LastRequest};
use super::messages::{ToBoard, ToHost};
use super::request::PIECE_BYTES;
use super::supervisor_access::SupervisorAccess;
use crate::frame::FrameReader;
use crate::supervisor::Order;

/// The board's end of the conversation.
#[derive(Debug)]
pub struct Handler<S> {
    reader: FrameReader,
    conversation: Conversation<S>,
}

impl<S: BlockStore> Handler<S> {
    /// A handler that waits for a Hello.
    pub fn new(store: S, config: &HandlerConfig<'_>) -> Self {
        Self { reader: FrameReader::new(), conversation: Conversation::new(store, config) }
    }

    /// Takes a byte of the line; the frame to send, with its zero, once a request is answered.
    pub fn receive(&mut self, byte: u8, board: &mut impl SupervisorAccess) -> Option<&[u8]> {
        let dropped = self.reader.dropped();
        let content = self.reader.push(byte)?;
        self.conversation.answer(content, dropped, board)
    }

    /// Bytes of the line were lost: the frame that they were in is void.
    pub fn discard(&mut self) {
        self.reader.discard();
    }

    /// Whether telemetry is to be sent.
    pub fn streaming(&self) -> bool {
        self.conversation.streaming
    }

    /// Whether the host was heard since this was asked last.
    pub fn take_heard(&mut self) -> bool {
        core::mem::take(&mut self.conversation.heard)
    }

    /// Tells how many telemetry records could not be sent since power-on.
    pub fn set_telemetry_dropped(&mut self, dropped: u32) {
        self.conversation.telemetry_dropped = dropped;
    }

    /// Stores a new fault, or that there is none any more, for the next boot. Call it now and then.
    ///
    /// Whether the store did it; if not, the next call tries again.
    pub fn store_fault(&mut self, board: &impl SupervisorAccess) -> bool {
        self.conversation.store_fault(board.status().fault)
    }

    /// The parameter block in use, as reported to the host.
    pub fn parameters(&self) -> Option<Parameters> {
        self.conversation.parameters
    }

    /// The store.
    pub fn store(&mut self) -> &mut S {
        &mut self.conversation.store
    }
}

impl<S: BlockStore> Conversation<S> {
    /// The answer to a frame's content; none if it is no message of this build.
    fn answer(
        &mut self,
        content: &[u8],
        dropped: u32,
        board: &mut impl SupervisorAccess,
    ) -> Option<&[u8]> {
        let Ok(message) = ToBoard::read(content) else {
            self.foreign_frames = self.foreign_frames.wrapping_add(1);
            return None;
        };
        let request = match message {
            ToBoard::Hello { .. } => return Some(self.greet()),
            ToBoard::Request(request) => request,
        };
        let request_id =
            LastRequest { number: request.number, checksum: content.last_chunk().copied() };
        match self.last_request {
            None => return Some(self.deny(request.number, Refusal::HelloFirst)),
            Some(Some(last)) if last == request_id => {
                self.heard |= self.was_carried_out;
                return Some(&self.answer);
            }
            Some(Some(last)) if last.number >= request_id.number => {
                if let Some(order) = request.command.stopping_order() {
                    return Some(self.execute_out_of_turn(request.number, order, board));
                }
                let newest = last.number;
                return Some(self.deny(request.number, Refusal::OldNumber { newest }));
            }
            Some(_) => self.last_request = Some(Some(request_id)),
        }
        board.refresh();
        let mut piece = [0; PIECE_BYTES];
        let result = self.execute(&request, dropped, &mut piece, board);
        self.was_carried_out = result.is_ok();
        self.heard |= self.was_carried_out;
        self.requests = self.requests.wrapping_add(u32::from(result.is_ok()));
        write(&ToHost::Answer(Answer { number: request.number, result }), &mut self.answer);
        Some(&self.answer)
    }

    /// Begins a conversation.
    fn greet(&mut self) -> &[u8] {
        self.nonce = None;
        self.last_request = Some(None);
        write(&ToHost::Hello(self.hello), &mut self.answer);
        &self.answer
    }

    /// Stops or disarms, whoever asks and under whatever number; the answer to the last
    /// request is still kept.
    fn execute_out_of_turn(
        &mut self,
        number: u32,
        order: Order,
        board: &mut impl SupervisorAccess,
    ) -> &[u8] {
        let result = board.order(order).map(|()| Reply::Done).map_err(Refusal::from);
        write(&ToHost::Answer(Answer { number, result }), &mut self.out_of_turn_answer);
        &self.out_of_turn_answer
    }

    /// Refuses a request out of its turn; the answer to the last one is still kept.
    fn deny(&mut self, number: u32, why: Refusal) -> &[u8] {
        write(&ToHost::Answer(Answer { number, result: Err(why) }), &mut self.out_of_turn_answer);
        &self.out_of_turn_answer
    }
}

/// Writes a message's frame; every message of the board fits.
fn write(message: &ToHost<'_>, frame: &mut Vec<u8, MAX_FRAME_BYTES>) {
    let mut buffer = [0; MAX_FRAME_BYTES];
    frame.clear();
    let bytes = message.write(&mut buffer).unwrap_or_default();
    // As long as the buffer at most.
    let _ = frame.extend_from_slice(bytes);
}
