//! Static friction from constant-velocity runs and by the augmented Kalman filter.

mod common;

use common::known;
use files::{Dataset, Entry, Experiment, RobotFile, Role};
use identification::ekf::{self, Start};
use identification::{Estimate, static_friction};
use model::reference_robot::reference_robot;
use model::{Friction, Robot};
use recordings::campaign::{JointTrace, Known};
use recordings::{Campaign, StepError, Trace};
use rig::Rig;
use rig::plan::{Plan, constant_velocity, friction_excitation};
use simulation::board::InProcess;
use simulation::{Settings, record};

/// What issue and brief ask for.
const SLIDING: f64 = 0.03;
const BREAKAWAY: f64 = 0.10;
const INERTIA: f64 = 0.02;

fn within(name: &str, estimate: &Estimate, truth: f64, share: f64) {
    let error = estimate.value / truth - 1.0;
    eprintln!("{name}: {:+.4} +- {:.4}", error, estimate.standard_error / truth.abs());
    assert!(error.abs() < share, "{name} is {} instead of {truth}", estimate.value);
}

fn rig_1() -> Option<(Vec<Trace>, Known, Robot<f64>)> {
    let directory = test_support::data("rig-1")?;
    let dataset = Dataset::read(&directory).unwrap();
    let wanted = |entry: &Entry| {
        matches!(entry.experiment, Experiment::ConstantVelocity | Experiment::FrictionExcitation)
    };
    let recordings = dataset.recordings_where(wanted).unwrap();
    let truth = RobotFile::read(directory.join("truth.toml")).unwrap();
    let robot = truth.robot().unwrap();
    let none = Dataset { entries: Vec::new(), ..dataset };
    let known = Campaign::read(&none, truth).unwrap().known;
    Some((recordings.into_iter().map(Trace::of).collect(), known, robot))
}

/// A log of a plan on a simulated robot.
fn recorded(robot: &Robot<f64>, plan: &Plan, seed: u64) -> Trace {
    let rig = Rig::new(*robot);
    let settings = Settings { seed, ..Settings::default() };
    let mut board = InProcess::default();
    let ticks = plan.ticks(&rig);
    let log =
        record(&mut board, &plan.block(&rig), robot, &settings, ticks, &mut |_| ()).unwrap().log;
    let joints = log.joints.iter().map(|joint| JointTrace {
        number: joint.joint,
        q_rad: joint.position_rad(655_360.0),
        command_v: joint.command_v.clone(),
        reference_rad: joint.reference_rad.clone(),
    });
    Trace {
        file: plan.name.clone(),
        experiment: plan.experiment,
        role: Role::Train,
        joint: plan.joint,
        period_s: 1e-3,
        joints: joints.collect(),
        time_s: log.time_s,
    }
}

/// The reference robot with every value of joints 1 and 3 that matters here moved.
fn another_robot() -> Robot<f64> {
    let mut robot = reference_robot::<f64>();
    robot.friction[0] = Friction {
        alpha0_v: 0.21,
        alpha1_v: 0.056,
        stribeck_velocity_rad_per_s: 0.0036,
        alpha2_v_s_per_rad: 0.081,
        sigma0_v_per_rad: 1010.0,
        sigma1_v_s_per_rad: 3.2,
    };
    robot.friction[2] = Friction {
        alpha0_v: 0.40,
        alpha1_v: -0.15,
        stribeck_velocity_rad_per_s: 0.0027,
        alpha2_v_s_per_rad: 0.11,
        sigma0_v_per_rad: 250.0,
        sigma1_v_s_per_rad: 1.3,
    };
    robot.base.zz3r *= 1.1;
    robot.base.mx3r *= 0.95;
    robot.base.my3r = 0.008;
    robot
}

