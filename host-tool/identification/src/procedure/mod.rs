//! The whole procedure: what feeds what, and what to do when an experiment is missing.
//!
//! static friction -> base parameters -> pre-sliding FRF -> laws of friction -> all together ->
//! validation.
//! The FRF needs the mass matrix, the base parameters need friction; the bristles that
//! the static step finds along are good enough for the first round.

mod one_joint;
mod priors;
mod result;
mod table;

pub use one_joint::{OneJointIdentified, identify_one_joint};
pub use result::{HeldOutLog, Identified};
pub use table::model_file;

use model::{Geometry, Robot};
use rayon::prelude::*;

use super::base_parameters::{self, BaseResult, FrictionEstimate};
use super::ekf::{self, EkfResult};
use super::friction_law::{self, Law};
use super::physical::{self, Physical};
use super::presliding::{self, Presliding, Prior};
use super::refinement::{self, Refined};
use super::static_friction::{self, StaticFriction};
use files::{Experiment, Role};
use recordings::plausibility;
use recordings::{Campaign, StepError, Trace};

/// Runs all steps on the `train` logs and judges the model on the `holdout` logs.
///
/// `progress` is called with the name of each step. Experiments that are missing are named in the
/// result's `missing`; what needs them is done without, or not at all.
///
/// ```no_run
/// use files::{Dataset, RobotFile};
/// use identification::procedure::{identify, model_file};
/// use recordings::Campaign;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let robot = RobotFile::read("campaign/robot.toml")?;
/// let campaign = Campaign::read(&Dataset::read("campaign")?, robot.clone())?;
/// let identified = identify(&campaign, &|step| println!("{step}"))?;
/// model_file(&identified, &robot).write("model.toml")?;
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// No excitation, or one that cannot be used: without it there is no model.
pub fn identify(campaign: &Campaign, progress: &dyn Fn(&str)) -> Result<Identified, StepError> {
    let geometry = geometry(campaign)?;
    progress("examining the logs");
    let mut missing = examine_all(campaign)?;
    progress("static friction");
    let (statics, filtered) =
        rayon::join(|| static_friction_of_all(campaign), || filtered(campaign));
    let statics = separated(statics, &mut missing);
    let [filtered] = separated([filtered], &mut missing);
    let filtered_of = |i: usize| filtered.as_ref().filter(|f| usize::from(f.joint) == i + 1);
    let mut friction = [0, 1, 2].map(|i| priors::of_joint(statics[i].as_ref(), filtered_of(i)));
    let still = [0, 1, 2].map(|i| priors::without_bristles(statics[i].as_ref(), filtered_of(i)));
    progress("base parameters");
    let excitations: Vec<&Trace> =
        campaign.traces_of(Experiment::Excitation, Role::Train, None).collect();
    let (paper, base) = both_base(campaign, &excitations, &friction)?;
    progress("pre-sliding friction");
    let prior = priors::of_presliding(&base, &statics);
    let presliding = presliding_of_all(campaign, &prior, &mut missing);
    for found in &presliding {
        priors::take_bristles(&mut friction[usize::from(found.joint) - 1], found);
    }
    progress("laws of friction");
    let known = &campaign.known;
    let (laws, friction) =
        friction_law::choose(&excitations, known, &friction, &still, &presliding);
    progress("all parameters together");
    let mut refined = refinement::refine(
        &excitations,
        &campaign.known,
        &friction,
        &refinement::Settings::default(),
    )?;
    for joint in (0..3).filter(|&i| laws[i].law == Law::Static) {
        friction_law::note_chosen_bristles(&mut refined, joint);
    }
    progress("rigid links");
    let physical = physical::nearest(&refined.base, &refined.base_covariance, &geometry);
    let robot = model(campaign, geometry, &refined, physical.as_ref());
    progress("validation");
    let held_out = held_out(campaign, &robot);
    let mut identified = Identified {
        statics,
        filtered,
        presliding,
        laws,
        paper,
        base,
        refined,
        physical,
        robot,
        held_out,
        missing,
    };
    identified.note_contradictions();
    Ok(identified)
}

/// The refined parameters, or the nearest physical ones where they can take their place.
fn model(
    campaign: &Campaign,
    geometry: Geometry<f64>,
    refined: &Refined,
    physical: Option<&Physical>,
) -> Robot<f64> {
    let rigid = physical.filter(|found| found.consistent && found.positive_definite);
    Robot {
        geometry,
        base: rigid.map_or(refined.base, |found| found.base),
        torque_constant_nm_per_v: [1, 2, 3].map(|j| campaign.known.torque_constant(j)),
        friction: refined.friction,
    }
}

