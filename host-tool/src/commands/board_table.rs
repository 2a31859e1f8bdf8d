//! What a board does, as a table on the terminal that is drawn over the one before.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::time::Duration;

use firmware::link::{Report, Telemetry};
use firmware::supervisor::State;

use crate::options::board::access;

/// Time between two tables.
pub const PERIOD: Duration = Duration::from_millis(200);

/// A table over the one before, which has so many lines.
pub fn redrawn(table: &str, lines: usize) -> String {
    match lines {
        0 => table.to_owned(),
        lines => format!("\x1b[{lines}A\x1b[J{table}"),
    }
}

/// What there is to see, as lines.
pub fn table(record: &Telemetry, report: &Report, counts_per_turn: f64) -> String {
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

/// The same for programs, in SI units.
pub fn as_json(record: &Telemetry, report: &Report, counts_per_turn: f64) -> serde_json::Value {
    let position_rad = record.counts.map(|count| f64::from(count) / counts_per_turn * TAU);
    let error_rad: Vec<Option<f64>> =
        (0..3).map(|joint| error_rad(record, joint, position_rad[joint])).collect();
    serde_json::json!({
        "state": report.state.to_string(),
        "tick": record.sequence,
        "tick_time_us": f64::from(record.tick_time_tenth_us) / 10.0,
        "overruns": report.counters.overruns,
        "telemetry_dropped": record.dropped,
        "position_rad": position_rad,
        "command_V": record.codes.map(|code| f64::from(code.to_volts())),
        "error_rad": error_rad,
        "saturated": report.counters.saturated,
        "mode": record.mode.map(|mode| mode.name()),
        "fault": report.fault.map(|fault| fault.to_string()),
    })
}

/// The tracking error, where there is a reference.
fn error_mrad(record: &Telemetry, joint: usize, position_rad: f64) -> String {
    let error_rad = error_rad(record, joint, position_rad);
    error_rad.map_or("-".to_owned(), |error_rad| format!("{:.3}", 1e3 * error_rad))
}

/// The same [rad].
fn error_rad(record: &Telemetry, joint: usize, position_rad: f64) -> Option<f64> {
    if record.state != State::Running {
        return None;
    }
    let reference_rad = f64::from(record.reference[joint].0) / 2f64.powi(32) * TAU;
    let turns = ((reference_rad - position_rad) / TAU).round();
    Some(reference_rad - position_rad - turns * TAU)
}

fn row(text: &mut String, [joint, position, voltage, error, cut, mode]: [String; 6]) {
    let _ =
        writeln!(text, "{joint:>5} {position:>14} {voltage:>11} {error:>12} {cut:>9} {mode:>14}");
}