fn static_friction_holds(trace: &Trace, joint: u8, known: &Known, truth: &Friction<f64>) {
    let found = static_friction::identify(trace, joint, known).unwrap();
    let breakaway = truth.alpha0_v + truth.alpha1_v;
    within(&format!("joint {joint} alpha0"), &found.friction.alpha0_v, truth.alpha0_v, SLIDING);
    let alpha2 = truth.alpha2_v_s_per_rad;
    within(&format!("joint {joint} alpha2"), &found.friction.alpha2_v_s_per_rad, alpha2, SLIDING);
    within(&format!("joint {joint} breakaway"), &found.friction.breakaway_v, breakaway, BREAKAWAY);
    let v_s = truth.stribeck_velocity_rad_per_s;
    within(&format!("joint {joint} v_s"), &found.friction.stribeck_velocity_rad_per_s, v_s, 0.15);
    assert!(found.converged);
    let forward = found.legs.iter().filter(|leg| leg.velocity_rad_per_s > 0.0).count();
    let backward = found.legs.len() - forward;
    assert!(forward >= 4 && backward >= 4, "{forward} legs forward, {backward} backward");
    for leg in found.legs.iter().filter(|leg| leg.velocity_rad_per_s.abs() > 0.02) {
        let expected = truth.sliding(leg.velocity_rad_per_s);
        assert!((leg.friction_v - expected).abs() < 0.05 * expected.abs(), "{leg:?} {expected}");
    }
}

fn filter_holds(trace: &Trace, known: &Known, robot: &Robot<f64>) {
    let found = ekf::identify(trace, 3, known, &Start::from_log()).unwrap();
    let truth = &robot.friction[2];
    within("EKF alpha0", &found.friction.alpha0_v, truth.alpha0_v, SLIDING);
    within("EKF alpha2", &found.friction.alpha2_v_s_per_rad, truth.alpha2_v_s_per_rad, SLIDING);
    within(
        "EKF breakaway",
        &found.friction.breakaway_v,
        truth.alpha0_v + truth.alpha1_v,
        BREAKAWAY,
    );
    let base = &robot.base;
    within("EKF J3", &found.inertia_kg_m2, base.zz3r + base.ia3, INERTIA);
    let gravity = robot.geometry.gravity_m_s2 * base.mx3r.hypot(base.my3r);
    within("EKF l3", &found.gravity_torque_nm.unwrap(), gravity, INERTIA);
    let phase = found.gravity_phase_rad.unwrap().value - base.my3r.atan2(base.mx3r);
    assert!(phase.abs() < 2e-3, "{phase} rad of gravity's phase");
    assert!(found.converged);
    assert_eq!(found.history.len(), ekf::PASSES);
    assert_eq!(found.motion.len(), trace.len());
}

#[test]
fn constant_velocity_of_rig_1() {
    let Some((traces, known, robot)) = rig_1() else { return };
    for trace in traces.iter().filter(|t| t.experiment == Experiment::ConstantVelocity) {
        let joint = trace.joint.unwrap();
        static_friction_holds(trace, joint, &known, &robot.friction[usize::from(joint) - 1]);
    }
}

#[test]
fn a_log_without_slow_legs_says_so() {
    let Some((traces, known, robot)) = rig_1() else { return };
    for joint in [1, 2] {
        let truth = &robot.friction[usize::from(joint) - 1];
        let mut trace = traces.iter().find(|trace| trace.joint == Some(joint)).unwrap().clone();
        // The legs from 0.3 rad/s on.
        let from = trace.time_s.partition_point(|&t| t < 28.5);
        trace.time_s.drain(..from);
        for column in &mut trace.joints {
            column.q_rad.drain(..from);
            column.command_v.drain(..from);
        }
        let found = static_friction::identify(&trace, joint, &known).unwrap();
        within("alpha0", &found.friction.alpha0_v, truth.alpha0_v, SLIDING);
        within("alpha2", &found.friction.alpha2_v_s_per_rad, truth.alpha2_v_s_per_rad, SLIDING);
        let v_s = &found.friction.stribeck_velocity_rad_per_s;
        eprintln!("v_s {v_s:?} breakaway {:?}", found.friction.breakaway_v);
        assert!(v_s.note.is_some() && v_s.covers(truth.stribeck_velocity_rad_per_s));
        assert!(found.friction.breakaway_v.note.is_some());
        assert!(found.friction.breakaway_v.covers(truth.alpha0_v + truth.alpha1_v));
    }
}

