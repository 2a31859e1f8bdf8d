//! The firmware's library in this process: the same codes as on the board, faster.

use firmware::block::MAX_BYTES;
use firmware::lockstep::{Reply, Request, Responder};
use firmware::{BlockError, ParameterBlock};

use super::{Board, BoardError};

/// The control firmware, compiled for the host.
#[derive(Debug, Default)]
pub struct InProcess {
    responder: Responder,
}

impl Board for InProcess {
    fn load(&mut self, block: &ParameterBlock) -> Result<(), BoardError> {
        self.responder.load(&encoded(block)?);
        Ok(())
    }

    fn start(&mut self) -> Result<(), BoardError> {
        accepted(self.responder.answer(Request::Start, || 0), "start")?;
        Ok(())
    }

    fn tick(&mut self, counts: &[i32; 3]) -> Result<Reply, BoardError> {
        accepted(self.responder.answer(Request::Tick(*counts), || 0), "tick")
    }
}

/// The block as bytes, checked here as the board will check it, so that its refusal has words.
pub(super) fn encoded(block: &ParameterBlock) -> Result<Vec<u8>, BoardError> {
    block.check().map_err(|error| BoardError::Block(BlockError::Parameter(error)))?;
    let mut buffer = [0; MAX_BYTES];
    let bytes = block.encode(&mut buffer).map_err(BoardError::Block)?;
    Ok(bytes.to_vec())
}

/// A reply that accepts, or an error that names the request.
pub(super) fn accepted(reply: Reply, request: &'static str) -> Result<Reply, BoardError> {
    if reply.accepted { Ok(reply) } else { Err(BoardError::Refused(request)) }
}
