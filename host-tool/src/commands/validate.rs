//! `rrr validate`: how well a model reconstructs motion that it was not fitted to.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::options::number::percent;
use crate::output_files::create_directory;
use crate::provenance::provenance;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Steps;
use files::mapping::told;
use files::{Dataset, RobotFile, Role};
use identification::procedure::HeldOutLog;
use recordings::Trace;
use report::validation_page::{HEADER, rows, validation_page};

/// Share of a command's rms of which a model that leaves more of it explains nothing [%]: half.
const LARGEST_SHARE_PERCENT: f64 = 50.0;
/// What may be left of any command [mV rms]: five times the noise of the amplifiers, for a joint that
/// stands needs next to nothing, and noise is then all of it.
const SMALLEST_LEFT_MV: f64 = 20.0;

/// Arguments of `rrr validate`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The data set: a directory with dataset.toml and its logs.
    #[arg(value_name = "DATASET")]
    pub dataset: PathBuf,
    /// The model to judge.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// Directory for validation.html.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// The model does not pass (exit status 1) where it leaves more of a joint's command on any log, in
    /// per cent of its rms ...
    #[arg(long, value_name = "PERCENT", default_value_t = LARGEST_SHARE_PERCENT, value_parser = percent)]
    pub largest_share: f64,
    /// ... and more than this rms in millivolts.
    #[arg(long, value_name = "MV", default_value_t = SMALLEST_LEFT_MV, value_parser = percent)]
    pub smallest_left_mv: f64,
}

/// Runs the command.
///
/// # Errors
/// Files that cannot be used, no log with role "holdout", or a model that does not pass.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let robot = RobotFile::read(&arguments.model)?.robot()?;
    let dataset = Dataset::read(&arguments.dataset)?;
    let steps = Steps::new();
    steps.at("reading the logs");
    let recordings = dataset.recordings_of(Role::Holdout)?;
    if recordings.is_empty() {
        let list = arguments.dataset.join("dataset.toml");
        let message = format!("{}: no log has role \"holdout\"", list.display());
        return Err(Failure::new(message, "give one log that role; the model is judged on it"));
    }
    let of_logs = recordings.iter().map(|r| (r.entry.file.as_str(), r.notes.as_slice()));
    let notes = told(of_logs);
    steps.at("reconstructing");
    let held: Result<Vec<HeldOutLog>, _> = recordings
        .into_iter()
        .map(|recording| HeldOutLog::of(&Trace::of(recording), &robot))
        .collect();
    let held = held?;
    create_directory(&arguments.out)?;
    let page = arguments.out.join("validation.html");
    let mut html = validation_page(&held);
    html.provenance(&provenance(&arguments.model, &arguments.dataset)).write(&page)?;
    steps.finish();
    say!("{}", HEADER.map(|name| format!("{name:>18}")).join(""));
    for row in rows(&held) {
        say!("{}", row.iter().map(|cell| format!("{cell:>18}")).collect::<String>());
    }
    notes.iter().for_each(|note| say!("  note: {note}"));
    say!("\nFigures: {}", page.display());
    let failed = arguments.failed(&held);
    answer(&json!({
        "passed": failed.is_none(),
        "figures": page,
        "logs": held.iter().map(as_json).collect::<Vec<_>>(),
        "notes": notes,
    }))?;
    failed.map_or(Ok(()), Err)
}

/// A log's figures for programs.
fn as_json(held: &HeldOutLog) -> Value {
    let drift_rad = held.prediction_rms_rad();
    let joint = |residual: &identification::base_parameters::JointResidual| {
        json!({
            "joint": residual.joint,
            "left_V": residual.rms_v,
            "command_V": residual.command_rms_v,
            "share": residual.share,
            "drift_rad": drift_rad[usize::from(residual.joint) - 1],
        })
    };
    json!({ "file": held.file, "joints": held.residuals().iter().map(joint).collect::<Vec<_>>() })
}

impl Arguments {
    /// The failure of a model that leaves too much, with the joint of which most is left.
    fn failed(&self, held: &[HeldOutLog]) -> Option<Failure> {
        let left = held.iter().flat_map(|log| log.residuals().into_iter().map(move |r| (log, r)));
        let too_much = left.filter(|(_, residual)| {
            100.0 * residual.share > self.largest_share
                && 1e3 * residual.rms_v > self.smallest_left_mv
        });
        let (log, worst) = too_much.max_by(|a, b| a.1.share.total_cmp(&b.1.share))?;
        let message = format!(
            "{}: the model leaves {:.1} mV of the command of joint {} on {}, {:.0} % of it; {:.0} % and {} mV are \
             allowed",
            self.model.display(),
            1e3 * worst.rms_v,
            worst.joint,
            log.file,
            100.0 * worst.share,
            self.largest_share,
            self.smallest_left_mv
        );
        let hint = "`rrr diagnose` says what differs; is the model that of this robot? --largest-share and \
                    --smallest-left-mv set other limits";
        Some(Failure::not_passed(message, hint))
    }
}
