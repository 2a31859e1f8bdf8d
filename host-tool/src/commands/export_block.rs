//! `rrr export-block`: a model file as the image of a parameter slot.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use firmware::store::{Layout, Slot};

use crate::failure::Failure;
use crate::options::block::BlockOptions;
use crate::options::slot::SlotName;
use crate::terminal::answer::answer;
use crate::terminal::output::print_line;
use files::Problem;
use files::replace::replace_file;
use link::flash_image::FlashImage;
use serde_json::json;

/// Highest sequence number that a file may have: every later upload needs a higher one, and
/// the board has room for as many again.
const MOST: i64 = u32::MAX as i64 / 2;

/// Arguments of `rrr export-block`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model.
    #[arg(value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// The image: .bin (to be written at the slot's address) or .hex (which knows it).
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// The slot that it is for.
    #[arg(long, value_enum, default_value_t = SlotName::A)]
    pub slot: SlotName,
    /// Its sequence number, 1 to 2147483647: the board begins with the highest.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=MOST))]
    pub sequence: u32,
    /// What the board is to do.
    #[command(flatten)]
    pub block: BlockOptions,
}

/// Runs the command.
///
/// # Errors
/// A model that cannot be used, an option that does not exist, or a file that cannot be
/// written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let content = content_for(&arguments.out)?;
    let block = arguments.block.parameter_block(&arguments.model)?;
    let slot = Slot::from(arguments.slot);
    let image = FlashImage::of_block(&block, slot, arguments.sequence)?;
    replace_file(&arguments.out, |file| {
        file.write_all(&content(&image)).map_err(Problem::Unwritable)
    })?;
    let (out, sequence) = (arguments.out.display(), arguments.sequence);
    let (address, bytes) = (Layout::G474.slot(slot), image.bytes());
    print_line(format_args!(
        "{out}: block {sequence} for {slot} at 0x{address:08X}, {bytes} bytes"
    ))?;
    answer(
        &json!({ "out": arguments.out, "sequence": sequence, "address": address, "bytes": bytes }),
    )
}

/// How the file's ending wants the image.
fn content_for(out: &Path) -> Result<fn(&FlashImage) -> Vec<u8>, Failure> {
    match out.extension().and_then(|ending| ending.to_str()) {
        Some("bin") => Ok(|image| image.pieces.iter().flat_map(|p| p.bytes.clone()).collect()),
        Some("hex") => Ok(|image| image.intel_hex().into_bytes()),
        _ => {
            let message = format!("--out {}: ends neither in .bin nor in .hex", out.display());
            Err(Failure::new(message, "name it params.bin or params.hex, say"))
        }
    }
}
