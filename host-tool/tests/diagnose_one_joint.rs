//! Rigs of one joint, sampled at 100 Hz to 5 kHz, evenly or not.

use std::f64::consts::{FRAC_PI_2, TAU};

use diagnosis::{self, Criteria, Report, Verdict};
use files::{Experiment, RobotFile, Role};
use model::reference_robot::reference_robot;
use model::{BaseParameters, Robot};
use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;
use recordings::campaign::JointTrace;
use recordings::{Campaign, Trace};
use rig::effects::Catalogue;
use simulation::{Settings, SimulatedRobot};

const COUNTS_PER_TURN: f64 = 655_360.0;
const INERTIA: f64 = 0.0714;

/// A rig of one joint and how it is recorded.
#[derive(Clone, Copy, Debug)]
struct Rig {
    joint: u8,
    rate_hz: f64,
    jitter: f64,
    gravity_nm: f64,
    bristles: bool,
    in_counts: bool,
}

const PENDULUM: Rig = Rig {
    joint: 3,
    rate_hz: 1000.0,
    jitter: 0.0,
    gravity_nm: 1.97,
    bristles: true,
    in_counts: true,
};

/// Ticks of the simulation [s].
const TICK_S: f64 = 1e-4;
const AMPLIFIER_NOISE_V: f64 = 4e-3;

impl Rig {
    /// The arm whose third joint is this rig.
    fn robot(self) -> Robot<f64> {
        let mut robot = reference_robot::<f64>();
        let mut base = [0.0; model::base::COUNT];
        base[12] = INERTIA;
        base[13] = self.gravity_nm / robot.geometry.gravity_m_s2;
        robot.base = BaseParameters { zz1r: 1e6, zz2r: 1e6, ..BaseParameters::from_array(base) };
        robot.geometry.a2_m = 0.0;
        robot.geometry.a3_m = 0.4;
        robot
    }

    /// A model of it that is a few per cent off.
    fn model(self) -> RobotFile {
        let mut file = RobotFile::from_robot(&reference_robot());
        file.base = None;
        let table = format!(
            r#"{{"joint":{},"inertia_kg_m2":{},"gravity_torque_Nm":{}}}"#,
            self.joint,
            1.02 * INERTIA,
            0.98 * self.gravity_nm
        );
        file.pendulum = Some(serde_json::from_str(&table).unwrap());
        let mut friction = file.friction[2].clone();
        friction.joint = self.joint;
        friction.alpha0_v *= 1.02;
        friction.alpha2_v_s_per_rad *= 0.97;
        if !self.bristles {
            friction.sigma0_v_per_rad = None;
            friction.sigma1_v_s_per_rad = None;
        }
        file.friction = vec![friction];
        file.robot.a3_m = Some(0.4);
        file.robot.torque_constant_nm_per_v = vec![3.0];
        file.robot.encoder_counts_per_rev = self.in_counts.then_some(COUNTS_PER_TURN);
        file.robot.command_limit_v = Some(10.0);
        file
    }

    /// Closed-loop motion of several sines, with noise on the command where `driven`.
    fn recorded(self, effects: &[(&str, &[f64])], log: Motion) -> Trace {
        let period_s = 1.0 / self.rate_hz;
        let effects = effects.iter().map(|(name, values)| {
            let definition = Catalogue::standard().by_name(name).unwrap();
            definition.with(if definition.whole_robot { 0 } else { 3 }, values).unwrap()
        });
        let settings = Settings {
            sample_period_s: TICK_S,
            substeps: 1,
            noise_v: AMPLIFIER_NOISE_V * (period_s / TICK_S).sqrt(),
            seed: log.seed,
        };
        let start = [0.0, -FRAC_PI_2, 0.0];
        let mut robot =
            SimulatedRobot::with_effects(self.robot(), effects.collect(), start, &settings);
        let mut random = Pcg64Mcg::new(u128::from(log.seed) << 1 | 1);
        let one = Uniform::new(-1.0, 1.0).unwrap();
        let (mut time_s, mut q_rad, mut command_v) = (Vec::new(), Vec::new(), Vec::new());
        let (mut ticks, mut before) = (0_u32, 0.0);
        while f64::from(ticks) * TICK_S < log.duration_s {
            let t = f64::from(ticks) * TICK_S;
            let step = TAU / COUNTS_PER_TURN;
            let q = (robot.reading_rad()[2] / step).round() * step;
            let last = time_s.last().copied().unwrap_or(t - period_s);
            let speed = (q - before) / (t - last);
            let reference = log.reference_rad(t);
            let wanted = (log.reference_rad(t + 1e-4) - reference) / 1e-4;
            let stiff = 0.5 * (self.rate_hz / 200.0).clamp(0.6, 2.0);
            let u = self.gravity_nm / 3.0 * q.sin()
                + 6.0 * stiff * (reference - q)
                + 0.8 * stiff * (wanted - speed)
                + 0.3 * (wanted / 0.1).tanh()
                + log.driven_v * one.sample(&mut random);
            let u = u.clamp(-10.0, 10.0);
            time_s.push(t);
            q_rad.push(q);
            command_v.push(u);
            before = q;
            let nominal = period_s * (1.0 + self.jitter * one.sample(&mut random));
            let held = (nominal / TICK_S).round().max(1.0) as u32;
            for _ in 0..held {
                robot.advance(&[0.0, 0.0, u]);
            }
            ticks += held;
        }
        let joints = vec![JointTrace { number: self.joint, q_rad, command_v, reference_rad: None }];
        Trace {
            file: format!("log-{}.csv", log.seed),
            experiment: Experiment::Task,
            role: log.role,
            joint: Some(self.joint),
            period_s,
            time_s,
            joints,
        }
    }

