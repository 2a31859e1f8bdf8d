//! Friction that differs from log to log, in words.

use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::Hypothesis;
use files::Role;

/// By how much friction of each joint differs between and within train logs; none where it is the same in all.
pub fn words(subject: &Subject, stretches: &[Stretch], hypothesis: &Hypothesis) -> Option<String> {
    if hypothesis.warmths.is_empty() {
        return None;
    }
    let of_joint = |(joint, number): (&usize, &u8)| {
        let [least, most] = range(stretches, hypothesis, *joint);
        format!("joint {number} by {:.0} %", 100.0 * (most - least))
    };
    let joints: Vec<String> = subject.joints.iter().zip(&subject.numbers).map(of_joint).collect();
    Some(format!(
        "friction differs between and within logs as that of joints does which warm ({}): this was left open in each log; \
         log a machine that is warm, and smaller causes show",
        joints.join(", ")
    ))
}

/// The least and the largest factor on a joint's friction where stretches begin and end.
fn range(stretches: &[Stretch], hypothesis: &Hypothesis, joint: usize) -> [f64; 2] {
    let train = stretches.iter().filter(|stretch| stretch.role == Role::Train);
    let of_stretch = |stretch: &Stretch| {
        let warmth = hypothesis.warmth(joint, stretch.log)?;
        let times_s = [stretch.start_s, stretch.start_s + stretch.duration_s()];
        Some(times_s.map(|time_s| warmth.factor(time_s)))
    };
    let factors = train.filter_map(of_stretch).flatten();
    factors.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], factor| {
        [least.min(factor), most.max(factor)]
    })
}
