//! Other robots, and campaigns recorded with them.
#![allow(dead_code)]

use files::RobotFile;
use model::reference_robot::reference_robot;
use model::{BaseParameters, Posture, Robot};
use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;
use recordings::{Campaign, Trace};
use rig::{Plan, Recipe, Rig};
use simulation::board::InProcess;
use simulation::friction_law::LuGre;
use simulation::{FrictionLaw, Settings, SimulatedRobot, record_robot, start_of};

const COUNTS_PER_TURN: f64 = 655_360.0;

/// The reference robot with every value up to 15 % off.
pub fn perturbed_robot(seed: u32) -> Robot<f64> {
    let mut random = Pcg64Mcg::new(u128::from(seed) << 32 | 0x5EED_u128 | 1);
    let off = Uniform::new(0.85, 1.15).unwrap();
    loop {
        let mut factor = || off.sample(&mut random);
        let mut robot = reference_robot::<f64>();
        robot.base = BaseParameters::from_array(robot.base.to_array().map(|p| p * factor()));
        for friction in &mut robot.friction {
            friction.alpha0_v *= factor();
            friction.alpha1_v *= factor();
            friction.stribeck_velocity_rad_per_s *= factor();
            friction.alpha2_v_s_per_rad *= factor();
            friction.sigma0_v_per_rad *= factor();
            friction.sigma1_v_s_per_rad *= factor();
        }
        if let Ok(robot) = robot.checked() {
            return robot;
        }
    }
}

/// The campaign of a robot whose board knows only the reference robot.
pub fn recorded_campaign(robot: &Robot<f64>, seed: u32) -> Campaign {
    let lugre =
        |robot: &Robot<f64>| robot.friction.map(|friction| Box::new(LuGre::new(friction)) as _);
    recorded_campaign_with(robot, seed, &lugre)
}

/// The same of a robot with other laws of friction.
pub fn recorded_campaign_with(robot: &Robot<f64>, seed: u32, laws: &Laws) -> Campaign {
    let rig = Rig::new(reference_robot());
    let plans = Recipe::by_name("campaign").unwrap().plans(&rig, seed);
    let numbered = plans.iter().zip(u64::from(seed) << 8..);
    let traces = numbered.map(|(plan, seed)| recorded(&rig, plan, robot, seed, laws)).collect();
    let mut file = RobotFile::from_robot(robot);
    file.base = None;
    file.friction.clear();
    file.robot.encoder_counts_per_rev = Some(COUNTS_PER_TURN);
    file.robot.command_limit_v = Some(10.0);
    file.robot.command_bits = Some(16);
    Campaign::new(file, Some(COUNTS_PER_TURN), traces).unwrap()
}

/// The laws of friction of a robot, at rest.
pub type Laws<'a> = dyn Fn(&Robot<f64>) -> [Box<dyn FrictionLaw>; 3] + 'a;

fn recorded(rig: &Rig, plan: &Plan, robot: &Robot<f64>, seed: u64, laws: &Laws) -> Trace {
    let settings = Settings { seed, ..Settings::default() };
    let block = plan.block(rig);
    let mut board = InProcess::default();
    let robot = SimulatedRobot::at_rest(*robot, start_of(&block), &settings)
        .with_friction_laws(laws(robot));
    let recording = record_robot(&mut board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
    Trace::of_log(recording.log, plan.entry("csv"), COUNTS_PER_TURN)
}

/// Root mean square error of the torques in parts of their own, the worst joint's, over
/// random states inside the excitation's range.
pub fn torque_error(found: &Robot<f64>, truth: &Robot<f64>) -> f64 {
    let mut random = Pcg64Mcg::new(0xDA7A | 1);
    let mut within = |limit: f64| Uniform::new(-limit, limit).unwrap().sample(&mut random);
    let (mut error, mut whole) = ([0.0; 3], [0.0; 3]);
    for _ in 0..2000 {
        let q = [within(3.1), within(3.1), within(3.1)];
        let qd = [within(5.0), within(8.0), within(8.0)];
        let qdd = [within(15.0), within(25.0), within(40.0)];
        let torque = |robot: &Robot<f64>| {
            Posture::new(q[1], q[2]).inverse_dynamics(&robot.base, &robot.geometry, &qd, &qdd)
        };
        let (a, b) = (torque(found), torque(truth));
        for joint in 0..3 {
            error[joint] += (a[joint] - b[joint]).powi(2);
            whole[joint] += b[joint].powi(2);
        }
    }
    (0..3).map(|joint| f64::sqrt(error[joint] / whole[joint])).fold(0.0, f64::max)
}
