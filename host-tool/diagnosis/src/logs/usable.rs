//! Which logs a diagnosis can use, and what must be said of them.

use super::lost_samples::stretches_of;
use super::stamps::evened_where_smoother;
use super::stretch::Stretch;
use super::subject::Subject;
use crate::criteria::LogCriteria;
use crate::logs::checks::{cannot_be_judged, others_move};
use files::Role;
use recordings::campaign::JointTrace;
use recordings::plausibility::examine;
use recordings::wrong_positions::Impossible;
use recordings::{StepError, Trace, wrong_positions};

/// The stretches that can be used, and remarks on the logs.
#[derive(Debug)]
pub struct Usable {
    /// Stretches of train logs and of those held out.
    pub stretches: Vec<Stretch>,
    /// What a reader must know.
    pub remarks: Vec<String>,
}

impl Usable {
    /// The logs that hold all joints of the rig and can be what they say.
    ///
    /// # Errors
    /// There is none, or none that says enough.
    pub fn of(traces: &[Trace], subject: &Subject) -> Result<Self, StepError> {
        let mut usable = Self { stretches: Vec::new(), remarks: Vec::new() };
        let mut refusal = None;
        for (index, trace) in traces.iter().enumerate() {
            match usable.stretches_of(trace, index, subject) {
                Ok(stretches) => usable.stretches.extend(stretches),
                Err(error) => {
                    usable.remarks.push(format!("left out: {error}"));
                    refusal = refusal.or(Some(error));
                }
            }
        }
        if usable.stretches.is_empty() {
            return Err(refusal.unwrap_or_else(|| no_log(traces)));
        }
        usable.hold_some_out(&subject.criteria.logs)?;
        Ok(usable)
    }

    fn stretches_of(
        &mut self,
        trace: &Trace,
        index: usize,
        subject: &Subject,
    ) -> Result<Vec<Stretch>, StepError> {
        let unusable = |what: String| StepError::Unusable { file: trace.file.clone(), what };
        if let Some(why) = lacks_a_joint(trace, subject) {
            return Err(unusable(why));
        }
        let mut trace = trace.clone();
        if let Some(why) = others_move(&trace, subject) {
            return Err(unusable(why));
        }
        trace.joints.retain(|joint| subject.numbers.contains(&joint.number));
        for joint in &mut trace.joints {
            if !subject.slides(joint.number) {
                self.remarks.extend(unwrap(&trace.file, joint, &subject.criteria.logs));
            }
        }
        self.remarks.extend(put_on_even_clock(&mut trace, &subject.criteria.logs));
        self.remarks.extend(put_right(&mut trace, subject));
        let remarks = examine(&trace, &subject.known)?;
        if let Some(why) = cannot_be_judged(&trace, subject) {
            return Err(unusable(why));
        }
        self.remarks.extend(remarks);
        let stretches = stretches_of(&trace, index, subject);
        if stretches.is_empty() {
            return Err(unusable(
                "gaps leave no second and a half of it that can be used; record it without losing \
                 samples"
                    .into(),
            ));
        }
        self.remarks.extend(lost(&trace, &stretches, &subject.criteria.logs));
        Ok(stretches)
    }

    /// Parts every stretch where there are only train logs or none.
    fn hold_some_out(&mut self, criteria: &LogCriteria) -> Result<(), StepError> {
        let roles: Vec<Role> = self.stretches.iter().map(|stretch| stretch.role).collect();
        let missing = match (roles.contains(&Role::Train), roles.contains(&Role::Holdout)) {
            (true, true) => return Ok(()),
            (true, false) => "is held out",
            _ => "is for training",
        };
        let whole = std::mem::take(&mut self.stretches).into_iter();
        let parted: Vec<Stretch> = whole.flat_map(|stretch| parted(stretch, criteria)).collect();
        if !parted.iter().any(|stretch| stretch.role == Role::Holdout) {
            return Err(StepError::Numerical {
                step: "diagnosis",
                what: format!(
                    "no log {missing}, and none is long enough to be parted; record one of \
                     {} s or more",
                    criteria.shortest_to_part_s
                ),
            });
        }
        self.stretches = parted;
        self.remarks.push(format!(
            "no log {missing}, so the last {:.0} % of each log are held out; a log of another \
             motion would say more",
            100.0 * criteria.held_out_part
        ));
        Ok(())
    }
}

/// Why a log cannot be used that does not hold all joints of the rig.
fn lacks_a_joint(trace: &Trace, subject: &Subject) -> Option<String> {
    let number = subject.numbers.iter().find(|&&number| trace.joint(number).is_none())?;
    let rig = subject.numbers.len();
    Some(format!(
        "q{number} and u{number} are not in the log, but the model has {}; give the model of this rig, \
         or a log of all its joints",
        if rig == 1 { format!("joint {number}") } else { format!("{rig} joints") }
    ))
}

