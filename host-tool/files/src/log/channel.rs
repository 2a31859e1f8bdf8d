//! What a channel of a log's messages is called and holds; the same in MCAP files and live.

use super::board_message;

/// A channel of JSON messages.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its topic.
    pub topic: String,
    /// Its schema's name.
    pub schema_name: String,
    /// Its JSON schema.
    pub schema: String,
}

impl Channel {
    /// The board's own.
    pub fn of_board() -> Self {
        Self {
            topic: board_message::TOPIC.to_owned(),
            schema_name: board_message::NAME.to_owned(),
            schema: board_message::schema(),
        }
    }
}
