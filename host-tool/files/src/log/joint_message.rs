//! One joint's sample as an MCAP message: JSON under a JSON schema.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

/// The message of one joint and one time, with the time itself: nanoseconds do not
/// hold every time that a log has.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct JointMessage {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub t_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_count: Option<i64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_rad_per_s: Option<f64>,
    #[serde(rename = "command_V")]
    pub command_v: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_rad: Option<f64>,
}

/// The message of one joint's encoder and one time.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct CountMessage {
    pub t_s: f64,
    pub position_count: i64,
}

/// The topic of a joint.
pub(super) fn topic(joint: u8) -> String {
    format!("/joint{joint}")
}

/// The topic of a joint's encoder.
pub(super) fn count_topic(joint: u8) -> String {
    format!("/joint{joint}/count")
}

/// Every field of a joint's messages, with its type and meaning.
pub(super) const FIELDS: [(&str, &str, &str); 7] = [
    ("t_s", "number", "time since the log began [s]"),
    ("position_count", "integer", "position [encoder counts since power-on]"),
    ("position_rad", "number", "position [rad]"),
    ("velocity_rad_per_s", "number", "velocity by differences of positions [rad/s]"),
    ("command_V", "number", "command during the interval that begins here [V]"),
    ("reference_rad", "number", "reference position [rad]"),
    ("error_rad", "number", "reference less position, within half a turn [rad]"),
];

/// The JSON schema of messages like this one, which names the fields that it has.
pub(super) fn schema(title: &str, message: &impl Serialize) -> String {
    let message = serde_json::to_value(message).unwrap_or_default();
    let there = FIELDS.iter().filter(|(name, ..)| message.get(name).is_some());
    let properties: Map<String, Value> = there
        .map(|(name, kind, text)| {
            ((*name).to_owned(), json!({ "type": kind, "description": text }))
        })
        .collect();
    let required: Vec<_> = properties.keys().cloned().collect();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "type": "object",
        "properties": properties,
        "required": required,
    })
    .to_string()
}
