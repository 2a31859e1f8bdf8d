//! Effects that change what the encoder reads.

use super::candidate::{Candidate, free};
use super::typical::Typical;
use crate::fit::Field;

/// All that are tried.
pub fn effects(typical: &Typical) -> Vec<Candidate> {
    let mut all = vec![Candidate::of_one("backlash", free(Field::Gap, [0.0, 0.3], 0.01), 0.01)];
    if typical.bears_load() {
        // Where the joint stands shows by gravity alone.
        let offset = free(Field::EncoderOffset, [-1.0, 1.0], 0.1);
        all.push(Candidate::of_one("encoder_offset", offset, 0.0));
    }
    all
}
