//! Whether samples are served to Foxglove, and where.

use clap::Args;

use crate::failure::Failure;
use crate::live::Server;
use crate::terminal::output::try_print_line;

/// Where a Foxglove WebSocket listens.
#[derive(Clone, Debug, Default, Args)]
pub struct FoxgloveOptions {
    /// Serve the samples as they come to Foxglove, at HOST:PORT; 127.0.0.1:8765 where none is given.
    /// Channels and schemas are those of the MCAP logs.
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "127.0.0.1:8765")]
    pub foxglove: Option<String>,
}

impl FoxgloveOptions {
    /// The server, if one is wanted.
    ///
    /// # Errors
    /// An address that cannot be listened at.
    pub fn start(&self, counts_per_rev: f64) -> Result<Option<Server>, Failure> {
        let Some(address) = &self.foxglove else { return Ok(None) };
        let server = Server::start(address, counts_per_rev)?;
        let host = address.rsplit_once(':').map_or(address.as_str(), |(host, _)| host);
        try_print_line(format_args!("foxglove    ws://{host}:{}", server.port()));
        Ok(Some(server))
    }
}
