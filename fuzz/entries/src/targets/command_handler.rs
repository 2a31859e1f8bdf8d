//! Whole conversations with a board: its line, handler, supervisor and store.
//!
//! The bytes are read as pieces, each begun by a byte for what it is and one for its length:
//! bytes of the line as they are, a request or a Hello with a checksum that fits, or ticks.
//! Ticks are six bytes: the count of all joints, what the board has of itself, and how many.

use firmware::link::checked::{Kind, seal};
use firmware::link::{BootState, Handler, HandlerConfig, MAX_FRAME_BYTES};
use firmware::reference::Reference;
use firmware::store::{Layout, RamFlash, Store, safe_defaults};
use firmware::supervisor::{BootReport, Health, State, Supervisor};
use firmware::{Controller, Mode, ParameterBlock};

const LAYOUT: Layout = Layout::G474;
/// Bytes of a store.
pub const BANK_BYTES: usize = LAYOUT.used_bytes() as usize;

type MemoryStore = Store<RamFlash<Vec<u8>>>;

/// No conversation has more ticks.
const MOST_TICKS: u32 = 1000;

/// A board with parameters has stood for so long when the conversation begins.
const SETTLING_TICKS: u32 = 140;

/// Joints that hold where they are.
fn holding_block() -> ParameterBlock {
    let reference = Reference::hold([0.0; 3]);
    ParameterBlock { reference, mode: [Mode::PdModel; 3], ..safe_defaults() }
}

/// Has the conversation.
pub fn run(bytes: &[u8]) {
    let _ = reaches_a_run(bytes);
}

/// Has the conversation; whether the arm ran in it.
pub fn reaches_a_run(bytes: &[u8]) -> bool {
    let Some((&first, rest)) = bytes.split_first() else { return false };
    let mut store = Store::new(RamFlash::new(vec![0xFF; BANK_BYTES]), LAYOUT.bank_start, LAYOUT);
    let boot_state = BootState::read(&mut store);
    let key = (first & 1 == 1).then_some([0x5A; 32]);
    let config = HandlerConfig {
        board: "fuzz",
        limits: Default::default(),
        nonce_seed: [first; 16],
        key,
        fault: boot_state.fault,
        in_use: None,
    };
    let mut supervisor = Supervisor::default();
    let has_parameters = first & 4 == 4;
    if has_parameters {
        let _ = supervisor.replace(Controller::new(holding_block()));
    }
    let position_lost = first & 2 == 2;
    supervisor.booted(BootReport { position_lost, ..BootReport::default() });
    for _ in 0..SETTLING_TICKS * u32::from(has_parameters) {
        supervisor.tick(&[0; 3], Health::default());
    }
    let mut handler = Handler::new(store, &config);
    converse(&mut handler, &mut supervisor, rest)
}

fn converse(
    handler: &mut Handler<MemoryStore>,
    supervisor: &mut Supervisor,
    mut bytes: &[u8],
) -> bool {
    let mut has_run = false;
    while let [what, length, rest @ ..] = bytes {
        let (piece, behind) = rest.split_at(rest.len().min(usize::from(*length)));
        bytes = behind;
        match what % 4 {
            0 => send(handler, supervisor, piece),
            1 => send_framed(handler, supervisor, Kind::Request, piece),
            2 => send_framed(handler, supervisor, Kind::Hello, piece),
            _ => has_run |= tick(handler, supervisor, piece),
        }
        handler.store_fault(supervisor);
    }
    has_run
}

fn send(handler: &mut Handler<MemoryStore>, supervisor: &mut Supervisor, bytes: &[u8]) {
    for &byte in bytes {
        if let Some(answer) = handler.receive(byte, supervisor) {
            assert!(answer.ends_with(&[0]) && answer.len() <= MAX_FRAME_BYTES, "{answer:?}");
        }
    }
}

fn send_framed(
    handler: &mut Handler<MemoryStore>,
    supervisor: &mut Supervisor,
    kind: Kind,
    payload: &[u8],
) {
    let mut buffer = [0; MAX_FRAME_BYTES];
    if let Some(frame) = seal(kind, payload, &mut buffer) {
        send(handler, supervisor, frame);
    }
}

/// Ticks with these counts; whether the arm ran in one of them.
fn tick(handler: &mut Handler<MemoryStore>, supervisor: &mut Supervisor, bytes: &[u8]) -> bool {
    let mut has_run = false;
    for ticks in bytes.chunks_exact(6) {
        let count = i32::from_le_bytes([ticks[0], ticks[1], ticks[2], ticks[3]]);
        for _ in 0..ticks[5] {
            let health = Health { host_heard: handler.take_heard(), ..health(ticks[4]) };
            if supervisor.counters().ticks >= MOST_TICKS {
                break;
            }
            let record = supervisor.tick(&[count; 3], health);
            let zero = record.codes.iter().all(|code| code.0 == 0);
            assert!(zero || record.state.drives(), "{record:?}");
            has_run |= record.state == State::Running;
        }
    }
    has_run
}

fn health(bits: u8) -> Health {
    Health {
        overrun: bits & 1 != 0,
        converter_fault: bits & 2 != 0,
        parameters_corrupt: bits & 4 != 0,
        clock_wrong: bits & 8 != 0,
        ..Health::default()
    }
}
