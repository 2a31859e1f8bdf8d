//! A geared arm logged at 100 Hz while its drives work five times as fast: a joint turns round between two samples.

mod arms;

use arms::recorded;
use diagnosis::{Criteria, Report};
use files::example_arms::six_axes;
use files::{ArmJointLog, ArmLog};
use recordings::ArmCampaign;
use rig::effects::Catalogue;

/// Rows of the drives in a row of the log.
const TOGETHER: usize = 5;

/// Every fifth position, and the means of five commands.
fn slowly(log: &ArmLog) -> ArmLog {
    let every = |values: &[f64]| values.iter().step_by(TOGETHER).copied().collect::<Vec<f64>>();
    let means = |values: &[f64]| -> Vec<f64> {
        let mean = |piece: &[f64]| piece.iter().sum::<f64>() / piece.len() as f64;
        values.chunks(TOGETHER).map(mean).collect()
    };
    let of_joint = |joint: &ArmJointLog| ArmJointLog {
        position: every(&joint.position),
        command: means(&joint.command),
        ..ArmJointLog::default()
    };
    ArmLog { time_s: every(&log.time_s), joints: log.joints.iter().map(of_joint).collect() }
}

fn diagnosed(hidden: &[&str]) -> Report {
    let mut campaign: ArmCampaign = recorded(&six_axes(), 500.0, 20.0, hidden);
    campaign.recordings.retain(|recording| !recording.file.starts_with("driven-noise"));
    campaign.recordings.iter_mut().for_each(|recording| recording.log = slowly(&recording.log));
    let catalogue = Catalogue::of_arm(campaign.arm.joints.len());
    let found =
        diagnosis::diagnose_arm(&campaign, &catalogue, &Criteria::default(), &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&found));
    found.report
}

#[test]
fn an_arm_with_nothing_wrong_has_no_cause() {
    assert!(diagnosed(&[]).causes.is_empty());
}

#[test]
fn a_load_is_named_all_the_same() {
    let report = diagnosed(&["payload:mass_kg=0.5,com_m=0.05 0 0.1"]);
    let named: Vec<_> = report.causes.iter().map(|c| (c.effect.as_str(), c.joint)).collect();
    assert_eq!(named, [("payload", 0)]);
    let diagnosis::Value::Number(mass_kg) = report.causes[0].parameters["mass_kg"] else {
        panic!("{:?}", report.causes)
    };
    assert!((mass_kg / 0.5 - 1.0).abs() < 0.1, "{mass_kg}");
}
