//! `rrr connect`: what is at the line, and how it is.

use clap::Args;
use firmware::link::{Hello, Parameters, Report};

use super::Failure;
use super::link_choice::{LinkChoice, openness};

/// Arguments of `rrr connect`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Which board.
    #[command(flatten)]
    pub link: LinkChoice,
}

/// Runs the command.
///
/// # Errors
/// No line, no board, or one of another build.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.link.connect()?;
    let report = client.report()?;
    println!("line        {}", client.name());
    println!("board       {}", board(client.hello()));
    tell(&report);
    Ok(())
}

fn board(hello: &Hello) -> String {
    let (name, build) = (hello.board.as_str(), hello.build_id.as_str());
    let (version, hash) = (hello.protocol_version, hello.schema_hash);
    format!("{name}, build {build}, protocol {version}, messages {hash:08X}")
}

fn tell(report: &Report) {
    let counters = &report.counters;
    println!("state       {}", report.state);
    if let Some(fault) = &report.fault {
        println!("fault       {fault}");
    }
    if !report.position_known {
        println!("position    not known since power-on: `rrr home` tells it");
    }
    println!("parameters  {}", parameters(report.parameters.as_ref()));
    println!("link        {}", openness(report));
    println!(
        "ticks       {}, {} overruns, longest {:.1} us",
        counters.ticks,
        counters.overruns,
        f64::from(counters.longest_tick_tenth_us) / 10.0
    );
    let [first, second, third] = counters.saturated;
    println!(
        "limits      commands cut {first} / {second} / {third}, telemetry dropped {}, \
         frames broken {}",
        counters.telemetry_dropped, counters.frames_broken
    );
}

/// Which block is in use, in words.
pub(super) fn parameters(parameters: Option<&Parameters>) -> String {
    match parameters {
        Some(Parameters { origin, length, checksum }) => {
            format!("{origin} ({length} bytes, CRC-32 {checksum:08X})")
        }
        None => "none".to_owned(),
    }
}
