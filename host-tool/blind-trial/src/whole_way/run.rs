//! One robot from its first record to the answer.

use serde::Serialize;

use super::change::changed;
use super::draw::numbers;
use super::identified::{IdentifiedModel, identified};
use super::settings::WholeWaySettings;
use crate::case::Case;
use crate::diverse::{DiagnoseWhole, DiverseCase, DiverseOutcome, Known, diagnose_written};
use crate::error::TrialError;
use crate::logs;
use crate::outcome::RunSettings;
use crate::reality::Reality;
use crate::sealed_truth;
use crate::visibility::Visibility;
use model::Friction;

/// What became of one robot.
#[derive(Clone, Debug, Serialize)]
pub struct WholeWayOutcome {
    /// The robot's own friction parameters.
    pub friction: [Friction<f64>; 3],
    /// The friction that was identified; `None` where identification failed.
    pub identified_friction: Option<[Friction<f64>; 3]>,
    /// What the identified model leaves of the command on the campaign's logs held out, rms of
    /// the worst log of each joint [V].
    #[serde(rename = "held_out_V")]
    pub held_out_v: [f64; 3],
    /// What identification had to remark.
    pub remarks: Vec<String>,
    /// How much the change shows, in parts of what the identified model leaves.
    pub visibility: Option<Visibility>,
    /// Truth and answer.
    #[serde(flatten)]
    pub outcome: DiverseOutcome,
}

/// Records a robot's campaign, identifies it, changes it, records again and has it diagnosed;
/// the diagnosis sees the later logs and the identified model alone.
///
/// # Errors
/// A robot that cannot be recorded, files that cannot be written. What stops a user on his way is
/// an answer: a failed identification, an arm that does not follow with the identified model, a
/// diagnosis that fails.
pub fn walk(
    robot: &Case,
    settings: &WholeWaySettings,
    run: &RunSettings,
    diagnose: DiagnoseWhole,
) -> Result<WholeWayOutcome, TrialError> {
    match to_the_end(robot, settings, run, diagnose) {
        Err(TrialError::Step(error)) => Ok(WholeWayOutcome::failed(robot, &error.to_string())),
        Err(error @ (TrialError::NoModel { .. } | TrialError::NothingDetectable { .. })) => {
            Ok(WholeWayOutcome::failed(robot, &error.to_string()))
        }
        other => other,
    }
}

fn to_the_end(
    robot: &Case,
    settings: &WholeWaySettings,
    run: &RunSettings,
    diagnose: DiagnoseWhole,
) -> Result<WholeWayOutcome, TrialError> {
    let directory = logs::directory(&run.out, robot.number);
    let campaign = directory.join("campaign");
    let found = identified(robot, run.keep_logs.then_some(campaign.as_path()))?;
    let mut rng = numbers(settings.seed, robot.number, 1);
    let after = Case { nominal: found.robot, seed: robot.seed ^ AFTER, ..robot.clone() };
    let case = changed(&after, &settings.only, &mut rng)?;
    logs::write(&case, &directory)?;
    found.file.write(directory.join(logs::MODEL_NAME))?;
    if run.keep_logs {
        sealed_truth::write_truth(&case, &directory)?;
    }
    // The one change is the whole of what can be known.
    let known = vec![Known { share: Some(1.0), oracle: 1.0 }];
    let visibility = case.visibility;
    let diverse = DiverseCase { case, known };
    let outcome = diagnose_written(&diverse, &directory, run.keep_logs, diagnose)?;
    Ok(WholeWayOutcome::of(robot, found, visibility, outcome))
}

/// Makes the noise after the change another than before.
const AFTER: u32 = 0x5A5A_5A5A;

impl WholeWayOutcome {
    fn of(
        robot: &Case,
        found: IdentifiedModel,
        visibility: Option<Visibility>,
        outcome: DiverseOutcome,
    ) -> Self {
        Self {
            friction: robot.robot.friction,
            identified_friction: Some(found.robot.friction),
            held_out_v: found.held_out_v,
            remarks: found.remarks,
            visibility,
            outcome,
        }
    }

    /// A robot whose way ended before the diagnosis.
    fn failed(robot: &Case, why: &str) -> Self {
        Self {
            friction: robot.robot.friction,
            identified_friction: None,
            held_out_v: [0.0; 3],
            remarks: Vec::new(),
            visibility: None,
            outcome: DiverseOutcome {
                case: robot.number,
                kind: robot.kind,
                truth: Vec::new(),
                told_shares: Vec::new(),
                suspects_truth: false,
                known: Vec::new(),
                reality: robot.reality.clone().unwrap_or_else(Reality::plain),
                beside: Vec::new(),
                verdict: "failed".into(),
                failure: Some(why.into()),
                claims: Vec::new(),
                seconds: 0.0,
                processor_seconds: 0.0,
                report: None,
            },
        }
    }
}
