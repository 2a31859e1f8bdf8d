//! The real pendulum: what a diagnosis may and may not say of its logs.

mod common;

use host_tool::diagnosis::{self, Report, Verdict};
use host_tool::files::{Dataset, RobotFile, Role};
use host_tool::identification::{Campaign, Trace};
use host_tool::progress::Steps;

/// As `rrr identify` finds it from the identification log.
const MODEL: &str = r#"
format = 1
[robot]
gravity_m_s2 = 9.81
a3_m = 0.5
torque_constant_Nm_per_V = [1.0]
sample_period_s = 0.005
command_limit_V = 12.0
[pendulum]
joint = 3
inertia_kg_m2 = 0.1547
gravity_torque_Nm = 3.062
[[friction]]
joint = 3
alpha0_V = 0.196
alpha1_V = 0.0
stribeck_velocity_rad_per_s = 0.003
alpha2_V_s_per_rad = 0.009
"#;

/// A part of one of the logs, as train log.
fn part(name: &str, from_s: f64, to_s: f64) -> Option<Trace> {
    let directory = common::data("dfki-pendulum")?;
    let list = format!(
        "format = 1\n[[log]]\nfile = \"{name}.csv.gz\"\nexperiment = \"task\"\nrole = \"train\"\n"
    );
    let own = common::directory();
    std::fs::write(own.path().join("dataset.toml"), list).unwrap();
    let file = format!("{name}.csv.gz");
    std::fs::copy(directory.join(&file), own.path().join(&file)).unwrap();
    let dataset = Dataset::read(own.path()).unwrap();
    let mut trace = Campaign::read(&dataset, model()).unwrap().traces.remove(0);
    let kept: Vec<bool> = trace.time_s.iter().map(|t| (from_s..to_s).contains(t)).collect();
    let of = |column: &mut Vec<f64>| {
        let mut kept = kept.iter();
        column.retain(|_| *kept.next().unwrap());
    };
    of(&mut trace.time_s);
    trace.joints.iter_mut().for_each(|joint| {
        of(&mut joint.q_rad);
        of(&mut joint.command_v);
    });
    Some(trace)
}

fn model() -> RobotFile {
    let own = common::directory();
    std::fs::write(own.path().join("model.toml"), MODEL).unwrap();
    RobotFile::read(own.path().join("model.toml")).unwrap()
}

fn diagnosed(traces: Vec<Trace>) -> Report {
    let campaign = Campaign::new(model(), None, traces).unwrap();
    let diagnosis = diagnosis::diagnose(&campaign, &Steps::new()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&diagnosis));
    eprintln!("{:?}\n{:?}", diagnosis.report.gap, diagnosis.model.pendulum);
    diagnosis.report
}

#[test]
fn logs_with_outside_pushes_name_no_cause() {
    for name in ["energy-shaping", "energy-shaping-1kg"] {
        let Some(whole) = part(name, 0.0, 30.0) else { return };
        assert_eq!(diagnosed(vec![whole]).verdict, Verdict::Unknown, "{name}");
    }
}

#[test]
fn logs_moved_by_hand_are_left_out() {
    for name in ["gravity-compensation", "torque-limited"] {
        let Some(whole) = part(name, 0.0, 50.0) else { return };
        let campaign = Campaign::new(model(), None, vec![whole]).unwrap();
        let refusal = diagnosis::diagnose(&campaign, &Steps::new()).unwrap_err().to_string();
        assert!(refusal.contains(name) && refusal.contains("outside force"), "{refusal}");
    }
}

#[test]
fn swing_ups_alone() {
    for (name, until_s) in [("energy-shaping", 4.2), ("energy-shaping-1kg", 8.2)] {
        let Some(swing) = part(name, 0.0, until_s) else { return };
        let held_out = Trace { role: Role::Holdout, ..swing.clone() };
        diagnosed(vec![swing, held_out]);
    }
}
