//! Non-volatile storage in flash: parameters in two slots, the latched fault, the key.
//!
//! Each kind has two pages of flash. A record is written where the newest one is not, read
//! back, and marked as valid last, so that a power cut leaves the old one or the new one
//! (`docs/parameter-store.md`). Reading never erases or writes.

mod append;
mod boot;
mod defaults;
mod error;
mod flash;
mod layout;
mod notes;
mod parameters;
mod ram;
mod read;
mod record;

pub use boot::{Boot, SlotState, Source};
pub use defaults::safe_defaults;
pub use error::{Operation, Place, StoreError};
pub use flash::Store;
pub use layout::{Kind, Layout, Slot};
pub use ram::RamFlash;
pub use read::{Content, Stored};
pub use record::{NOTE_BYTES, slot_record};
