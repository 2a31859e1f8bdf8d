//! The control mode, by its name.

use firmware::Mode;

use crate::failure::Failure;

/// The mode of that name.
///
/// # Errors
/// There is none.
pub fn mode_named(name: &str) -> Result<Mode, Failure> {
    Mode::from_name(name).ok_or_else(|| {
        let known = Mode::ALL.map(Mode::name).join(", ");
        Failure::new(format!("--mode {name}: no such mode"), format!("take one of {known}"))
    })
}
