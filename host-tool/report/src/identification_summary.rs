//! `identification.json`.

use std::collections::BTreeMap;

use serde::Serialize;

use identification::Estimate;
use identification::base_parameters::JointResidual;
use identification::ekf::EkfResult;
use identification::friction_law::FrictionLaw;
use identification::presliding::Presliding;
use identification::procedure::Identified;
use identification::static_friction::StaticFriction;

/// What the procedure found, in numbers.
#[derive(Debug, Serialize)]
pub struct Summary<'a> {
    /// Version of the layout.
    pub format: u32,
    /// Base parameters.
    pub base: BTreeMap<&'static str, &'a Estimate>,
    /// Friction, joint by joint.
    pub friction: Vec<BTreeMap<&'static str, &'a Estimate>>,
    /// The law of friction of each joint, with the figures that decided.
    pub friction_laws: &'a [FrictionLaw],
    /// Condition number J_k of the recorded excitation.
    pub condition_number: f64,
    /// Base parameters the paper's way.
    pub base_paper: BTreeMap<&'static str, &'a Estimate>,
    /// The step at constant velocities.
    pub static_friction: Vec<&'a StaticFriction>,
    /// The augmented filter on the friction excitation.
    pub filtered: Option<&'a EkfResult>,
    /// The FRF.
    pub presliding: &'a [Presliding],
    /// By how much each joint's command acts later than logged [s].
    pub command_lag_s: [f64; 3],
    /// What is left on the logs held out.
    pub holdout: BTreeMap<&'a str, Vec<JointResidual>>,
    /// What could not be done, and why.
    pub missing: &'a [String],
}

impl<'a> Summary<'a> {
    /// The numbers of a result.
    pub fn of(identified: &'a Identified) -> Self {
        let refined = &identified.refined;
        Self {
            format: 1,
            base: by_name(&refined.base_estimates),
            friction: refined.friction_estimates.iter().map(|e| by_name(e)).collect(),
            friction_laws: &identified.laws,
            condition_number: identified.paper.condition_number,
            base_paper: by_name(&identified.paper.estimates),
            static_friction: identified.statics.iter().flatten().collect(),
            filtered: identified.filtered.as_ref(),
            presliding: &identified.presliding,
            command_lag_s: refined.command_lag_s,
            holdout: identified.held_out.iter().map(|h| (h.file.as_str(), h.residuals())).collect(),
            missing: &identified.missing,
        }
    }
}

fn by_name<'a>(estimates: &'a [(&'static str, Estimate)]) -> BTreeMap<&'static str, &'a Estimate> {
    estimates.iter().map(|(name, estimate)| (*name, estimate)).collect()
}
