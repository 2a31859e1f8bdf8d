//! Diagnoses made by hand, for tests.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use model::reference_robot::reference_robot;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use crate::criteria::Criteria;
use crate::gap_by_axis::gap_by_axis;
use crate::model_file::ModelFile;
use crate::result::{
    Axis, Cause, DataParts, Detectable, Diagnosis, Gap, Interval, JointResiduals, Level,
    LogResiduals, ParameterChange, Remainder, RemainderCurve, Report, Rival, Untestable, Value,
    Verdict,
};
use files::{RobotFile, Role};
use rig::effects::Catalogue;

const FLOOR_V: f64 = 4e-3;
const PERIOD_S: f64 = 2.5e-3;

/// What a joint does at an instant.
#[derive(Clone, Copy)]
pub struct At {
    /// Time since the log began [s].
    pub t: f64,
    /// Angle [rad].
    pub q: f64,
    /// Velocity [rad/s].
    pub qd: f64,
    /// Acceleration [rad/s^2].
    pub qdd: f64,
    /// Coriolis and gravity torque [Nm].
    pub load: f64,
    /// Command [V].
    pub u: f64,
}

/// Three logs of 24 s on a Fourier motion each, the last one held out, with a residual on
/// joint 3 and noise on all.
pub fn logs(residual_v: impl Fn(&At) -> f64) -> Vec<LogResiduals> {
    let mut random = Pcg64Mcg::new(7);
    let mut noise = || -> f64 {
        let deviate: f64 = StandardNormal.sample(&mut random);
        FLOOR_V * deviate
    };
    let log = |number: usize| {
        let time_s: Vec<f64> = (0..9600).map(|k| k as f64 * PERIOD_S).collect();
        let joints = (1..=3u8).map(|joint| {
            let mut columns =
                JointResiduals { joint, noise_floor_v: FLOOR_V, ..JointResiduals::default() };
            for &t in &time_s {
                let at = motion(t, number as f64 + 0.3 * f64::from(joint));
                let hidden_v = if joint == 3 { residual_v(&at) } else { 0.0 };
                columns.position_rad.push(at.q);
                columns.velocity_rad_per_s.push(at.qd);
                columns.acceleration_rad_per_s2.push(at.qdd);
                columns.load_nm.push(at.load);
                columns.command_v.push(at.u);
                let noise_v = noise();
                columns.given_v.push(hidden_v + 0.01 * at.load + 0.02 * at.qd + noise_v);
                columns.refitted_v.push(hidden_v + noise_v);
                columns.with_effects_v.push(noise_v);
            }
            columns
        });
        let joints = joints.collect();
        let role = if number == 2 { Role::Holdout } else { Role::Train };
        LogResiduals { file: format!("excitation-{number}.csv"), role, time_s, joints }
    };
    (0..3).map(log).collect()
}

/// Four sines about a slow turn.
fn motion(t: f64, seed: f64) -> At {
    let mut at = At { t, q: 0.0, qd: 0.0, qdd: 0.0, load: 0.0, u: 0.0 };
    for k in 1..=4 {
        let k = f64::from(k);
        let (w, a) = (TAU * 0.091 * k, 1.9 / k);
        let phase = w * t + 2.1 * seed * k * k + k * k;
        at.q += a * phase.sin();
        at.qd += a * w * phase.cos();
        at.qdd -= a * w * w * phase.sin();
    }
    at.load = 1.9 * (at.q + 0.4).cos();
    at.u = 0.3 * at.qd.signum() + 0.1 * at.qd + 0.05 * at.qdd + at.load / 3.0;
    at
}

