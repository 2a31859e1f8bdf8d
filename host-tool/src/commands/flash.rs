//! `rrr flash`: firmware and parameter block onto the board, through a debug probe.

use std::path::PathBuf;

use clap::Args;
use firmware::ParameterBlock;

use crate::failure::Failure;
use crate::options::block::BlockOptions;
use crate::options::slot::SlotName;
use files::Problem;
use link::flash_image::FlashImage;

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
    pub block: BlockOptions,
}

/// Runs the command.
///
/// # Errors
/// An image that may not be written, no probe, or a board that does not take it.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let firmware = arguments.firmware()?;
    let block = arguments
        .model
        .as_deref()
        .map(|model| arguments.block.parameter_block(model))
        .transpose()?;
    // Bad files are reported before a probe is looked for.
    firmware.check(None)?;
    write(arguments, firmware, block)
}

#[cfg(feature = "probe")]
fn write(
    arguments: &Arguments,
    mut image: FlashImage,
    block: Option<ParameterBlock>,
) -> Result<(), Failure> {
    use crate::terminal::answer::answer;
    use crate::terminal::output::print_line;
    use firmware::store::Slot;
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
    print_line(format_args!("{parameters}{} bytes written and read back", image.bytes()))?;
    answer(
        &serde_json::json!({ "bytes": image.bytes(), "slot": chosen.map(|slot| slot.to_string()) }),
    )
}

#[cfg(not(feature = "probe"))]
fn write(_: &Arguments, _: FlashImage, _: Option<ParameterBlock>) -> Result<(), Failure> {
    Err(link::flash_image::FlashError::NoProbeSupport.into())
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
