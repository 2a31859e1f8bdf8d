//! `rrr identify STEP`: one step of the procedure with its figures.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use serde::Serialize;

use crate::failure::Failure;
use crate::output_files::{self, create_directory, write_text};
use crate::provenance::provenance;
use crate::say;
use crate::terminal::answer::answer;
use files::{Dataset, Experiment, RobotFile, Role};
use identification::base_parameters::friction::FrictionEstimate;
use identification::presliding::Prior;
use identification::{base_parameters, ekf, presliding, static_friction};
use recordings::{Campaign, StepError, Trace};
use report::Page;
use report::step_page::{base_page, ekf_page, presliding_page, static_page};
use serde_json::json;

/// A step of the procedure.
#[derive(Debug, Subcommand)]
pub enum Step {
    /// Static friction from the runs at constant velocities, section 3.1.
    StaticFriction(StepArguments),
    /// Friction, inertia and gravity of one joint by the augmented EKF, section 3.1.
    Ekf(StepArguments),
    /// Pre-sliding friction from the FRF, section 3.2; a model gives it the mass matrix.
    Presliding(StepArguments),
    /// Base parameters the paper's way, section 4; a model gives it the friction.
    BaseParameters(StepArguments),
}

/// Arguments of every step.
#[derive(Debug, Args)]
pub struct StepArguments {
    /// The data set: a directory with dataset.toml and its logs.
    #[arg(value_name = "DATASET")]
    pub dataset: PathBuf,
    /// The manufacturer's data, or a model with what earlier steps found.
    #[arg(long, value_name = "ROBOT.toml")]
    pub robot: PathBuf,
    /// Directory for the step's .json and .html.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

impl Step {
    /// Runs the step.
    ///
    /// # Errors
    /// Files that cannot be used, or logs that do not hold what the step needs.
    pub fn run(&self) -> Result<(), Failure> {
        match self {
            Self::StaticFriction(arguments) => arguments.static_friction(),
            Self::Ekf(arguments) => arguments.ekf(),
            Self::Presliding(arguments) => arguments.presliding(),
            Self::BaseParameters(arguments) => arguments.base_parameters(),
        }
    }
}

impl StepArguments {
    fn campaign(&self) -> Result<Campaign, Failure> {
        let robot_file = RobotFile::read(&self.robot)?;
        Ok(Campaign::read(&Dataset::read(&self.dataset)?, robot_file)?)
    }

    fn static_friction(&self) -> Result<(), Failure> {
        let campaign = self.campaign()?;
        let found: Result<Vec<_>, StepError> =
            logs(&campaign, Experiment::ConstantVelocity, "static friction", "constant-velocity")?
                .into_iter()
                .map(|(trace, joint)| static_friction::identify(trace, joint, &campaign.known))
                .collect();
        let found = found?;
        self.write("static-friction", &found, &static_page(&found))
    }

    fn ekf(&self) -> Result<(), Failure> {
        let campaign = self.campaign()?;
        let start = ekf::Start::from_log();
        let logs = logs(
            &campaign,
            Experiment::FrictionExcitation,
            "augmented EKF",
            "friction-excitation",
        )?;
        let found: Result<Vec<_>, StepError> = logs
            .into_iter()
            .map(|(trace, joint)| ekf::identify(trace, joint, &campaign.known, &start))
            .collect();
        let found = found?;
        self.write("ekf", &found, &ekf_page(&found))
    }

    fn presliding(&self) -> Result<(), Failure> {
        /// A model that was identified gives the mass matrix that well.
        const MASS_MATRIX_ERROR: f64 = 0.02;
        let campaign = self.campaign()?;
        let base = campaign.robot_file.base;
        let prior = base.map_or_else(Prior::default, |b| Prior::with_base(b, MASS_MATRIX_ERROR));
        let logs =
            logs(&campaign, Experiment::PreslidingNoise, "pre-sliding FRF", "presliding-noise")?;
        let traces: Vec<&Trace> = logs.into_iter().map(|(trace, _)| trace).collect();
        let settings = presliding::Settings::default();
        let results = presliding::identify_all(&traces, &campaign.known, &prior, &settings);
        let found: Result<Vec<_>, StepError> = results.into_iter().map(|(_, r)| r).collect();
        let found = found?;
        self.write("presliding", &found, &presliding_page(&found))
    }

    fn base_parameters(&self) -> Result<(), Failure> {
        let campaign = self.campaign()?;
        let file = &campaign.robot_file;
        let exact = |joint| -> Result<FrictionEstimate, Failure> {
            Ok(FrictionEstimate::exact(file.friction(joint)?))
        };
        let friction = [exact(1)?, exact(2)?, exact(3)?];
        let traces: Vec<&Trace> =
            campaign.traces_of(Experiment::Excitation, Role::Train, None).collect();
        let settings = base_parameters::Settings::paper();
        let found = base_parameters::identify(&traces, &campaign.known, &friction, &settings)?;
        let numbers: std::collections::BTreeMap<_, _> =
            found.estimates.iter().map(|(name, estimate)| (*name, estimate)).collect();
        self.write("base-parameters", &numbers, &base_page(&found))
    }

    fn write(&self, name: &str, numbers: &impl Serialize, page: &Page) -> Result<(), Failure> {
        create_directory(&self.out)?;
        let path = self.out.join(format!("{name}.json"));
        write_text(&output_files::json(numbers, &path)?, &path)?;
        let path = self.out.join(format!("{name}.html"));
        let provenance = provenance(&self.robot, &self.dataset);
        page.clone().provenance(&provenance).write(&path)?;
        say!("Figures: {}", path.display());
        answer(&json!({ "figures": path, "found": numbers }))
    }
}

/// The `train` logs of an experiment on single joints, with their joints.
fn logs<'a>(
    campaign: &'a Campaign,
    experiment: Experiment,
    step: &'static str,
    name: &str,
) -> Result<Vec<(&'a Trace, u8)>, StepError> {
    let traces = campaign.traces_of(experiment, Role::Train, None);
    let joint_of = |trace: &Trace| trace.joint.or_else(|| campaign.known.joints.first().copied());
    let found: Vec<_> = traces.filter_map(|trace| Some((trace, joint_of(trace)?))).collect();
    if found.is_empty() {
        return Err(StepError::NoLog { step, experiment: name.to_owned() });
    }
    Ok(found)
}
