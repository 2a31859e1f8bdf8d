//! `rrr upload`: a model file into the board's flash.

use std::path::PathBuf;

use clap::Args;
use firmware::ParameterBlock;
use firmware::block::MAX_BYTES;
use firmware::link::Source;

use super::Failure;
use super::block_choice::BlockChoice;
use super::connect;
use super::link_choice::{LinkChoice, openness};
use super::output::say;
use link::{Client, transfer};

/// Arguments of `rrr upload`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model.
    #[arg(value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// What the board is to do.
    #[command(flatten)]
    pub choice: BlockChoice,
    /// Which board.
    #[command(flatten)]
    pub link: LinkChoice,
}

/// Runs the command.
///
/// # Errors
/// A model that cannot be used, here or on the board, or a board that does not answer.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    // What is wrong with the file is said before a board is looked for.
    let block = arguments.choice.block(&arguments.model)?;
    let file = arguments.model.display();
    let encoded = encoded(&block)?;
    let mut client = arguments.link.connect()?;
    let report = client.report()?;
    let in_use = transfer::commit(&mut client, &encoded)?;
    transfer::compare(&mut client, &encoded)?;
    say(format_args!("{file}: stored, read back, the same byte for byte"))?;
    say(format_args!("parameters  {}", connect::parameters(Some(&in_use))))?;
    if client.report()?.position_known != report.position_known {
        say(
            "position    void: the encoder counts another number a turn; `rrr home` tells it again",
        )?;
    }
    say(format_args!("link        {}", openness(&report)))
}

/// A block as it goes over the line.
///
/// # Errors
/// It has more bytes than a block may.
pub(super) fn encoded(block: &ParameterBlock) -> Result<Vec<u8>, Failure> {
    let mut buffer = [0; MAX_BYTES];
    let encoded = block.encode(&mut buffer).map_err(|error| {
        Failure::new(format!("the parameter block: {error}"), "use fewer effects in the model file")
    })?;
    Ok(encoded.to_vec())
}

/// A block of the board.
///
/// # Errors
/// The line is broken, the board says no, or the block is of another build.
pub(super) fn downloaded(client: &mut Client, source: Source) -> Result<ParameterBlock, Failure> {
    let bytes = transfer::download(client, source)?;
    ParameterBlock::decode(&bytes).map_err(|error| {
        let hint = "build tool and firmware from the same sources";
        Failure::new(format!("the board's block: {error}"), hint)
    })
}
