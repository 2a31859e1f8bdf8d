//! What to do when an image does not go onto the board.

use super::Failure;
use link::flash_image::FlashError;

impl From<FlashError> for Failure {
    fn from(error: FlashError) -> Self {
        Self::new(error.to_string(), hint(&error))
    }
}

fn hint(error: &FlashError) -> &'static str {
    match error {
        FlashError::NotElf { .. } | FlashError::NoProgram { .. } => {
            "`cargo xtask firmware nucleo` builds the firmware and prints its path"
        }
        FlashError::NotFlash { .. } => "take the image for the NUCLEO, not that for QEMU",
        FlashError::NotTheSlot { .. } | FlashError::Overlap { .. } => {
            "link the firmware against memory.x; parameters go in by --model"
        }
        FlashError::Block(_) | FlashError::TooLong { .. } => "correct the value in the model file",
        FlashError::WornOut => "erase both slots with the probe's own tool, then flash again",
        FlashError::NoProbe => {
            "connect the NUCLEO's USB port (ST-LINK); on Linux its udev rules must let you use it; \
             or write the file of `rrr export-block` with another programmer"
        }
        FlashError::ManyProbes { .. } | FlashError::ProbeName { .. } => {
            "name one with --probe VID:PID:SERIAL"
        }
        FlashError::Probe { .. } => "check the cable and the board's power, then try again",
        FlashError::Verify { .. } | FlashError::OthersChanged { .. } => {
            "try again; if it comes back, the flash is worn"
        }
        FlashError::NoProbeSupport => {
            "build it with the feature `probe`, or write the file of `rrr export-block` with \
             another programmer"
        }
    }
}
