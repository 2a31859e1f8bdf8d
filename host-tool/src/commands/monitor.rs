//! `rrr monitor`: a live table of what the board does.

use std::io::ErrorKind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use clap::Args;
use firmware::link::{Command, Source};

use super::board_table::{PERIOD, as_json, redrawn, table};
use crate::failure::Failure;
use crate::live::{Server, Watched};
use crate::options::board::BoardOptions;
use crate::options::foxglove::FoxgloveOptions;
use crate::terminal::answer::answer;
use crate::terminal::interrupt::interrupt;
use crate::terminal::json_mode::is_json;
use crate::terminal::output;
use link::settling::next_record;
use link::{Client, LinkError, transfer};

/// Arguments of `rrr monitor`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Print one table and end.
    #[arg(long)]
    pub once: bool,
    /// Whether samples are served to Foxglove.
    #[command(flatten)]
    pub foxglove: FoxgloveOptions,
    /// Which board.
    #[command(flatten)]
    pub board: BoardOptions,
}

/// Who hears of every record.
type Listener = Option<(Server, Watched)>;

/// Runs the command: until Ctrl-C, or until nobody reads the tables any more, which is no
/// failure either.
///
/// # Errors
/// A board that does not answer, or an output that does not take the table.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.board.connect_to_read()?;
    let block = transfer::download_block(&mut client, Source::InUse)?;
    let counts_per_turn = f64::from(block.encoder_counts_per_turn);
    let interrupted = interrupt();
    let server = arguments.foxglove.start(counts_per_turn)?;
    let mut listener = server.map(|server| (server, Watched::of(&block)));
    let shown = arguments.show(&mut client, counts_per_turn, &mut listener, interrupted);
    // A board that streams to nobody would go on for ever.
    let ended = client.execute(Command::Stream { on: false });
    shown?;
    Ok(ended?)
}

impl Arguments {
    /// Shows tables as long as they are wanted.
    fn show(
        &self,
        client: &mut Client,
        counts_per_turn: f64,
        listener: &mut Listener,
        interrupted: &AtomicBool,
    ) -> Result<(), Failure> {
        client.execute(Command::Stream { on: true })?;
        let mut lines = 0;
        while !interrupted.load(Ordering::Relaxed) {
            let record = next_record(client)?;
            let report = client.report()?;
            answer(&as_json(&record, &report, counts_per_turn))?;
            let table = match is_json() {
                true => String::new(),
                false => table(&record, &report, counts_per_turn),
            };
            match output::write(&redrawn(&table, lines)) {
                Err(error) if error.kind() == ErrorKind::BrokenPipe => break,
                written => written.map_err(|error| output::not_written(&error))?,
            }
            lines = table.lines().count();
            if self.once {
                break;
            }
            pause(client, listener, interrupted)?;
        }
        Ok(())
    }
}

/// Listens until the next table is due.
fn pause(
    client: &mut Client,
    listener: &mut Listener,
    interrupted: &AtomicBool,
) -> Result<(), LinkError> {
    let drawn = Instant::now();
    while drawn.elapsed() < PERIOD && !interrupted.load(Ordering::Relaxed) {
        client.receive()?;
        let records = client.take_records();
        if let Some((server, watched)) = listener {
            watched.send(&records, server);
        }
    }
    Ok(())
}
