//! `rrr download`: the board's parameter block into a file.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use firmware::ParameterBlock;
use firmware::block::{PositionLimits, SafetyLimits};
use firmware::link::Source;

use crate::failure::Failure;
use crate::options::board::BoardOptions;
use crate::terminal::answer::answer;
use crate::terminal::output::print_line;
use files::replace::replace_file;
use files::{Problem, RobotFile, RobotTable};
use link::transfer;
use serde_json::json;

/// Arguments of `rrr download`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The file: .bin (the block's bytes) or .toml (its model with limits, without its effects).
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// The block in use instead of the one that is stored.
    #[arg(long)]
    pub in_use: bool,
    /// Which board.
    #[command(flatten)]
    pub board: BoardOptions,
}

/// Runs the command.
///
/// # Errors
/// A board that does not answer or has no such block, or a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let out = &arguments.out;
    let write = writer_for(out)?;
    let mut client = arguments.board.connect_to_read()?;
    let source = if arguments.in_use { Source::InUse } else { Source::Stored };
    let bytes = transfer::download(&mut client, source)?;
    write(out, &bytes)?;
    print_line(format_args!("{}: a block of {} bytes", out.display(), bytes.len()))?;
    answer(&json!({ "out": out, "bytes": bytes.len() }))
}

type Writer = fn(&Path, &[u8]) -> Result<(), Failure>;

fn writer_for(out: &Path) -> Result<Writer, Failure> {
    match out.extension().and_then(|ending| ending.to_str()) {
        Some("bin") => Ok(|out, bytes| {
            Ok(replace_file(out, |file| file.write_all(bytes).map_err(Problem::Unwritable))?)
        }),
        Some("toml") => Ok(|out, bytes| Ok(model_of(bytes)?.write(out)?)),
        _ => {
            let message = format!("--out {}: ends neither in .bin nor in .toml", out.display());
            Err(Failure::new(message, "name it params.bin or model.toml, say"))
        }
    }
}

/// The model of a block, with the board's data that a model file has.
fn model_of(bytes: &[u8]) -> Result<RobotFile, Failure> {
    let block = ParameterBlock::decode(bytes).map_err(|error| {
        let hint = "build tool and firmware from the same sources, or download to a .bin file";
        Failure::new(format!("the board's block: {error}"), hint)
    })?;
    let mut file = RobotFile::from_robot(&block.robot.cast());
    file.robot.encoder_counts_per_rev = Some(f64::from(block.encoder_counts_per_turn));
    file.robot.sample_period_s = Some(f64::from(block.sample_period_s));
    file.robot.command_limit_v = Some(f64::from(block.command_limit_v));
    take_limits(&mut file.robot, &block.safety);
    Ok(file)
}

/// The ranges of the joints and what their motors bear, so that an upload of the file has them again. A joint without a range
/// has the widest that a file may tell; motors are told where the block has all of them, as files do.
fn take_limits(table: &mut RobotTable, safety: &SafetyLimits) {
    const WIDEST_RAD: [f64; 2] = [-1000.0, 1000.0];
    if safety.position.iter().any(Option::is_some) {
        let range = |limits: &Option<PositionLimits>| {
            limits.as_ref().map_or(WIDEST_RAD, |l| [l.lower_rad.into(), l.upper_rad.into()])
        };
        table.limits_rad = Some(safety.position.iter().map(range).collect());
    }
    if let [Some(one), Some(two), Some(three)] = &safety.heating {
        let motors = [one, two, three];
        table.motor_continuous_v = Some(motors.map(|m| m.continuous_v.into()).to_vec());
        table.motor_time_constant_s = Some(motors.map(|m| m.time_constant_s.into()).to_vec());
    }
}
