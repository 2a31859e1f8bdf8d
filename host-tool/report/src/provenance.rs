//! Where a page comes from.

/// What a page says of its own making.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// The model's file, with the hash of its content.
    pub model: String,
    /// The data set's folder, with the hash of its content.
    pub dataset: String,
    /// Date and time.
    pub date: String,
    /// Version of the tool.
    pub version: String,
    /// The command line.
    pub command_line: String,
}
