//! Short logs of the reference robot with effects, and its model.

use files::{RobotFile, Role};
use model::reference_robot::reference_robot;
use recordings::{Campaign, Trace};
use rig::effects::Effect;
use rig::plan::{driven_noise, excitation, slow};
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

/// Three train logs of 13 s together, and one of 4 s held out.
pub fn short_campaign(effects: impl Fn() -> Vec<Box<dyn Effect>>) -> Campaign {
    let rig = Rig::new(reference_robot());
    let counts = f64::from(rig.encoder_counts_per_turn);
    let held_out = excitation(5, 4.0).with_role(Role::Holdout);
    let plans = [excitation(3, 6.0), slow(4.0), driven_noise(3.0, 4), held_out];
    let trace = |plan: &Plan| {
        let block = plan.block(&rig);
        let (start, settings) = (start_of(&block), Settings::default());
        let robot = SimulatedRobot::with_effects(reference_robot(), effects(), start, &settings);
        let (mut board, ticks) = (InProcess::default(), plan.ticks(&rig));
        let recording = record_robot(&mut board, &block, robot, ticks, &mut |_| {}).unwrap();
        Trace::of_log(recording.log, plan.entry("csv"), counts)
    };
    let traces = plans.iter().map(trace).collect();
    Campaign::new(RobotFile::from_robot(&rig.model), Some(counts), traces).unwrap()
}
