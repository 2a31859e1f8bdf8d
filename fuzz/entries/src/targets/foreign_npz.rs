//! NumPy's archives.

/// Reads all streams, and guesses what they are.
pub fn run(bytes: &[u8]) {
    super::foreign::run("log.npz", bytes);
}