    fn diagnosed(self, effects: &[(&str, &[f64])]) -> Report {
        self.diagnosed_by(&Criteria::default(), effects)
    }

    fn diagnosed_by(self, criteria: &Criteria, effects: &[(&str, &[f64])]) -> Report {
        let log = |seed, duration_s, speed, driven_v, role| Motion {
            seed,
            duration_s,
            speed,
            driven_v,
            role,
        };
        let logs = [
            log(1, 10.0, 1.0, 0.0, Role::Train),
            log(2, 8.0, 0.1, 0.0, Role::Train),
            log(3, 6.0, 0.5, 1.0, Role::Train),
            log(4, 8.0, 1.0, 0.0, Role::Holdout),
        ];
        let traces = logs.iter().map(|log| self.recorded(effects, *log)).collect();
        let counts = self.in_counts.then_some(COUNTS_PER_TURN);
        let campaign = Campaign::new(self.model(), counts, traces).unwrap();
        let diagnosis =
            diagnosis::diagnose(&campaign, &Catalogue::standard(), criteria, &|_| ()).unwrap();
        eprintln!("{self:?} {effects:?}");
        eprintln!("{}", host_tool::commands::diagnose::in_words(&diagnosis));
        diagnosis.report
    }
}

/// A log to be recorded.
#[derive(Clone, Copy, Debug)]
struct Motion {
    seed: u64,
    duration_s: f64,
    speed: f64,
    driven_v: f64,
    role: Role,
}

impl Motion {
    fn reference_rad(&self, t: f64) -> f64 {
        let fade = (t / 0.5).min(1.0);
        let sine = |k: u32| {
            let f_hz = 0.11 * f64::from(k * k + 1);
            let phase = f64::from(k) * self.seed as f64;
            0.35 / f_hz.sqrt() * (TAU * f_hz * t + phase).sin()
        };
        self.speed * fade * fade * (1..=4).map(sine).sum::<f64>() * 2.0
    }
}

#[track_caller]
fn assert_named(report: &Report, effect: &str, joint: u8) {
    let named: Vec<(&str, u8)> = report.causes.iter().map(|c| (&c.effect[..], c.joint)).collect();
    assert_eq!((report.verdict, &named[..]), (Verdict::Effect, &[(effect, joint)][..]));
}

#[test]
fn nothing_is_found_where_nothing_is() {
    for rate_hz in [100.0, 200.0, 1000.0, 5000.0] {
        let report = Rig { rate_hz, ..PENDULUM }.diagnosed(&[]);
        assert_eq!(report.verdict, Verdict::None, "{rate_hz} Hz");
    }
}

#[test]
fn nothing_is_found_at_uneven_times() {
    for rate_hz in [200.0, 1000.0] {
        let report = Rig { rate_hz, jitter: 0.2, ..PENDULUM }.diagnosed(&[]);
        assert_eq!(report.verdict, Verdict::None, "{rate_hz} Hz");
    }
}

#[test]
fn nothing_is_found_by_a_model_without_bristles() {
    let report = Rig { bristles: false, in_counts: false, ..PENDULUM }.diagnosed(&[]);
    assert_eq!(report.verdict, Verdict::None);
}

#[test]
fn cogging_is_found_at_every_rate() {
    for rate_hz in [100.0, 200.0, 5000.0] {
        let rig = Rig { rate_hz, ..PENDULUM };
        assert_named(&rig.diagnosed(&[("cogging", &[0.2, 7.0, 0.5])]), "cogging", 3);
    }
}

#[test]
fn a_criterion_that_is_overridden_changes_the_verdict() {
    let (rig, cogging) = (Rig { rate_hz: 200.0, ..PENDULUM }, ("cogging", &[0.2, 7.0, 0.5][..]));
    let mut criteria = Criteria::default();
    criteria.search.highest_harmonic = 6;
    let report = rig.diagnosed_by(&criteria, &[cogging]);
    assert_eq!(report.verdict, Verdict::Unknown, "{:?}", report.causes);
}

#[test]
fn an_offset_is_found_on_joint_one_without_gravity() {
    let rig = Rig { joint: 1, gravity_nm: 0.0, rate_hz: 200.0, ..PENDULUM };
    assert_named(&rig.diagnosed(&[("dac_offset", &[0.15])]), "dac_offset", 1);
}

#[test]
fn asymmetric_friction_is_found_on_joint_two_without_bristles() {
    let rig = Rig { joint: 2, bristles: false, in_counts: false, ..PENDULUM };
    assert_named(&rig.diagnosed(&[("asymmetric_friction", &[0.4])]), "asymmetric_friction", 2);
}

#[test]
fn a_payload_is_found_at_even_and_uneven_times() {
    for (rate_hz, jitter) in [(200.0, 0.0), (1000.0, 0.2), (200.0, 0.2)] {
        let rig = Rig { rate_hz, jitter, ..PENDULUM };
        assert_named(&rig.diagnosed(&[("payload", &[0.2])]), "payload", 0);
    }
}

#[test]
fn a_lag_is_found() {
    for rate_hz in [200.0, 1000.0] {
        let rig = Rig { rate_hz, ..PENDULUM };
        assert_named(&rig.diagnosed(&[("actuator_lag", &[0.015])]), "actuator_lag", 3);
    }
}

#[test]
fn a_dead_zone_is_found() {
    let report = PENDULUM.diagnosed(&[("dead_zone", &[0.15])]);
    assert_named(&report, "dead_zone", 3);
}
