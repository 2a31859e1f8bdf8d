//! Sentences as they are said.

use super::sentence;
use crate::result::{Alternative, Verdict};
use crate::synthetic::{cogging, diagnosis, more_viscous, payload, slow_friction};

#[test]
fn a_part_with_a_name_is_said_with_its_rest() {
    let mut partial = diagnosis(Verdict::Partial, vec![payload(), cogging()], |_| 0.0);
    partial.report.remainder = vec![slow_friction()];
    partial.report.parameters_changed = vec![more_viscous()];
    let gap = &mut partial.report.gap;
    gap.noise_floor_v = vec![1e-3; 3];
    gap.as_given_v = vec![0.2; 3];
    gap.refitted_v = vec![0.1; 3];
    gap.with_effects_v = vec![0.02; 3];
    let said = sentence(&partial);
    assert_eq!(
        said,
        "Whole robot: payload, 0.42 kg: 94 % of the gap [92 to 96], sure (98 %). \
         Joint 3: cogging, 8 per turn, 0.11 V: 95 % of its gap [93 to 96], sure (97 %). \
         Model refitted: joint 2, viscous friction +18 %: 60 % of what refitting gains. \
         The rest, 4 %: joint 2 over velocity, friction below 0.02 rad/s."
    );
}

#[test]
fn what_may_stand_in_place_of_a_cause_is_said() {
    let mut found = diagnosis(Verdict::Effect, vec![cogging()], |_| 0.0);
    found.report.alternatives.push(Alternative {
        effect: "torque_ripple".into(),
        joint: 3,
        probability: 0.12,
        confidence: 0.12,
        instead_of: Some(0),
        share: 0.9,
        why: None,
    });
    let said = sentence(&found);
    let words = "Not ruled out: torque ripple on joint 3 in place of cogging (12 %).";
    assert!(said.contains(words), "{said}");
    let other = &mut found.report.alternatives[0];
    (other.instead_of, other.share) = (None, 0.03);
    other.why = Some("its share may be nothing".into());
    let said = sentence(&found);
    let words = "Found, but not named: torque ripple on joint 3, 3 % of its gap (its share may be nothing).";
    assert!(said.contains(words), "{said}");
}

#[test]
fn a_refit_of_many_parameters_is_said_by_what_it_gains() {
    let mut unknown = diagnosis(Verdict::Unknown, vec![], |at| 0.05 * at.qd);
    unknown.report.gap.as_given_v = vec![0.01, 0.081, 0.1];
    unknown.report.gap.refitted_v = vec![0.01, 0.0148, 0.09];
    let words = "Model refitted: many parameters together take joint 2 from 81 mV to 14.8 mV.";
    assert!(sentence(&unknown).ends_with(words), "{}", sentence(&unknown));
}

#[test]
fn the_unknown_is_said_with_what_came_nearest() {
    let unknown = diagnosis(Verdict::Unknown, vec![], |at| 0.05 * at.qd);
    let said = sentence(&unknown);
    assert!(said.contains("on joint 3 that nothing in the catalogue explains; it "), "{said}");
    let nearest = "Nearest: torque ripple on joint 3, 8 per turn, +8.0 %, would take 41 %, but ";
    assert!(said.contains(nearest), "{said}");
}

#[test]
fn what_is_found_and_not_named_on_the_joint_is_said_in_place_of_what_came_nearest() {
    let found = |effect: &str, joint| Alternative {
        effect: effect.into(),
        joint,
        probability: 0.98,
        confidence: 0.98,
        instead_of: None,
        share: 0.54,
        why: Some("a curve along one axis explains more".into()),
    };
    let mut unknown = diagnosis(Verdict::Unknown, vec![], |at| 0.05 * at.qd);
    unknown.report.alternatives = vec![found("dac_offset", 1)];
    let elsewhere = sentence(&unknown);
    assert!(elsewhere.contains("on joint 3 that nothing in the catalogue explains"), "{elsewhere}");
    assert!(elsewhere.contains("Nearest: torque ripple on joint 3"), "{elsewhere}");
    let others = ["cogging", "dead_zone", "payload"].map(|effect| found(effect, 3));
    unknown.report.alternatives = others.to_vec();
    let here = sentence(&unknown);
    assert!(here.contains("on joint 3 that no cause surely explains"), "{here}");
    assert!(here.contains("dead zone") && !here.contains("payload"), "{here}");
    assert!(!here.contains("Nearest"), "{here}");
}
