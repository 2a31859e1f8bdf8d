//! Flash with anything at all in it: the board boots, and can commit afterwards.

use firmware::block::MAX_BYTES;
use firmware::link::BootState;
use firmware::store::{Layout, RamFlash, Source, Store, safe_defaults};

use super::command_handler::BANK_BYTES;

const LAYOUT: Layout = Layout::G474;
/// Where the pages begin, in bytes from the begin of the bank.
const PAGES: [usize; 6] = [0, 0x1000, 0x2000, 0x3000, 0x4000, 0x5000];

/// Spreads the bytes over the pages and boots.
pub fn run(bytes: &[u8]) {
    let mut store = Store::new(RamFlash::new(bank(bytes)), LAYOUT.bank_start, LAYOUT);
    let boot = store.boot();
    let _ = (boot.to_string(), BootState::read(&mut store));
    let mut buffer = [0; MAX_BYTES];
    let block = safe_defaults();
    let encoded = block.encode(&mut buffer).expect("the safe defaults fit");
    if let Ok(stored) = store.commit(encoded) {
        // What lies in the other slot may claim to be newer; it is not in force.
        let (Source::Newest { slot, sequence } | Source::Other { slot, sequence }) =
            store.boot().source
        else {
            panic!("a commit holds");
        };
        assert_eq!((slot, sequence), (stored.slot, stored.sequence));
    }
}

/// A bank whose pages begin with these bytes, up to a fixed length each.
fn bank(bytes: &[u8]) -> Vec<u8> {
    let mut bank = vec![0xFF; BANK_BYTES];
    let share = bytes.len().div_ceil(PAGES.len()).clamp(1, 2048);
    for (page, bytes) in PAGES.into_iter().zip(bytes.chunks(share)) {
        bank[page..page + bytes.len()].copy_from_slice(bytes);
    }
    bank
}
