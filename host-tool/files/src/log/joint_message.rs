//! One joint's sample as an MCAP message: JSON under a JSON schema.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{JointLog, Position};

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
    #[serde(rename = "command_V")]
    pub command_v: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_rad: Option<f64>,
}

impl JointMessage {
    /// The message of a joint's row.
    pub(super) fn of(joint: &JointLog, row: usize, time_s: f64) -> Self {
        let (position_count, position_rad) = match &joint.position {
            Position::Count(counts) => (Some(counts[row]), None),
            Position::Radian(angles) => (None, Some(angles[row])),
        };
        Self {
            t_s: Some(time_s),
            position_count,
            position_rad,
            command_v: joint.command_v[row],
            reference_rad: joint.reference_rad.as_ref().map(|values| values[row]),
        }
    }
}

/// The topic of a joint.
pub(super) fn topic(joint: u8) -> String {
    format!("/joint{joint}")
}

/// The channel of a joint's messages, with their schema.
pub(super) fn channel(joint: &JointLog) -> mcap::Channel<'static> {
    let schema = mcap::Schema {
        // Schemas count from 1, 0 means none.
        id: u16::from(joint.joint),
        name: format!("Joint{}Sample", joint.joint),
        encoding: "jsonschema".to_owned(),
        data: Cow::Owned(schema(joint).to_string().into_bytes()),
    };
    mcap::Channel {
        id: u16::from(joint.joint),
        topic: topic(joint.joint),
        schema: Some(Arc::new(schema)),
        message_encoding: "json".to_owned(),
        metadata: BTreeMap::new(),
    }
}

/// The JSON schema of a joint's messages.
fn schema(joint: &JointLog) -> Value {
    let property = |kind: &str, text: &str| json!({ "type": kind, "description": text });
    let mut properties = Map::new();
    let mut add = |name: &str, value| properties.insert(name.to_owned(), value);
    add("t_s", property("number", "time [s]"));
    match joint.position {
        Position::Count(_) => {
            add("position_count", property("integer", "position [encoder counts since power-on]"))
        }
        Position::Radian(_) => add("position_rad", property("number", "position [rad]")),
    };
    add("command_V", property("number", "command during the interval that begins here [V]"));
    if joint.reference_rad.is_some() {
        add("reference_rad", property("number", "reference position [rad]"));
    }
    let required: Vec<_> = properties.keys().cloned().collect();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": format!("Joint {} sample", joint.joint),
        "type": "object",
        "properties": properties,
        "required": required,
    })
}
