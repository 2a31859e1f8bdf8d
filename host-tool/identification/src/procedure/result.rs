//! The result of the procedure.

use model::Robot;

use crate::base_parameters::{BaseResult, JointResidual};
use crate::ekf::EkfResult;
use crate::friction_law::{FrictionLaw, Law};
use crate::physical::Physical;
use crate::prediction::{Prediction, predict};
use crate::presliding::Presliding;
use crate::reconstruction::{Reconstruction, reconstruct};
use crate::refinement::{self, Refined};
use crate::static_friction::StaticFriction;
use recordings::{StepError, Trace};
use signal::rms;

/// The result of all steps.
#[derive(Clone, Debug)]
pub struct Identified {
    /// Static friction, where there was a run at constant velocities.
    pub statics: [Option<StaticFriction>; 3],
    /// What the augmented filter made of the friction excitation of joint 3.
    pub filtered: Option<EkfResult>,
    /// Pre-sliding friction, where there was noise.
    pub presliding: Vec<Presliding>,
    /// The law of friction of each joint, with the figures that decided.
    pub laws: [FrictionLaw; 3],
    /// Base parameters the paper's way.
    pub paper: BaseResult,
    /// Base parameters by weighted least squares on filtered sides.
    pub base: BaseResult,
    /// All parameters together.
    pub refined: Refined,
    /// The nearest parameters that rigid links have; the model takes them where they are
    /// within the errors of the refinement.
    pub physical: Option<Physical>,
    /// The model.
    pub robot: Robot<f64>,
    /// The commands of the logs held out, reconstructed.
    pub held_out: Vec<HeldOutLog>,
    /// What could not be done, and why.
    pub missing: Vec<String>,
}

/// A log held out.
#[derive(Clone, Debug)]
pub struct HeldOutLog {
    /// Its file.
    pub file: String,
    /// Its unbroken stretches, reconstructed.
    pub stretches: Vec<Reconstruction>,
    /// The motion that the model predicts from the commands.
    pub predictions: Vec<Prediction>,
}

impl HeldOutLog {
    /// A log's command and motion by a model.
    ///
    /// # Errors
    /// A log that lacks a joint or is nowhere unbroken for a second.
    pub fn of(trace: &Trace, robot: &Robot<f64>) -> Result<Self, StepError> {
        let rows = refinement::Settings::default().rows;
        Ok(Self {
            file: trace.file.clone(),
            stretches: reconstruct(trace, robot, &rows)?,
            predictions: predict(trace, robot)?,
        })
    }

    /// Root mean square of each joint's predicted less measured angle [rad].
    pub fn prediction_rms_rad(&self) -> [f64; 3] {
        [0, 1, 2].map(|joint| {
            let all = self.predictions.iter().flat_map(|p| p.error_rad[joint].iter().copied());
            rms(&all.collect::<Vec<f64>>())
        })
    }

    /// What is left of each joint's command over the whole log.
    pub fn residuals(&self) -> Vec<JointResidual> {
        let over_all = |joint: usize, pick: fn(&JointResidual) -> f64| {
            let weighted = self.stretches.iter().map(|stretch| {
                let instants = stretch.time_s.len() as f64;
                (instants, instants * pick(&stretch.joints[joint].residual).powi(2))
            });
            let (count, power) = weighted.fold((0.0, 0.0), |(n, p), (m, q)| (n + m, p + q));
            f64::sqrt(power / f64::max(count, 1.0))
        };
        let joint = |index: usize| {
            let rms_v = over_all(index, |residual| residual.rms_v);
            JointResidual::new(index as u8 + 1, rms_v, over_all(index, |r| r.command_rms_v))
        };
        (0..3).map(joint).collect()
    }
}

impl Identified {
    /// Names where what was found cannot be trusted.
    pub(super) fn note_contradictions(&mut self) {
        if let Err(error) = self.robot.checked() {
            self.missing.push(format!("no robot has these parameters: {error}"));
        }
        if self.physical.as_ref().is_some_and(|found| !found.consistent) {
            self.missing
                .push("no rigid links have these base parameters within their errors".into());
        }
        for law in self.laws.iter().filter(|law| law.law == Law::Static) {
            self.missing.push(format!(
                "joint {} has static friction: its sigma0 is the least that the data bear, its \
                 sigma1 is alpha2",
                law.joint
            ));
        }
        if !self.refined.converged {
            self.missing.push("the refinement has not converged; its errors are too small".into());
        }
    }
}
