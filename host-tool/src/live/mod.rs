//! What the board sends, served to Foxglove while the arm moves.

mod server;
mod watched;

pub use server::Server;
pub use watched::Watched;
