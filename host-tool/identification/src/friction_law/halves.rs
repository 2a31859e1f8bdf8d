//! Logs cut in halves.

use recordings::campaign::{JointTrace, Trace};

/// Logs to fit, and the others.
pub(super) struct Fold {
    /// What is fitted.
    pub fitted: Vec<Trace>,
    /// What is predicted.
    pub predicted: Vec<Trace>,
}

/// First halves to predict the second ones, and the other way round.
pub(super) fn halves(traces: &[&Trace]) -> [Fold; 2] {
    let middle = |trace: &Trace| trace.time_s.len() / 2;
    let first: Vec<Trace> = traces.iter().map(|t| part(t, 0, middle(t))).collect();
    let second: Vec<Trace> = traces.iter().map(|t| part(t, middle(t), t.time_s.len())).collect();
    [
        Fold { fitted: first.clone(), predicted: second.clone() },
        Fold { fitted: second, predicted: first },
    ]
}

fn part(trace: &Trace, from: usize, to: usize) -> Trace {
    let cut = |column: &[f64]| column[from.min(column.len())..to.min(column.len())].to_vec();
    let joints = trace.joints.iter().map(|joint| JointTrace {
        number: joint.number,
        q_rad: cut(&joint.q_rad),
        command_v: cut(&joint.command_v),
        reference_rad: joint.reference_rad.as_deref().map(cut),
    });
    Trace {
        file: trace.file.clone(),
        joints: joints.collect(),
        time_s: cut(&trace.time_s),
        ..*trace
    }
}
