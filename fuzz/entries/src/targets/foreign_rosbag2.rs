//! Recordings of ROS: MCAP with messages in CDR.

/// Reads all streams, and guesses what they are.
pub fn run(bytes: &[u8]) {
    super::foreign::run("log.mcap", bytes);
}
