//! Draws robots as they were bought.

use rig::effects::Random;

use super::settings::{LAWS, NOISE_V, WholeWaySettings};
use crate::case::{Case, Kind};
use crate::diverse::draw_law_among;
use crate::plans::Motions;
use crate::reality::Reality;
use crate::rng::Rng;
use crate::robots::RobotGenerator;
use model::reference_robot::reference_robot;

/// Marks the numbers of this trial, which are not those of the other trials' cases.
const OWN_NUMBERS: u32 = 0x4000_0000;

/// All robots of a trial, unchanged and without a model: the board works with the reference
/// robot's numbers.
pub fn draw_robots(settings: &WholeWaySettings) -> Vec<Case> {
    let robots = RobotGenerator::new();
    let numbers = settings.first..settings.first + settings.robots;
    numbers.map(|number| draw_robot(settings, &robots, number)).collect()
}

/// The random numbers of a robot for a purpose: 0 the robot, 1 its change.
pub(super) fn numbers(seed: u32, robot: u32, purpose: u32) -> Rng {
    Rng::new(seed, OWN_NUMBERS ^ (purpose << 28) ^ robot)
}

fn draw_robot(settings: &WholeWaySettings, robots: &RobotGenerator, number: u32) -> Case {
    let mut rng = numbers(settings.seed, number, 0);
    let robot = robots.true_robot(&mut rng);
    let laws = LAWS[(number.max(1) as usize - 1) % LAWS.len()];
    let friction = draw_law_among(laws, &settings.friction, &mut rng);
    Case {
        number,
        kind: Kind::None,
        nominal: reference_robot(),
        robot,
        causes: Vec::new(),
        visibility: None,
        motions: Motions::draw(&mut rng),
        duration_scale: settings.duration_scale,
        noise_v: rng.uniform(NOISE_V.0, NOISE_V.1),
        seed: rng.seed(),
        reality: Some(Reality { friction, ..Reality::plain() }),
    }
}
