//! `rrr flash`: firmware and parameter block onto the board, through a debug probe.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use firmware::ParameterBlock;
use firmware::store::Slot;

use super::Failure;
use super::block_choice::BlockChoice;
use files::Problem;
use link::flash_image::{FlashError, FlashImage};

/// Arguments of `rrr flash`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The firmware, as `cargo xtask firmware nucleo` builds it.
    #[arg(long, value_name = "ELF", required_unless_present = "model")]
    pub firmware: Option<PathBuf>,
    /// The model for a parameter block.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: Option<PathBuf>,
    /// The slot for it, instead of the one that is not in force; the other is not touched.
    #[arg(long, value_enum, requires = "model")]
    pub slot: Option<SlotName>,
    /// The probe, where there are several, as VID:PID:SERIAL.
    #[arg(long, value_name = "NAME")]
    pub probe: Option<String>,
    /// What the board is to do.
    #[command(flatten)]
    pub choice: BlockChoice,
}

/// A slot on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SlotName {
    /// The first.
    A,
    /// The second.
    B,
}

impl From<SlotName> for Slot {
    fn from(name: SlotName) -> Self {
        match name {
            SlotName::A => Self::A,
            SlotName::B => Self::B,
        }
    }
}

/// Runs the command.
///
/// # Errors
/// An image that may not be written, no probe, or a board that does not take it.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let firmware = arguments.firmware()?;
    let block =
        arguments.model.as_deref().map(|model| arguments.choice.block(model)).transpose()?;
    // What is wrong with the files is said before a probe is looked for.
    firmware.check(None)?;
    write(arguments, firmware, block)
}

#[cfg(feature = "probe")]
fn write(
    arguments: &Arguments,
    mut image: FlashImage,
    block: Option<ParameterBlock>,
) -> Result<(), Failure> {
    use super::output::say;
    use link::flash_image::parameters::next_slot;
    use link::flash_image::probe::ProbedBoard;

    let mut board = ProbedBoard::attach(arguments.probe.as_deref())?;
    let (mut chosen, mut parameters) = (None, String::new());
    if let Some(block) = block {
        let (next, sequence) = next_slot(board.read_store()?)?;
        let slot = arguments.slot.map_or(next, Slot::from);
        image.pieces.extend(FlashImage::of_block(&block, slot, sequence)?.pieces);
        chosen = Some(slot);
        parameters = format!("parameters: block {sequence} for {slot}\n");
    }
    board.write(&image, chosen)?;
    board.restart()?;
    say(format_args!("{parameters}{} bytes written and read back", image.bytes()))
}

#[cfg(not(feature = "probe"))]
fn write(_: &Arguments, _: FlashImage, _: Option<ParameterBlock>) -> Result<(), Failure> {
    Err(FlashError::NoProbeSupport.into())
}

impl Arguments {
    fn firmware(&self) -> Result<FlashImage, Failure> {
        let Some(path) = &self.firmware else { return Ok(FlashImage::default()) };
        let bytes = std::fs::read(path).map_err(|error| {
            let missing = error.kind() == std::io::ErrorKind::NotFound;
            let problem = if missing { Problem::Missing } else { Problem::Unreadable(error) };
            problem.in_file(path)
        })?;
        Ok(FlashImage::of_elf(path, &bytes)?)
    }
}

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