#[test]
fn friction_excitation_of_rig_1() {
    let Some((traces, known, robot)) = rig_1() else { return };
    for trace in traces.iter().filter(|t| t.experiment == Experiment::FrictionExcitation) {
        filter_holds(trace, &known, &robot);
    }
}

#[test]
fn another_robot_that_sticks_and_slips() {
    let robot = another_robot();
    let trace = recorded(&robot, &constant_velocity(1), 5);
    static_friction_holds(&trace, 1, &known(&reference_robot()), &robot.friction[0]);
}

#[test]
fn another_robot_by_the_filter() {
    let robot = another_robot();
    let trace = recorded(&robot, &friction_excitation(&Rig::new(robot)), 6);
    filter_holds(&trace, &known(&reference_robot()), &robot);
}

/// A start 30 % off in every direction: the filter must not lose the motion for good.
#[test]
fn a_poor_start_is_survived() {
    let robot = another_robot();
    let trace = recorded(&robot, &friction_excitation(&Rig::new(robot)), 7);
    let truth = robot.friction[2];
    let friction = Friction {
        alpha0_v: 1.3 * truth.alpha0_v,
        alpha1_v: 0.5 * truth.alpha1_v,
        stribeck_velocity_rad_per_s: 1.5 * truth.stribeck_velocity_rad_per_s,
        alpha2_v_s_per_rad: 0.7 * truth.alpha2_v_s_per_rad,
        sigma0_v_per_rad: 1.3 * truth.sigma0_v_per_rad,
        sigma1_v_s_per_rad: 0.7 * truth.sigma1_v_s_per_rad,
    };
    let inertia = 1.3 * robot.base.zz3r / robot.torque_constant_nm_per_v[2];
    let start = Start { friction: Some(friction), inertia: Some(inertia) };
    let found = ekf::identify(&trace, 3, &known(&reference_robot()), &start).unwrap();
    within("alpha0 from a poor start", &found.friction.alpha0_v, truth.alpha0_v, SLIDING);
    within(
        "alpha2 from a poor start",
        &found.friction.alpha2_v_s_per_rad,
        truth.alpha2_v_s_per_rad,
        SLIDING,
    );
    within("J3 from a poor start", &found.inertia_kg_m2, robot.base.zz3r, INERTIA);
    assert!(found.converged);
}

#[test]
fn bad_logs_are_refused_with_reasons() {
    let still = |q: f64| Trace {
        file: "still.csv".into(),
        experiment: Experiment::ConstantVelocity,
        role: Role::Train,
        joint: Some(1),
        period_s: 1e-3,
        time_s: (0..5000).map(|k| 1e-3 * f64::from(k)).collect(),
        joints: vec![JointTrace {
            number: 1,
            q_rad: vec![q; 5000],
            command_v: vec![0.1; 5000],
            reference_rad: None,
        }],
    };
    let message = |result: Result<_, StepError>| match result {
        Ok(()) => panic!("accepted"),
        Err(error) => error.to_string(),
    };
    let found = static_friction::identify(&still(0.0), 1, &known(&reference_robot())).map(|_| ());
    assert!(message(found).contains("joint 1 never moved"));
    let found = static_friction::identify(&still(0.0), 2, &known(&reference_robot())).map(|_| ());
    assert!(message(found).contains("joint 2 is not in the log"));
    let found =
        ekf::identify(&still(0.0), 1, &known(&reference_robot()), &Start::from_log()).map(|_| ());
    assert!(message(found).contains("never moved"));
}
