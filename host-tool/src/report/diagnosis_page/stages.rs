//! The residuals that the pictures compare, before and after.

use crate::diagnosis::places::Samples;
use crate::diagnosis::{Diagnosis, JointResiduals};

/// Residuals of the joints that matter, before and after.
pub(super) struct Stages {
    /// What the two are.
    pub names: (&'static str, &'static str),
    /// The two of each joint, over all logs.
    pub joints: Vec<(Samples, Samples)>,
}

/// A joint with less of the largest excess than this part is not drawn.
const MATTERS: f64 = 0.1;

impl Stages {
    /// Without and with the effects; where no effect is named, as given and refitted.
    pub fn of(diagnosis: &Diagnosis) -> Self {
        let named = !diagnosis.report.causes.is_empty();
        let names = if named { ("refitted", "with the effects") } else { ("as given", "refitted") };
        let before = Samples::of_joints(&diagnosis.logs, |joint| before(joint, named));
        let after = Samples::of_joints(&diagnosis.logs, |joint| after(joint, named));
        let all: Vec<_> = before.into_iter().zip(after).filter(|(b, _)| !b.is_empty()).collect();
        let joints = matters(diagnosis, &all);
        Self { names, joints: all.into_iter().filter(|(b, _)| joints.contains(&b.joint)).collect() }
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

/// The joints of the causes, and those with much of the gap; all where there is no gap.
fn matters(diagnosis: &Diagnosis, all: &[(Samples, Samples)]) -> Vec<u8> {
    let most = all.iter().map(|(before, _)| before.excess_v2()).fold(0.0, f64::max);
    let causes = &diagnosis.report.causes;
    let blamed = |joint: u8| causes.iter().any(|cause| cause.joint == joint);
    let of_gap = |samples: &Samples| samples.excess_v2() >= MATTERS * most;
    let wanted = all.iter().filter(|(before, _)| blamed(before.joint) || of_gap(before));
    wanted.map(|(before, _)| before.joint).collect()
}
