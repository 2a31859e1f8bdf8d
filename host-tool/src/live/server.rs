//! A Foxglove WebSocket with the channels and schemas of MCAP logs.

use std::ops::Range;
use std::sync::Arc;

use foxglove::{
    ChannelBuilder, Context, PartialMetadata, RawChannel, Schema, WebSocketServerHandle,
};

use crate::failure::Failure;
use files::log::live::{channels, messages};
use files::log::{Channel, unix_ns};
use files::{BoardSample, Log};

/// Messages that wait for a client before the oldest are lost: four seconds of three joints and the
/// board at a kilohertz.
const BACKLOG: usize = 16 * 1024;

/// Serves samples to whoever connects. Sending waits for nobody: what a client does not take in time is
/// lost to it.
pub struct Server {
    context: Arc<Context>,
    handle: Option<WebSocketServerHandle>,
    joints: Vec<Arc<RawChannel>>,
    board: Arc<RawChannel>,
    counts_per_rev: f64,
    /// When the log that is sent began, since 1970.
    began_ns: u64,
}

impl Server {
    /// Listens at HOST:PORT; port 0 is one that is free.
    ///
    /// # Errors
    /// An address that is none, or that cannot be listened at.
    pub fn start(address: &str, counts_per_rev: f64) -> Result<Self, Failure> {
        let (host, port) = host_and_port(address)?;
        let context = Context::new();
        let board = channel(&context, Channel::of_board())?;
        let server = context.websocket_server().name("rrr").bind(host, port);
        let started = server.message_backlog_size(BACKLOG).start_blocking();
        let handle = Some(started.map_err(|error| not_served(address, &error))?);
        let began_ns = unix_ns();
        Ok(Self { context, handle, joints: Vec::new(), board, counts_per_rev, began_ns })
    }

    /// The port that it listens at.
    pub fn port(&self) -> u16 {
        self.handle.as_ref().map_or(0, WebSocketServerHandle::port)
    }

    /// Whether somebody has subscribed to every channel of the joints.
    pub fn is_heard(&self) -> bool {
        !self.joints.is_empty() && self.joints.iter().all(|channel| channel.has_sinks())
    }

    /// A log begins now.
    pub fn begin(&mut self) {
        self.began_ns = unix_ns();
    }

    /// Sends some rows of a log and of what the board reported beside them.
    pub fn send(&mut self, log: &Log, board: &[BoardSample], rows: Range<usize>) {
        if rows.is_empty() {
            return;
        }
        if self.joints.is_empty() {
            let of_log = channels(log, Some(self.counts_per_rev)).into_iter();
            // A schema that is text cannot be refused.
            self.joints = of_log.filter_map(|one| channel(&self.context, one).ok()).collect();
        }
        for message in messages(log, rows.clone(), Some(self.counts_per_rev)) {
            if let Some(channel) = self.joints.get(message.channel) {
                self.send_one(channel, message.t_s, &message.json);
            }
        }
        for sample in board.iter().take(rows.end).skip(rows.start) {
            let json = serde_json::to_vec(sample).unwrap_or_default();
            self.send_one(&self.board, sample.t_s, &json);
        }
    }

    fn send_one(&self, channel: &RawChannel, t_s: f64, json: &[u8]) {
        let log_time = self.began_ns.saturating_add((t_s * 1e9).round() as u64);
        channel.log_with_meta(json, PartialMetadata::with_log_time(log_time));
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        if let Some(handle) = self.handle.take() {
            handle.stop().wait_blocking();
        }
    }
}

fn channel(context: &Arc<Context>, channel: Channel) -> Result<Arc<RawChannel>, Failure> {
    let Channel { topic, schema_name, schema } = channel;
    let schema = Schema::new(schema_name, "jsonschema", schema.into_bytes());
    let builder = ChannelBuilder::new(topic.clone()).context(context).message_encoding("json");
    builder.schema(schema).build_raw().map_err(|error| not_served(&topic, &error))
}

/// HOST:PORT, an IPv6 host in brackets.
fn host_and_port(address: &str) -> Result<(String, u16), Failure> {
    let parts = address.rsplit_once(':').and_then(|(host, port)| Some((host, port.parse().ok()?)));
    let (host, port) = parts.ok_or_else(|| {
        Failure::new(
            format!("--foxglove={address}: not HOST:PORT"),
            "write --foxglove, or --foxglove=127.0.0.1:8765",
        )
    })?;
    Ok((host.trim_matches(['[', ']']).to_owned(), port))
}

fn not_served(what: &str, error: &foxglove::FoxgloveError) -> Failure {
    Failure::new(
        format!("Foxglove cannot be served at {what}: {error}"),
        "another program may listen there: take another port, --foxglove=127.0.0.1:8766",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_hosts_with_ports() {
        assert_eq!(host_and_port("127.0.0.1:0").unwrap(), ("127.0.0.1".to_owned(), 0));
        assert_eq!(host_and_port("[::1]:8765").unwrap(), ("::1".to_owned(), 8765));
        for wrong in ["8765", "host:", "host:99999", ""] {
            assert!(host_and_port(wrong).unwrap_err().to_string().contains("HOST:PORT"), "{wrong}");
        }
    }
}
