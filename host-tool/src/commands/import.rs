//! `rrr import`: a `dataset.toml` for logs of others, from a first look at them.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::output_files::{create_directory, write_text};
use crate::say;
use crate::terminal::answer::answer;
use files::arm_file::DriveKind;
use files::guess::Command;
use files::import::{Draft, draft};
use files::mapping::{self, Mapped, Needs};
use files::{ArmFile, Dataset, RobotFile};
use model::mechanism::JointKind;
use serde_json::json;

/// Arguments of `rrr import`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A log, or a folder of logs: CSV, npz, Parquet, MCAP of rosbag2.
    #[arg(value_name = "PATH")]
    pub path: PathBuf,
    /// Where dataset.toml goes: a directory, or the file itself; by default beside the logs.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// The model that the logs are for: it tells how many joints there are and what drives take.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: Option<PathBuf>,
    /// Replace a dataset.toml that is there.
    #[arg(long)]
    pub force: bool,
}

/// Runs the command.
///
/// # Errors
/// Files that cannot be read or written, or a list that is there already.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let list = arguments.list();
    if list.exists() && !arguments.force {
        let message = format!("{} is there already", list.display());
        return Err(Failure::new(message, "--force replaces it; --out names another place"));
    }
    let directory = list.parent().unwrap_or(Path::new(".")).to_owned();
    let (command, joints) = arguments.drives()?;
    let path = arguments.seen_from(&directory)?;
    let draft = draft(&path, &directory, command, joints)?;
    create_directory(&directory)?;
    write_text(&draft.text, &list)?;
    tell(&draft, &list);
    try_to_read(&directory);
    answer(&json!({ "list": list, "guessed": draft.guessed, "open": draft.open }))
}

impl Arguments {
    /// The list to be written.
    fn list(&self) -> PathBuf {
        const NAME: &str = files::dataset::LIST_NAME;
        match &self.out {
            Some(out) if out.extension().is_some_and(|ending| ending == "toml") => out.clone(),
            Some(out) => out.join(NAME),
            None if self.path.is_dir() => self.path.join(NAME),
            None => self.path.with_file_name(NAME),
        }
    }

    /// The logs' path: beneath the list's directory as it stands, else whole.
    fn seen_from(&self, directory: &Path) -> Result<PathBuf, Failure> {
        if self.path.starts_with(directory) || !self.path.exists() {
            return Ok(self.path.clone());
        }
        std::path::absolute(&self.path)
            .map_err(|error| Failure::new(format!("{}: {error}", self.path.display()), ""))
    }

    /// What the model's drives take, and how many joints there are.
    fn drives(&self) -> Result<(Option<Command>, Option<usize>), Failure> {
        let Some(model) = &self.model else { return Ok((None, None)) };
        if !ArmFile::is_at(model) {
            let robot = RobotFile::read(model)?;
            let joints =
                if robot.pendulum.is_some() && robot.base.is_none() { None } else { Some(3) };
            return Ok((Some(Command::Unit("V")), joints));
        }
        let arm = ArmFile::read(model)?;
        let first = arm.joints.first();
        let slides = first.is_some_and(|joint| joint.kind == JointKind::Prismatic);
        let kind = first.and_then(|joint| joint.drive.as_ref()).map(|drive| drive.kind);
        let command = match kind.unwrap_or_default() {
            DriveKind::Voltage => Command::Unit("V"),
            DriveKind::Current => Command::Unit("A"),
            DriveKind::Torque => Command::Unit(if slides { "N" } else { "Nm" }),
            DriveKind::PositionServo => Command::Goal,
        };
        Ok((Some(command), Some(arm.joints.len())))
    }
}

fn tell(draft: &Draft, list: &Path) {
    say!("Guessed, each with its reason:");
    draft.guessed.iter().for_each(|line| say!("  {line}"));
    if !draft.open.is_empty() {
        say!("\nOpen, with the line to write under [columns]:");
        draft.open.iter().for_each(|line| say!("  {line}"));
    }
    say!("\nWritten: {}; look it through before anything is judged by it.", list.display());
}

/// Reads the logs as the list has them, and says what they are.
fn try_to_read(directory: &Path) {
    let read = Dataset::read(directory).and_then(|dataset| Ok((dataset.mapping()?, dataset)));
    // A list of another name is not read from its directory.
    let Ok((mapping, dataset)) = read else { return };
    say!("");
    let required = ["t_s".to_owned()];
    let needs = Needs { required: &required, beside: "a position and a command of each joint" };
    for (place, entry) in dataset.entries.iter().enumerate() {
        let view = mapping.view(place);
        let file = view.label(&entry.file);
        match mapping::read(directory, &entry.file, &view, needs) {
            Ok(mapped) => say!("  {file}: {}", in_words(mapped)),
            Err(error) => say!("  cannot be read as it stands: {error}"),
        }
    }
}

/// Rows, rate and duration of a log, and what was done to it.
fn in_words(mut mapped: Mapped) -> String {
    let rows = mapped.table.rows();
    let time_s = mapped.table.take_float("t_s").unwrap_or_default();
    let (first_s, last_s) = (time_s.first().unwrap_or(&0.0), time_s.last().unwrap_or(&0.0));
    let lasts_s = last_s - first_s;
    let rate = (rows.max(1) - 1) as f64 / lasts_s.max(1e-9);
    let notes: String = mapped.notes.iter().map(|note| format!("; {note}")).collect();
    format!("{rows} rows in {lasts_s:.2} s, {rate:.1} Hz{notes}")
}
