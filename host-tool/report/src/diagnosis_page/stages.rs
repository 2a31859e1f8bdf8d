//! The residuals that the pictures compare, before and after.

use diagnosis::gap_by_axis::Samples;
use diagnosis::{Diagnosis, JointResiduals};

/// Residuals of the joints that are drawn, before and after.
pub(super) struct Stages {
    /// What the two are.
    pub names: (&'static str, &'static str),
    /// Whether effects are named.
    pub named: bool,
    /// The two of each joint, over all logs.
    pub joints: Vec<(Samples, Samples)>,
}

/// A joint with less than this share of the largest excess over the noise is not drawn.
const SHOWN_SHARE: f64 = 0.1;

impl Stages {
    /// Without and with the effects; where no effect is named, as given and refitted.
    pub fn of(diagnosis: &Diagnosis) -> Self {
        let named = !diagnosis.report.causes.is_empty();
        let names = if named { ("refitted", "with the effects") } else { ("as given", "refitted") };
        let (logs, criteria) = (&diagnosis.logs, &diagnosis.criteria.axes);
        let before = Samples::of_joints(logs, criteria, |joint| before(joint, named));
        let after = Samples::of_joints(logs, criteria, |joint| after(joint, named));
        let all: Vec<_> = before.into_iter().zip(after).filter(|(b, _)| !b.is_empty()).collect();
        let joints = joints_shown(diagnosis, named, &all);
        Self {
            names,
            named,
            joints: all.into_iter().filter(|(b, _)| joints.contains(&b.joint)).collect(),
        }
    }
}

/// The residual before, by whether effects are named.
pub(super) fn before(joint: &JointResiduals, named: bool) -> &Vec<f64> {
    if named { &joint.refitted_v } else { &joint.given_v }
}

/// The residual after, by whether effects are named.
pub(super) fn after(joint: &JointResiduals, named: bool) -> &Vec<f64> {
    if named { &joint.with_effects_v } else { &joint.refitted_v }
}

/// The joints of the causes, and those with large residuals of the refitted model; all where
/// no residual exceeds the noise.
fn joints_shown(diagnosis: &Diagnosis, named: bool, all: &[(Samples, Samples)]) -> Vec<u8> {
    let excess_v2 = |pair: &(Samples, Samples)| {
        let refitted = if named { &pair.0 } else { &pair.1 };
        refitted.excess_v2()
    };
    let most = all.iter().map(excess_v2).fold(0.0, f64::max);
    let is_cause = |joint: u8| diagnosis.report.causes.iter().any(|cause| cause.joint == joint);
    let wanted = all.iter().filter(|&p| is_cause(p.0.joint) || excess_v2(p) >= SHOWN_SHARE * most);
    wanted.map(|(before, _)| before.joint).collect()
}
