//! What can be wrong with a file, where it is, and what to do about it.

use std::path::{Path, PathBuf};

use model::ParameterError;

/// A file that cannot be used: which one, where in it, and why.
#[derive(Debug, thiserror::Error)]
pub struct FileError {
    /// The file or directory.
    pub path: PathBuf,
    /// Where in the file, as far as that is known.
    pub place: Place,
    /// What is wrong there.
    #[source]
    pub problem: Problem,
}

/// A place in a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// Line, counted from 1.
    pub line: Option<usize>,
    /// Column of a table, by its name.
    pub column: Option<String>,
}

impl Place {
    /// A line, counted from 1.
    pub fn line(line: usize) -> Self {
        Self { line: Some(line), column: None }
    }

    /// A column by its name.
    pub fn column(name: impl Into<String>) -> Self {
        Self { line: None, column: Some(name.into()) }
    }

    /// The same place, narrowed to a column.
    pub fn and_column(self, name: impl Into<String>) -> Self {
        Self { column: Some(name.into()), ..self }
    }
}

/// A problem and its place, before the file's name is known.
#[derive(Debug)]
pub struct LocatedProblem {
    /// Where in the file.
    pub place: Place,
    /// What is wrong there.
    pub problem: Problem,
}

impl LocatedProblem {
    /// The same problem where lines mean nothing.
    pub fn without_line(self) -> Self {
        Self { place: Place { line: None, ..self.place }, ..self }
    }

    /// The error, once the file is known.
    pub fn in_file(self, path: &Path) -> FileError {
        FileError { path: path.to_owned(), place: self.place, problem: self.problem }
    }
}

impl From<Problem> for LocatedProblem {
    fn from(problem: Problem) -> Self {
        problem.at(Place::default())
    }
}

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
    /// A value that does not fit the rest of the file.
    #[error("{0}")]
    Contradiction(String),
}

impl Problem {
    /// The problem at a place, before the file's name is known.
    pub fn at(self, place: Place) -> LocatedProblem {
        LocatedProblem { place, problem: self }
    }

    /// The problem of a whole file.
    pub fn in_file(self, path: &Path) -> FileError {
        LocatedProblem::from(self).in_file(path)
    }

    /// What the user can do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Missing => "check the path for a typing error",
            Self::Unreadable(_) => "check that it is a file and that you may read it",
            Self::Unwritable(_) => {
                "check that the directory exists, has room, and that you may write there"
            }
            Self::UnknownExtension | Self::UnknownTable => "rename the file to what it holds",
            Self::Damaged { .. } => "fetch or record the file again, or export it anew",
            Self::NoTopic(_) => {
                "record the joints' states and commands; `ros2 bag convert` makes MCAP of other storages"
            }
            Self::NoTables(_) => "give the file or folder of the logs",
            Self::Unmapped(_) => {
                "write such lines into dataset.toml, or let `rrr import` write them; docs/imports.md has each key"
            }
            Self::BrokenGzip(_) => "fetch or record the file again; `gzip -t` tests it",
            Self::NotUtf8(_) => "export the file as plain UTF-8 text",
            Self::Empty | Self::NoSamples => "record the file again: it needs at least one sample",
            Self::MissingColumn(_) => "add the column, or correct its name in the header",
            Self::RepeatedColumn => "keep one of the two columns",
            Self::BothPositions(_) => "keep q_count or q_rad, not both",
            Self::NoJoint => "give each joint q1_count (or q1_rad) and u1_V, likewise 2 and 3",
            Self::FieldCount { .. } => "complete the line or delete it; fields are split by commas",
            Self::NotANumber(_) => "write the value as a decimal number with a point, as in -0.125",
            Self::NotFinite(_) => "delete the lines without a value; gaps in time are allowed",
            Self::NotACount(_) => "write whole counts, or name the column q_rad and use radians",
            Self::TimeNotIncreasing { .. } => "sort the lines by t_s and delete repeated ones",
            Self::NegativeTime(_) => "let the time begin at 0, or write .csv",
            Self::UnequalLength { .. } => "give every column one value per time",
            Self::BrokenMcap(_) => "fetch or record the file again; `mcap doctor` tests it",
            Self::BrokenMessage { .. } => "record it again, or convert it to .csv and correct it",
            Self::Toml(_) => "correct the line; strings stand in quotes, numbers do not",
            Self::Setting(_) => {
                "`rrr diagnose --print-criteria` prints every key with its meaning and default"
            }
            Self::UnknownFormat(_) => "update the tool, or write the file with `format = 1`",
            Self::ArmOfAnyKind => {
                "`rrr identify`, `diagnose`, `simulate` and `inverse-dynamics` take it; this command is for \
                 the robot of three joints: give a robot.toml or model.toml with `format = 1`"
            }
            Self::UnknownKey(_) => "correct its name, with the unit, or delete the line",
            Self::Urdf(_) => "correct the URDF, or write the joints into the file without `urdf`",
            Self::MissingParameter(_) => "add it to the file",
            Self::Parameter(_) => "correct the value in the file",
            Self::Contradiction(_) => "correct one of the two",
        }
    }
}

impl FileError {
    /// What the user can do about it.
    pub fn hint(&self) -> &'static str {
        self.problem.hint()
    }
}

impl std::fmt::Display for FileError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some(line) = self.place.line {
            write!(f, ", line {line}")?;
        }
        if let Some(column) = &self.place.column {
            write!(f, ", column {column}")?;
        }
        write!(f, ": {}", self.problem)
    }
}
