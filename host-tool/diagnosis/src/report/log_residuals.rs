//! What is left of the command in every log, for pictures and for the axes of the gap.

use crate::logs::intervals::at_samples;
use crate::logs::subject::Subject;
use crate::result::{JointResiduals, LogResiduals};
use crate::rows::evidence::{Evidence, Rows};
use crate::trial::equation::Trial;
use crate::trial::hypothesis::Hypothesis;
use recordings::Trace;

/// What models leave of all rows [V], and what noise does, rms by joint and stretch [V].
pub struct Stages<'a> {
    /// The model as given.
    pub given_v: &'a Rows,
    /// The refitted model.
    pub refitted_v: &'a Rows,
    /// The model with its causes.
    pub with_effects_v: &'a Rows,
    /// Noise.
    pub noise_v: &'a [Vec<f64>],
}

/// What is left in every stretch; `hypothesis` tells the load.
pub fn log_residuals(
    subject: &Subject,
    evidence: &Evidence,
    traces: &[Trace],
    hypothesis: &Hypothesis,
    stages: &Stages,
) -> Vec<LogResiduals> {
    let of_stretch = |s: usize| {
        let stretch = &evidence.stretches[s];
        let trial = Trial::of(stretch, hypothesis, &subject.criteria.fit);
        let filter = evidence.filter(evidence.joints[0], s);
        let instants: Vec<usize> = filter.instants(stretch.len()).collect();
        let joints = evidence.joints.iter().zip(&subject.numbers);
        let time_s = |k: &usize| stretch.start_s + *k as f64 * stretch.period_s;
        LogResiduals {
            file: traces[stretch.log].file.clone(),
            role: stretch.role,
            time_s: instants.iter().map(time_s).collect(),
            joints: joints
                .map(|(&joint, &number)| {
                    joint_residuals(evidence, s, (joint, number), &instants, &trial, stages)
                })
                .collect(),
        }
    };
    (0..evidence.stretches.len()).map(of_stretch).collect()
}

fn joint_residuals(
    evidence: &Evidence,
    s: usize,
    (joint, number): (usize, u8),
    instants: &[usize],
    trial: &Trial,
    stages: &Stages,
) -> JointResiduals {
    let (stretch, filter) = (&evidence.stretches[s], evidence.filter(joint, s));
    let range = evidence.ranges(joint)[s].clone();
    let of = |rows: &Rows| rows[joint][range.clone()].to_vec();
    let at = |signal: &[f64]| instants.iter().map(|&k| signal[k]).collect();
    JointResiduals {
        joint: number,
        position_rad: at(&stretch.motion.q_rad[joint]),
        velocity_rad_per_s: at(&stretch.motion.qd_rad_per_s[joint]),
        acceleration_rad_per_s2: at(&filter.smooth(&stretch.motion.qdd_rad_per_s2[joint])),
        load_nm: at(&trial.load_nm(joint)),
        command_v: filter.rows(&at_samples(&stretch.command_v[joint])),
        given_v: of(stages.given_v),
        refitted_v: of(stages.refitted_v),
        with_effects_v: of(stages.with_effects_v),
        noise_floor_v: stages.noise_v[joint][s],
    }
}
