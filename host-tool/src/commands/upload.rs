//! `rrr upload`: a model file into the board's flash.

use std::path::PathBuf;

use super::connect::parameters;
use crate::failure::Failure;
use crate::options::block::BlockOptions;
use crate::options::board::{BoardOptions, access};
use crate::terminal::answer::answer;
use crate::terminal::output::print_line;
use clap::Args;
use link::transfer;
use serde_json::json;

/// Arguments of `rrr upload`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model.
    #[arg(value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// What the board is to do.
    #[command(flatten)]
    pub block: BlockOptions,
    /// Which board.
    #[command(flatten)]
    pub board: BoardOptions,
}

/// Runs the command.
///
/// # Errors
/// A model that cannot be used, here or on the board, or a board that does not answer.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    // A bad file is reported before a board is looked for.
    let block = arguments.block.parameter_block(&arguments.model)?;
    let file = arguments.model.display();
    let encoded = transfer::encoded(&block)?;
    let mut client = arguments.board.connect()?;
    let report = client.report()?;
    let in_use = transfer::commit(&mut client, &encoded)?;
    transfer::compare(&mut client, &encoded)?;
    print_line(format_args!("{file}: stored, read back, the same byte for byte"))?;
    print_line(format_args!("parameters  {}", parameters(Some(&in_use))))?;
    if client.report()?.position_known != report.position_known {
        print_line(
            "position    unknown: the counts per turn have changed; `rrr home` sets it again",
        )?;
    }
    print_line(format_args!("link        {}", access(&report)))?;
    answer(&json!({ "model": arguments.model, "parameters": parameters(Some(&in_use)) }))
}