fn no_log(traces: &[Trace]) -> StepError {
    let what = match traces.len() {
        0 => "the data set lists no log",
        _ => "no log can be used",
    };
    StepError::Numerical { step: "diagnosis", what: format!("{what}; list one in dataset.toml") }
}

/// Takes an even clock for times that jitter more than the samples do, and says so.
fn put_on_even_clock(trace: &mut Trace, criteria: &LogCriteria) -> Option<String> {
    let angles: Vec<&[f64]> = trace.joints.iter().map(|joint| &joint.q_rad[..]).collect();
    let even_s = evened_where_smoother(&trace.time_s, trace.period_s, &angles, criteria)?;
    trace.time_s = even_s;
    Some(format!(
        "{}: the motion is smoother over an even clock than over t_s: the times jitter, not the \
         samples, and the even clock was taken",
        trace.file
    ))
}

/// Puts right positions that are wrong for one sample, and says so.
fn put_right(trace: &mut Trace, subject: &Subject) -> Vec<String> {
    let least_steps = subject.criteria.logs.least_wrong_steps;
    let Trace { file, time_s, joints, .. } = trace;
    let of_joint = |joint: &mut JointTrace| {
        let largest_v = joint.command_v.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
        let acceleration_rad_per_s2 = subject.fastest_rad_per_s2(joint.number, largest_v);
        let steps_rad = least_steps * subject.encoder_step_rad(joint.number);
        let impossible = Impossible { steps_rad, acceleration_rad_per_s2 };
        let settings = Default::default();
        let places = wrong_positions::correct(time_s, &mut joint.q_rad, &impossible, &settings);
        let first_s = time_s[*places.first()?];
        Some(format!(
            "{file}: {} of the positions of joint {} are wrong, the first at {first_s:.3} s; they were \
             put where their neighbours say",
            places.len(),
            joint.number
        ))
    };
    joints.iter_mut().filter_map(of_joint).collect()
}

/// What is said where gaps cost a good part of a log.
fn lost(trace: &Trace, stretches: &[Stretch], criteria: &LogCriteria) -> Option<String> {
    let whole_s = trace.time_s.last()? - trace.time_s.first()?;
    let used_s: f64 = stretches.iter().map(Stretch::duration_s).sum();
    (used_s < criteria.remark_below_part * whole_s).then(|| {
        format!("{}: gaps leave {used_s:.1} s of {whole_s:.1} s that can be used", trace.file)
    })
}

/// A stretch as one to train on and one held out, where it is long enough.
fn parted(stretch: Stretch, criteria: &LogCriteria) -> Vec<Stretch> {
    if stretch.duration_s() < criteria.shortest_to_part_s {
        return vec![Stretch { role: Role::Train, ..stretch }];
    }
    let cut = ((1.0 - criteria.held_out_part) * stretch.len() as f64) as usize;
    let train = Stretch { role: Role::Train, ..stretch.part(0..cut) };
    let holdout = Stretch { role: Role::Holdout, ..stretch.part(cut..stretch.len()) };
    vec![train, holdout]
}

/// Takes out the jumps of an encoder that wraps after a turn.
fn unwrap(file: &str, joint: &mut JointTrace, criteria: &LogCriteria) -> Option<String> {
    use std::f64::consts::{PI, TAU};
    let (mut turns, mut wraps) = (0.0, 0);
    for k in 1..joint.q_rad.len() {
        let step = joint.q_rad[k] + turns - joint.q_rad[k - 1];
        if step.abs() > PI && (step.abs() / TAU).fract() - 0.5 != 0.0 {
            let jump = (step / TAU).round() * TAU;
            if (step - jump).abs() < criteria.wrap_tolerance_rad {
                turns -= jump;
                wraps += 1;
            }
        }
        joint.q_rad[k] += turns;
    }
    (wraps > 0).then(|| {
        format!("{file}: q{} wraps {wraps} times; it was taken as turning on", joint.number)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_encoder_that_wraps_turns_on() {
        let turning: Vec<f64> = (0..400).map(|k| 0.05 * f64::from(k)).collect();
        let mut joint = JointTrace {
            number: 2,
            q_rad: turning.iter().map(|q| q.rem_euclid(std::f64::consts::TAU)).collect(),
            command_v: Vec::new(),
            reference_rad: None,
        };
        let criteria = LogCriteria::default();
        assert!(unwrap("log.csv", &mut joint, &criteria).unwrap().contains("wraps 3 times"));
        let error =
            turning.iter().zip(&joint.q_rad).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 1e-9, "{error}");
        assert_eq!(unwrap("log.csv", &mut joint, &criteria), None);
    }
}
