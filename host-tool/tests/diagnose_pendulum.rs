//! The real pendulum: what a diagnosis may and may not say of its logs.

mod common;

use diagnosis::{self, Criteria, Report, Verdict};
use files::{Dataset, RobotFile, Role};
use recordings::{Campaign, Trace};
use rig::effects::Catalogue;
use signal::butterworth::LowPass;

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
    let directory = test_support::data("dfki-pendulum")?;
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
    let diagnosis =
        diagnosis::diagnose(&campaign, &Catalogue::standard(), &Criteria::default(), &|_| ())
            .unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&diagnosis));
    eprintln!(
        "{:?}\n{:?}",
        diagnosis.report.gap,
        diagnosis.model.as_robot().map(|file| &file.pendulum)
    );
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
        let refusal =
            diagnosis::diagnose(&campaign, &Catalogue::standard(), &Criteria::default(), &|_| ())
                .unwrap_err()
                .to_string();
        assert!(refusal.contains(name) && refusal.contains("outside force"), "{refusal}");
    }
}

#[test]
fn swing_ups_name_no_cause() {
    for (name, until_s) in SWING_UPS {
        let Some(swing) = part(name, 0.0, until_s) else { return };
        let held_out = Trace { role: Role::Holdout, ..swing.clone() };
        let report = diagnosed(vec![swing, held_out]);
        assert_eq!(report.verdict, Verdict::None, "{name}");
        assert!(report.causes.is_empty(), "{name}");
    }
}

/// Time until the pendulum stands [s].
const SWING_UPS: [(&str, f64); 2] = [("energy-shaping", 4.2), ("energy-shaping-1kg", 8.2)];

/// Torques of inertia and of gravity that a kilogram at the tip adds [Nm].
fn torques_of_a_kilogram(swing: &Trace) -> (Vec<f64>, Vec<f64>) {
    const LENGTH_M: f64 = 0.5;
    const GRAVITY_M_S2: f64 = 9.81;
    const PERIOD_S: f64 = 0.005;
    let smooth = LowPass::new(5.0, PERIOD_S).zero_phase(&swing.joints[0].q_rad);
    let middle = 40..smooth.len() - 40;
    let inertia = |k: usize| {
        let qdd = (smooth[k + 1] - 2.0 * smooth[k] + smooth[k - 1]) / PERIOD_S.powi(2);
        LENGTH_M.powi(2) * qdd
    };
    let gravity = |k: usize| GRAVITY_M_S2 * LENGTH_M * smooth[k].sin();
    (middle.clone().map(inertia).collect(), middle.map(gravity).collect())
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / a.len() as f64
}

/// Why the heavier weight cannot be found: its inertia and its weight cancel
/// (docs/diagnosis-real-pendulum.md).
#[test]
fn a_swing_up_hides_mass() {
    let (name, until_s) = SWING_UPS[1];
    let Some(swing) = part(name, 0.0, until_s) else { return };
    let (inertia, gravity) = torques_of_a_kilogram(&swing);
    let both: Vec<f64> = inertia.iter().zip(&gravity).map(|(a, b)| a + b).collect();
    let rms = |torque: &[f64]| product(torque, torque).sqrt();
    let correlation = product(&inertia, &gravity) / (rms(&inertia) * rms(&gravity));
    println!(
        "inertia {:.2} gravity {:.2} both {:.2} Nm/kg, correlation {correlation:.3}",
        rms(&inertia),
        rms(&gravity),
        rms(&both)
    );
    assert!(correlation < -0.98);
    assert!(rms(&both) < 0.2 * rms(&gravity));
}