/// A diagnosis of a hidden residual on joint 3 with these causes.
pub fn diagnosis(
    verdict: Verdict,
    causes: Vec<Cause>,
    residual_v: impl Fn(&At) -> f64,
) -> Diagnosis {
    let criteria = Criteria::default();
    let logs = logs(residual_v);
    let rms = |pick: fn(&JointResiduals) -> &Vec<f64>| -> Vec<f64> {
        let of = |joint: &JointResiduals| {
            let values = pick(joint);
            (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
        };
        logs[2].joints.iter().map(of).collect()
    };
    let gap = Gap {
        as_given_v: rms(|joint| &joint.given_v),
        refitted_v: rms(|joint| &joint.refitted_v),
        with_effects_v: if causes.is_empty() { vec![] } else { rms(|joint| &joint.with_effects_v) },
        with_tables_v: rms(|joint| &joint.with_effects_v),
        noise_floor_v: vec![FLOOR_V; 3],
        refitted_rad: vec![0.4e-3, 0.2e-3, 3.1e-3],
        with_effects_rad: vec![0.4e-3, 0.2e-3, 0.3e-3],
        ..Gap::default()
    };
    let level = |name: &str, rms_v: &[f64]| Level { name: name.into(), rms_v: rms_v.to_vec() };
    let mut waterfall =
        vec![level("as given", &gap.as_given_v), level("refitted", &gap.refitted_v)];
    for cause in &causes {
        let name = format!("with {}, joint {}", cause.effect, cause.joint);
        waterfall.push(level(&name, &gap.with_effects_v));
    }
    waterfall.push(level("with tables", &gap.with_tables_v));
    waterfall.push(level("noise", &gap.noise_floor_v));
    let report = Report {
        format: 2,
        verdict,
        causes,
        alternatives: vec![],
        parameters_changed: vec![],
        remainder: vec![],
        gap_shares: gap_by_axis(&logs, &criteria.axes),
        gap,
        data: data(),
        untestable: vec![Untestable {
            effect: "delay".into(),
            joint: 2,
            why: "no log excites joint 2 above 20 Hz; record driven noise to 200 Hz".into(),
        }],
        detectable: detectable(),
        remarks: vec!["excitation-1.csv has 3 gaps; they are left out.".into()],
        model_fault: None,
        contact: None,
    };
    let model = ModelFile::Robot(Box::new(RobotFile::from_robot(&reference_robot())));
    let units = Default::default();
    let catalogue = Catalogue::standard();
    let (rivals, posterior) = (rivals(), None);
    Diagnosis { report, logs, waterfall, rivals, model, posterior, catalogue, criteria, units }
}

/// Cogging on joint 3.
pub fn cogging() -> Cause {
    Cause {
        effect: "cogging".into(),
        joint: 3,
        parameters: numbers(&[("amplitude_V", 0.11), ("harmonic", 8.0), ("phase_rad", 0.9)]),
        parameter_intervals: [("amplitude_V", [0.106, 0.114]), ("phase_rad", [0.86, 0.94])]
            .map(|(name, interval)| (name.to_owned(), Interval::Number(interval)))
            .into(),
        probability: 0.97,
        confidence: 0.97,
        share: 0.95,
        share_interval: [0.93, 0.96],
        shrinkage: 0.78,
        shrinkage_interval: [0.74, 0.81],
        shrinkage_halves: None,
    }
}

/// A payload of 0.42 kg that takes 94 % of the gap.
pub fn payload() -> Cause {
    let mass = ("mass_kg".to_owned(), Interval::Number([0.415, 0.425]));
    Cause {
        effect: "payload".into(),
        joint: 0,
        parameters: numbers(&[("mass_kg", 0.42)]),
        parameter_intervals: [mass].into(),
        probability: 0.98,
        confidence: 0.98,
        share: 0.94,
        share_interval: [0.92, 0.96],
        ..cogging()
    }
}

/// Viscous friction of joint 2 that the refit found 18 % larger.
pub fn more_viscous() -> ParameterChange {
    ParameterChange {
        parameter: "friction[2].alpha2_V_s_per_rad".into(),
        given: 0.07,
        is_given: true,
        found: 0.0826,
        interval: [0.081, 0.084],
        share: 0.6,
    }
}

/// Friction of joint 2 that has another form where it is slow, 4 % of the gap.
pub fn slow_friction() -> Remainder {
    let x: Vec<f64> = (-20..=20).map(|k| 0.01 * f64::from(k)).collect();
    let bump = |x: &f64| 0.012 * x.signum() * (-(x / 0.02).powi(2)).exp();
    let y_v = x.iter().map(bump).collect();
    let deviation_v = vec![1.5e-3; x.len()];
    Remainder {
        joint: 2,
        axis: Axis::Velocity,
        rms_v: 0.012,
        rms_rad: None,
        share: 0.04,
        detail: "friction below 0.02 rad/s".into(),
        curve: RemainderCurve { x, y_v, deviation_v },
        nearest: Some("asymmetric_friction".into()),
    }
}

fn data() -> DataParts {
    let train = ["excitation-0.csv", "excitation-1.csv"].map(str::to_owned);
    let confirm = vec!["excitation-2.csv".into()];
    DataParts { fit: train.to_vec(), select: train.to_vec(), confirm }
}

fn numbers(of: &[(&str, f64)]) -> BTreeMap<String, Value> {
    of.iter().map(|(name, value)| ((*name).to_owned(), Value::Number(*value))).collect()
}

fn rivals() -> Vec<Rival> {
    let ripple = numbers(&[("relative_amplitude", 0.08), ("harmonic", 8.0), ("phase_rad", 1.1)]);
    let spring = numbers(&[("stiffness_V_per_rad", 0.012), ("rest_rad", 0.4)]);
    let rival = |effect: &str, parameters, explained, why: &str| Rival {
        effect: effect.into(),
        joint: 3,
        parameters,
        explained,
        why: why.into(),
    };
    vec![
        rival("torque_ripple", ripple, 0.41, "explains 41 %, cogging 99 %"),
        rival("cable_spring", spring, 0.02, "explains nothing on the logs held out"),
    ]
}

fn detectable() -> Vec<Detectable> {
    let one = |effect: &str, joint: u8, parameter: &str, size: f64| Detectable {
        effect: effect.into(),
        joint,
        parameter: parameter.into(),
        size,
    };
    vec![
        one("torque_constant", 1, "relative_error", 0.031),
        one("torque_constant", 2, "relative_error", 0.012),
        one("cogging", 1, "amplitude_V", 0.0011),
        one("cogging", 2, "amplitude_V", 0.0012),
        one("cogging", 3, "amplitude_V", 0.0009),
        one("payload", 0, "mass_kg", 0.021),
    ]
}
