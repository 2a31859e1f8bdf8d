//! What can be wrong with a file.

use model::ParameterError;

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// Nothing lies at the path.
    #[error("there is no such file")]
    Missing,
    /// The system refuses to read.
    #[error("cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// The system refuses to write.
    #[error("cannot be written: {0}")]
    Unwritable(std::io::Error),
    /// The extension says nothing about the format.
    #[error("the name does not end in .csv, .csv.gz or .mcap")]
    UnknownExtension,
    /// The same of a file in any format.
    #[error(
        "the name does not end in .csv, .tsv, .txt (each also .gz), .npz, .npy, .parquet or .mcap"
    )]
    UnknownTable,
    /// Data of a format that are cut short or damaged.
    #[error("the {format} data cannot be read: {what}")]
    Damaged {
        /// The format's name.
        format: &'static str,
        /// What is wrong with them.
        what: String,
    },
    /// A recording without a topic that can be read; the topics that it has.
    #[error(
        "no topic has messages that are read here (sensor_msgs/msg/JointState and the like, in CDR); topics: {0}"
    )]
    NoTopic(String),
    /// A path below which there is no file that can be read; what was said of each.
    #[error(
        "no log is there that can be read: .csv, .tsv, .txt (each also .gz), .npz, .npy, .parquet or .mcap\n{0}"
    )]
    NoTables(String),
    /// Columns that a log needs and that were not found: what there is, and how to say which is which.
    #[error("{0}")]
    Unmapped(String),
    /// The compressed stream ends early or is damaged.
    #[error("the gzip data is cut short or damaged: {0}")]
    BrokenGzip(std::io::Error),
    /// A byte that is not UTF-8 text.
    #[error("byte 0x{0:02x} is not UTF-8 text")]
    NotUtf8(u8),
    /// No bytes at all.
    #[error("is empty")]
    Empty,
    /// A header and nothing else.
    #[error("holds no samples")]
    NoSamples,
    /// A column that must be there.
    #[error("the column {0} is missing")]
    MissingColumn(String),
    /// A name that stands twice in the header.
    #[error("the column stands twice in the header")]
    RepeatedColumn,
    /// A joint in counts and in radians at once.
    #[error("joint {0} has its position both in counts and in radians")]
    BothPositions(u8),
    /// No joint's columns.
    #[error("no joint is in it")]
    NoJoint,
    /// A log of more joints than its model has.
    #[error("{found} in it, but {model}")]
    MoreJoints {
        /// The joints that the model lacks: "joints 4, 5, 6 are".
        found: String,
        /// What the model has: "the model has joints 1 to 3 alone".
        model: String,
    },
    /// A line with too few or too many fields.
    #[error("the line has {found} fields, but the header has {expected}")]
    FieldCount {
        /// Fields in the line.
        found: usize,
        /// Columns in the header.
        expected: usize,
    },
    /// Text where a number must be.
    #[error("`{0}` is not a number")]
    NotANumber(String),
    /// NaN or infinity.
    #[error("`{0}` is not a finite number")]
    NotFinite(String),
    /// A count with a fraction.
    #[error("`{0}` is not a whole number of encoder counts")]
    NotACount(String),
    /// Time that stands still or goes back.
    #[error("time goes from {before_s} s to {now_s} s, but must increase")]
    TimeNotIncreasing {
        /// Time of the sample before [s].
        before_s: f64,
        /// Time of this sample [s].
        now_s: f64,
    },
    /// A time that the format cannot hold.
    #[error("time {0} s cannot be stored: it must be 0 or more")]
    NegativeTime(f64),
    /// Columns of a log that differ in length.
    #[error("{found} samples, but {expected} times")]
    UnequalLength {
        /// Samples in the column.
        found: usize,
        /// Samples of the time.
        expected: usize,
    },
    /// A damaged MCAP file.
    #[error("the MCAP data is cut short or damaged: {0}")]
    BrokenMcap(#[from] mcap::McapError),
    /// An MCAP message that is not a joint's sample.
    #[error("message {number} on {topic}: {what}")]
    BrokenMessage {
        /// The channel's topic.
        topic: String,
        /// Which message on the channel, from 1.
        number: usize,
        /// What is wrong with it.
        what: String,
    },
    /// TOML that does not parse or does not fit.
    #[error("{0}")]
    Toml(String),
    /// A setting that is not known, or has a value that cannot be used.
    #[error("{0}")]
    Setting(String),
    /// A format number of a later (or no) version.
    #[error("format {0} is not known here: this version reads format 1")]
    UnknownFormat(i64),
    /// A file of the general format where only the special one is read.
    #[error(
        "format 2 is not known here: this version reads format 1, and arms of any kind (format 2) \
         in `rrr inverse-dynamics`, `identify`, `diagnose` and `simulate` alone"
    )]
    ArmOfAnyKind,
    /// A key that its table does not have.
    #[error("{0}")]
    UnknownKey(String),
    /// A URDF that does not parse or does not fit.
    #[error("{0}")]
    Urdf(String),
    /// A value that must be there.
    #[error("{0} is missing")]
    MissingParameter(String),
    /// A value that no robot can have.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// Recorded logs that simulated ones would take the place of.
    #[error("{0}: simulated logs would take their place")]
    RecordedLogs(String),
    /// A value that nothing real has: its key, the value, and what it must be.
    #[error("{0}")]
    OutOfRange(String),
    /// A value that does not fit the rest of the file.
    #[error("{0}")]
    Contradiction(String),
}
