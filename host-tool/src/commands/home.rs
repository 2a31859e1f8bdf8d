//! `rrr home`: where the arm is now.

use std::f32::consts::PI;
use std::sync::atomic::Ordering;

use clap::Args;
use firmware::Angle;
use firmware::link::{Command, Source};

use crate::failure::Failure;
use crate::options::board::BoardOptions;
use crate::terminal::answer::answer;
use crate::terminal::interrupt::interrupt;
use crate::terminal::output::print_line;
use link::{Client, settling, transfer};
use serde_json::json;

/// Arguments of `rrr home`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Where the joints are now, at rest [rad]; stretched out horizontally is 0,0,0, hanging
    /// straight down 0,-1.5708,0.
    #[arg(long, value_name = "Q1,Q2,Q3", allow_hyphen_values = true, value_parser = angles)]
    pub at: Angles,
    /// Which board.
    #[command(flatten)]
    pub board: BoardOptions,
}

/// An angle of each joint [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angles(pub [f32; 3]);

fn angles(text: &str) -> Result<Angles, String> {
    let numbers: Result<Vec<f32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let numbers = numbers.ok().filter(|all| all.iter().all(|angle| angle.abs() <= PI));
    let angles = numbers.and_then(|all| all.try_into().ok());
    angles.map(Angles).ok_or_else(|| {
        "take three angles within half a turn of zero, in rad, as in 0,-1.5708,0".to_owned()
    })
}

/// Runs the command.
///
/// # Errors
/// A board that does not answer, is not disarmed, or whose arm moves.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.board.connect()?;
    wait_for_rest(&mut client)?;
    let Angles(at_rad) = arguments.at;
    let position = at_rad.map(Angle::from_radians);
    if !settling::execute_once_settled(&mut client, Command::Home { position }, interrupt())? {
        return Err(stopped());
    }
    for (joint, (known, at_rad)) in (1..).zip(client.report()?.position_known.iter().zip(at_rad)) {
        match known {
            true => print_line(format_args!(
                "joint {joint} is at {at_rad} rad, until the board is reset"
            ))?,
            false => print_line(format_args!(
                "joint {joint}: the encoder has not moved yet; turn it by hand, then run `rrr home` again"
            ))?,
        }
    }
    answer(&json!({ "at_rad": at_rad, "position_known": client.report()?.position_known }))
}

fn stopped() -> Failure {
    Failure::interrupted("stopped before the position was set")
}

fn wait_for_rest(client: &mut Client) -> Result<(), Failure> {
    let block = transfer::download_block(client, Source::InUse)?;
    client.execute(Command::Stream { on: true })?;
    let rest = settling::wait_for_rest(client, block.encoder_counts_per_turn, interrupt());
    client.execute(Command::Stream { on: false })?;
    rest?;
    if interrupt().load(Ordering::Relaxed) {
        return Err(stopped());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_angles_are_three_angles() {
        assert_eq!(angles("0, -1.5,2e-1"), Ok(Angles([0.0, -1.5, 0.2])));
        for wrong in ["", "0,0", "0,0,0,0", "0,a,0", "0,nan,0", "0,90,0", "3.5,0,0"] {
            assert!(angles(wrong).is_err(), "{wrong}");
        }
    }
}
