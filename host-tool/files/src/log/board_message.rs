//! What a board reports beside its joints, as an MCAP message: JSON under a JSON schema.

use serde::Serialize;
use serde_json::json;

/// The topic of these messages.
pub(super) const TOPIC: &str = "/board";
/// Their schema's name.
pub(super) const NAME: &str = "BoardSample";

/// What a board reports of a tick beside its joints. Only MCAP holds it; reading a log skips it.
///
/// A log's rows are ticks in which the board was running. The tick that ended it, by a fault,
/// say, is a sample without a row: it alone has its own positions and commands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoardSample {
    /// Time [s], that of the log's row.
    pub t_s: f64,
    /// The board's state.
    pub state: &'static str,
    /// The joints' modes.
    pub mode: [&'static str; 3],
    /// Whether each joint's command was cut at its limit.
    pub saturated: [bool; 3],
    /// Duration of the tick before this one [us].
    pub tick_time_us: f64,
    /// Records that the board could not send since power-on.
    pub telemetry_dropped: u32,
    /// The fault's name, or "none".
    pub fault: &'static str,
    /// The joint at fault, 1 to 3, or 0.
    pub fault_joint: u8,
    /// Positions [encoder counts], where the log has no row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_count: Option<[i64; 3]>,
    /// Commands [V], where the log has no row.
    #[serde(rename = "command_V", skip_serializing_if = "Option::is_none")]
    pub command_v: Option<[f64; 3]>,
}

/// The JSON schema of these messages.
pub(super) fn schema() -> String {
    let three = |kind: &str, text: &str| {
        let items = json!({ "type": kind });
        json!({ "type": "array", "items": items, "minItems": 3, "maxItems": 3, "description": text })
    };
    let one = |kind: &str, text: &str| json!({ "type": kind, "description": text });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Board sample",
        "type": "object",
        "properties": {
            "t_s": one("number", "time [s]"),
            "state": one("string", "state of the board"),
            "mode": three("string", "what each joint's command is made of"),
            "saturated": three("boolean", "whether each joint's command was cut at its limit"),
            "tick_time_us": one("number", "duration of the tick before [us]"),
            "telemetry_dropped": one("integer", "records that the board could not send"),
            "fault": one("string", "the fault, or none"),
            "fault_joint": one("integer", "the joint at fault, or 0"),
            "position_count": three("integer", "where the joints' topics have no message"),
            "command_V": three("number", "where the joints' topics have no message [V]"),
        },
    })
    .to_string()
}
