//! `rrr connect`: what is at the line, and how it is.

use firmware::link::{Counters, Hello, Parameters, Report};

use crate::failure::Failure;
pub use crate::options::board::BoardOptions as Arguments;
use crate::options::board::access;
use crate::terminal::answer::answer;
use crate::terminal::output::print_line;
use serde_json::json;

/// Runs the command.
///
/// # Errors
/// No line, no board, or one of another build.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.connect_to_read()?;
    let report = client.report()?;
    print_line(format_args!("line        {}", client.name()))?;
    print_line(format_args!("board       {}", board(client.hello())))?;
    lines(&report).iter().try_for_each(print_line)?;
    answer(&json!({
        "line": client.name(),
        "board": client.hello().board.as_str(),
        "build": client.hello().build_id.as_str(),
        "state": report.state.to_string(),
        "fault": report.fault.map(|fault| fault.to_string()),
        "position_known": report.position_known,
        "parameters": parameters(report.parameters.as_ref()),
        "needs_key": report.has_key,
        "ticks": report.counters.ticks,
        "overruns": report.counters.overruns,
        "longest_tick_us": f64::from(report.counters.longest_tick_tenth_us) / 10.0,
        "saturated": report.counters.saturated,
        "telemetry_dropped": report.counters.telemetry_dropped,
        "frames_broken": report.counters.frames_broken,
    }))
}

fn board(hello: &Hello) -> String {
    let (name, build) = (hello.board.as_str(), hello.build_id.as_str());
    let (version, hash) = (hello.protocol_version, hello.schema_hash);
    format!("{name}, build {build}, protocol {version}, messages {hash:08X}")
}

/// How the board is, line by line.
fn lines(report: &Report) -> Vec<String> {
    let mut lines = vec![format!("state       {}", report.state)];
    lines.extend(report.fault.map(|fault| format!("fault       {fault}")));
    lines.extend(unknown_positions(report.position_known));
    lines.extend([
        format!("parameters  {}", parameters(report.parameters.as_ref())),
        format!("link        {}", access(report)),
        ticks(&report.counters),
        limits(&report.counters),
    ]);
    lines
}

/// Of which joints the board does not know where they are.
fn unknown_positions(known: [bool; 3]) -> Option<String> {
    let unknown = (1..).zip(known).filter(|(_, known)| !known);
    let joints: Vec<String> = unknown.map(|(joint, _)| joint.to_string()).collect();
    let joints = (!joints.is_empty()).then(|| joints.join(", "))?;
    Some(format!("position    unknown for joint {joints}: `rrr home` sets it"))
}

fn ticks(counters: &Counters) -> String {
    let longest_us = f64::from(counters.longest_tick_tenth_us) / 10.0;
    let (ticks, overruns) = (counters.ticks, counters.overruns);
    format!("ticks       {ticks}, {overruns} overruns, longest {longest_us:.1} us")
}

fn limits(counters: &Counters) -> String {
    let [first, second, third] = counters.saturated;
    let (dropped, broken) = (counters.telemetry_dropped, counters.frames_broken);
    format!(
        "limits      commands cut {first} / {second} / {third}, telemetry dropped {dropped}, \
         frames broken {broken}"
    )
}

/// Which block is in use, in words.
pub(super) fn parameters(parameters: Option<&Parameters>) -> String {
    match parameters {
        Some(Parameters { origin, length, checksum }) => {
            format!("{origin} ({length} bytes, CRC-32C {checksum:08X})")
        }
        None => "none".to_owned(),
    }
}
