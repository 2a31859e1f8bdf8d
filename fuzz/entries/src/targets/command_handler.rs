//! Whole conversations with a board: its line, handler, supervisor and store.
//!
//! The bytes are read as pieces, each begun by a byte for what it is and one for its length:
//! bytes of the line as they are, a request or a Hello with a checksum that fits, or ticks.

use firmware::link::checked::{Kind, seal};
use firmware::link::{Beginning, Handler, Kept, MAX_FRAME_BYTES};
use firmware::store::{Layout, RamFlash, Store};
use firmware::supervisor::{BootReport, Health, Supervisor};

const LAYOUT: Layout = Layout::G474;
/// Bytes of a store.
pub const BANK_BYTES: usize = LAYOUT.used_bytes() as usize;

type MemoryStore = Store<RamFlash<Vec<u8>>>;

/// Has the conversation.
pub fn run(bytes: &[u8]) {
    let Some((&first, rest)) = bytes.split_first() else { return };
    let mut store = Store::new(RamFlash::new(vec![0xFF; BANK_BYTES]), LAYOUT.bank_start, LAYOUT);
    let kept = Kept::of(&mut store);
    let key = (first & 1 == 1).then_some([0x5A; 32]);
    let beginning = Beginning {
        board: "fuzz",
        limits: Default::default(),
        nonce_seed: [first; 16],
        key,
        fault: kept.fault,
        in_use: None,
    };
    let mut supervisor = Supervisor::default();
    supervisor.booted(BootReport { latched: kept.fault, ..BootReport::default() });
    let mut handler = Handler::new(store, &beginning);
    converse(&mut handler, &mut supervisor, rest);
}

fn converse(handler: &mut Handler<MemoryStore>, supervisor: &mut Supervisor, mut bytes: &[u8]) {
    while let [what, length, rest @ ..] = bytes {
        let (piece, behind) = rest.split_at(rest.len().min(usize::from(*length)));
        bytes = behind;
        match what % 4 {
            0 => say(handler, supervisor, piece),
            1 => say_sealed(handler, supervisor, Kind::Request, piece),
            2 => say_sealed(handler, supervisor, Kind::Hello, piece),
            _ => tick(supervisor, piece),
        }
        handler.keep_fault(supervisor);
    }
}

fn say(handler: &mut Handler<MemoryStore>, supervisor: &mut Supervisor, bytes: &[u8]) {
    for &byte in bytes {
        if let Some(answer) = handler.receive(byte, supervisor) {
            assert!(answer.ends_with(&[0]) && answer.len() <= MAX_FRAME_BYTES, "{answer:?}");
        }
    }
}

fn say_sealed(
    handler: &mut Handler<MemoryStore>,
    supervisor: &mut Supervisor,
    kind: Kind,
    payload: &[u8],
) {
    let mut buffer = [0; MAX_FRAME_BYTES];
    if let Some(frame) = seal(kind, payload, &mut buffer) {
        say(handler, supervisor, frame);
    }
}

/// Ticks with these counts.
fn tick(supervisor: &mut Supervisor, counts: &[u8]) {
    for count in counts.chunks_exact(4) {
        let count = i32::from_le_bytes([count[0], count[1], count[2], count[3]]);
        supervisor.tick(&[count; 3], Health::default());
    }
}