/// Remarks on all logs.
fn examine_all(campaign: &Campaign) -> Result<Vec<String>, StepError> {
    let traces = &campaign.traces;
    let examined: Result<Vec<Vec<String>>, StepError> =
        traces.par_iter().map(|trace| plausibility::examine(trace, &campaign.known)).collect();
    Ok(examined?.into_iter().flatten().collect())
}

fn geometry(campaign: &Campaign) -> Result<Geometry<f64>, StepError> {
    campaign.known.geometry.ok_or_else(|| StepError::Numerical {
        step: "identify",
        what: "this rig has one joint; the procedure for three joints cannot run on it".into(),
    })
}

/// Static friction of each joint from its run at constant velocities.
fn static_friction_of_all(campaign: &Campaign) -> [Result<StaticFriction, StepError>; 3] {
    let one = |joint: u8| {
        let trace = first_log(campaign, Experiment::ConstantVelocity, joint, "static friction")?;
        static_friction::identify(trace, joint, &campaign.known)
    };
    let (first, (second, third)) = rayon::join(|| one(1), || rayon::join(|| one(2), || one(3)));
    [first, second, third]
}

/// The augmented filter on the friction excitation of joint 3, section 3.1.
fn filtered(campaign: &Campaign) -> Result<EkfResult, StepError> {
    let trace = first_log(campaign, Experiment::FrictionExcitation, 3, "augmented EKF")?;
    ekf::identify(trace, 3, &campaign.known, &ekf::Start::from_log())
}

/// The first `train` log of an experiment on a joint.
fn first_log<'a>(
    campaign: &'a Campaign,
    experiment: Experiment,
    joint: u8,
    step: &'static str,
) -> Result<&'a Trace, StepError> {
    let name = match experiment {
        Experiment::ConstantVelocity => "constant-velocity",
        Experiment::FrictionExcitation => "friction-excitation",
        _ => "presliding-noise",
    };
    let no_log = || StepError::NoLog { step, experiment: format!("{name} of joint {joint}") };
    campaign.traces_of(experiment, Role::Train, Some(joint)).next().ok_or_else(no_log)
}

/// The results; errors go into `missing`.
fn separated<T, const N: usize>(
    results: [Result<T, StepError>; N],
    missing: &mut Vec<String>,
) -> [Option<T>; N] {
    results.map(|result| result.map_err(|error| missing.push(error.to_string())).ok())
}

/// The paper's plain least squares, and the weighted one that goes on.
fn both_base(
    campaign: &Campaign,
    excitations: &[&Trace],
    friction: &[FrictionEstimate; 3],
) -> Result<(BaseResult, BaseResult), StepError> {
    let solve = |settings: base_parameters::Settings| {
        base_parameters::identify(excitations, &campaign.known, friction, &settings)
    };
    let (paper, weighted) = rayon::join(
        || solve(base_parameters::Settings::paper()),
        || solve(base_parameters::Settings::default()),
    );
    Ok((paper?, weighted?))
}

fn presliding_of_all(
    campaign: &Campaign,
    prior: &Prior,
    missing: &mut Vec<String>,
) -> Vec<Presliding> {
    let traces: Vec<&Trace> =
        campaign.traces_of(Experiment::PreslidingNoise, Role::Train, None).collect();
    for joint in 1..=3 {
        if traces.iter().all(|trace| trace.joint != Some(joint)) {
            let experiment = format!("presliding-noise of joint {joint}");
            let error = StepError::NoLog { step: "pre-sliding FRF", experiment };
            missing.push(error.to_string());
        }
    }
    let settings = presliding::Settings::default();
    let results = presliding::identify_all(&traces, &campaign.known, prior, &settings);
    let mut all = Vec::new();
    for (_, result) in results {
        match result {
            Ok(found) => all.push(found),
            Err(error) => missing.push(error.to_string()),
        }
    }
    all
}

/// The command of each `holdout` log, reconstructed.
fn held_out(campaign: &Campaign, robot: &Robot<f64>) -> Vec<HeldOutLog> {
    let traces: Vec<&Trace> =
        campaign.traces.iter().filter(|trace| trace.role == Role::Holdout).collect();
    traces.par_iter().filter_map(|trace| HeldOutLog::of(trace, robot).ok()).collect()
}
