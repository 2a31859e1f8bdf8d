//! Connects to a board and prints its Hello and its state:
//! `cargo run --example talk_to_board -- /dev/ttyACM0`; without a port, to a simulated board.

use std::error::Error;

use link::{Address, Client};
use model::reference_robot::reference_robot;
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

/// The Hello and the state of the board at a port.
pub fn hello_and_state(port: &str) -> Result<String, Box<dyn Error>> {
    let mut client = Client::connect(&Address::of(port), None)?;
    let hello = *client.hello();
    let state = client.report()?.state;
    Ok(format!("{}, build {}: {state}", hello.board.as_str(), hello.build_id.as_str()))
}

/// The same of a simulated board.
pub fn of_simulated_board() -> Result<String, Box<dyn Error>> {
    let board = SimulatedBoard::start(BoardSettings::new(reference_robot()))?;
    hello_and_state(&board.port())
}

#[allow(dead_code)] // The test calls the functions.
fn main() -> Result<(), Box<dyn Error>> {
    let port = std::env::args().nth(1);
    println!("{}", port.map_or_else(of_simulated_board, |port| hello_and_state(&port))?);
    Ok(())
}
