//! Effects that change what the encoder reads.

use super::candidate::{Candidate, free};
use super::typical::Typical;
use crate::fit::Field;

fn play() -> Candidate {
    let gap = free(Field::Gap, [0.0, 0.3], 0.01);
    Candidate::new("backlash", vec![gap], vec![vec![0.002], vec![0.01]])
}

/// All that are tried.
pub fn effects(typical: &Typical) -> Vec<Candidate> {
    let mut all = vec![play()];
    if typical.bears_load() {
        // Where the joint stands shows by gravity alone.
        let offset = free(Field::EncoderOffset, [-1.0, 1.0], 0.1);
        all.push(Candidate::of_one("encoder_offset", offset, 0.0));
    }
    all
}
