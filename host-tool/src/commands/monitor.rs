//! `rrr monitor`: a live table of what the board does.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::ErrorKind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use firmware::link::{Command, Report, Source, Telemetry};
use firmware::supervisor::State;

use crate::failure::Failure;
use crate::options::board::{BoardOptions, access};
use crate::terminal::interrupt::interrupt;
use crate::terminal::output;
use link::settling::next_record;
use link::{Client, LinkError, transfer};

/// Time between two tables.
const PERIOD: Duration = Duration::from_millis(200);

/// Arguments of `rrr monitor`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Print one table and end.
    #[arg(long)]
    pub once: bool,
    /// Which board.
    #[command(flatten)]
    pub board: BoardOptions,
}

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
    let shown = arguments.show(&mut client, counts_per_turn, interrupted);
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
        interrupted: &AtomicBool,
    ) -> Result<(), Failure> {
        client.execute(Command::Stream { on: true })?;
        let mut lines = 0;
        while !interrupted.load(Ordering::Relaxed) {
            let record = next_record(client)?;
            let table = table(&record, &client.report()?, counts_per_turn);
            match output::write(&redrawn(&table, lines)) {
                Err(error) if error.kind() == ErrorKind::BrokenPipe => break,
                written => written.map_err(|error| output::not_written(&error))?,
            }
            lines = table.lines().count();
            if self.once {
                break;
            }
            pause(client, interrupted)?;
        }
        Ok(())
    }
}

/// Listens until the next table is due.
fn pause(client: &mut Client, interrupted: &AtomicBool) -> Result<(), LinkError> {
    let drawn = Instant::now();
    while drawn.elapsed() < PERIOD && !interrupted.load(Ordering::Relaxed) {
        client.receive()?;
        client.take_records();
    }
    Ok(())
}

/// A table over the one before, which has so many lines.
fn redrawn(table: &str, lines: usize) -> String {
    match lines {
        0 => table.to_owned(),
        lines => format!("\x1b[{lines}A\x1b[J{table}"),
    }
}

/// What there is to see, as lines.
fn table(record: &Telemetry, report: &Report, counts_per_turn: f64) -> String {
    let mut text = format!(
        "{}  tick {}  {:.1} us (longest {:.1})  overruns {}  telemetry dropped {}\n",
        report.state,
        record.sequence,
        f64::from(record.tick_time_tenth_us) / 10.0,
        f64::from(report.counters.longest_tick_tenth_us) / 10.0,
        report.counters.overruns,
        record.dropped,
    );
    let titles = ["joint", "position_rad", "voltage_V", "error_mrad", "cut", "mode"];
    row(&mut text, titles.map(str::to_owned));
    for joint in 0..3 {
        let position_rad = f64::from(record.counts[joint]) / counts_per_turn * TAU;
        row(
            &mut text,
            [
                format!("{}", joint + 1),
                format!("{position_rad:.5}"),
                format!("{:.4}", f64::from(record.codes[joint].to_volts())),
                error_mrad(record, joint, position_rad),
                format!("{}", report.counters.saturated[joint]),
                record.mode[joint].name().to_owned(),
            ],
        );
    }
    let fault = report.fault.map_or("none".to_owned(), |fault| fault.to_string());
    let _ = writeln!(text, "fault {fault}\nlink  {}", access(report));
    text
}

/// The tracking error, where there is a reference.
fn error_mrad(record: &Telemetry, joint: usize, position_rad: f64) -> String {
    if record.state != State::Running {
        return "-".to_owned();
    }
    let reference_rad = f64::from(record.reference[joint].0) / 2f64.powi(32) * TAU;
    let turns = ((reference_rad - position_rad) / TAU).round();
    format!("{:.3}", 1e3 * (reference_rad - position_rad - turns * TAU))
}

fn row(text: &mut String, [joint, position, voltage, error, cut, mode]: [String; 6]) {
    let _ =
        writeln!(text, "{joint:>5} {position:>14} {voltage:>11} {error:>12} {cut:>9} {mode:>14}");
}
