//! A model that holds a table is diagnosed with it, and keeps it.
#![allow(missing_docs)]

use diagnosis::{Criteria, Verdict, diagnose};
use files::{RobotFile, Role};
use model::reference_robot::reference_robot;
use recordings::{Campaign, Trace};
use rig::effects::{Catalogue, Table, TableAxis};
use rig::plan::{driven_noise, excitation, slow};
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

/// Friction of another form below 0.2 rad/s, 0.05 V deep.
fn table() -> Table {
    Table {
        joint: 2,
        axis: TableAxis::Velocity,
        knots: vec![-0.2, -0.05, 0.05, 0.2],
        values_v: vec![0.0, 0.05, -0.05, 0.0],
    }
}

/// Logs of a robot that has the table, and a model that knows it.
fn campaign() -> Campaign {
    let rig = Rig::new(reference_robot());
    let counts = f64::from(rig.encoder_counts_per_turn);
    let held_out = excitation(5, 4.0).with_role(Role::Holdout);
    let plans = [excitation(3, 6.0), slow(4.0), driven_noise(3.0, 4), held_out];
    let trace = |plan: &Plan| {
        let block = plan.block(&rig);
        let effects = vec![Catalogue::standard().effect_of(&table().to_effect_table()).unwrap()];
        let (start, settings) = (start_of(&block), Settings::default());
        let robot = SimulatedRobot::with_effects(reference_robot(), effects, start, &settings);
        let (mut board, ticks) = (InProcess::default(), plan.ticks(&rig));
        let recording = record_robot(&mut board, &block, robot, ticks, &mut |_| {}).unwrap();
        Trace::of_log(recording.log, plan.entry("csv"), counts)
    };
    let traces = plans.iter().map(trace).collect();
    let mut model = RobotFile::from_robot(&rig.model);
    model.effects.push(table().to_effect_table());
    Campaign::new(model, Some(counts), traces).unwrap()
}

#[test]
fn a_table_that_the_model_knows_leaves_no_gap_and_stays() {
    let diagnosis =
        diagnose(&campaign(), &Catalogue::standard(), &Criteria::default(), &|_| ()).unwrap();
    let report = &diagnosis.report;
    assert_eq!(report.verdict, Verdict::None, "{:?}", report.causes);
    assert_eq!(diagnosis.model.effects, [table().to_effect_table()]);
}
