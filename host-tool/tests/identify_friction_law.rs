//! The law of friction that `rrr identify` takes, joint by joint.
#![allow(missing_docs)]

mod campaign;

use campaign::{perturbed_robot, recorded_campaign_with, torque_error};
use identification::friction_law::Law;
use identification::procedure::{identify, model_file};
use model::Robot;
use simulation::FrictionLaw;
use simulation::friction_law::{LuGre, RegularisedCoulomb, Slope, SoftConstraint};

#[test]
fn bristles_are_taken_where_there_are_any() {
    let robot = perturbed_robot(1002);
    let laws = |robot: &Robot<f64>| -> [Box<dyn FrictionLaw>; 3] {
        let [first, second, third] = robot.friction;
        [
            Box::new(RegularisedCoulomb::new(first, Slope::Tanh, 0.02)),
            Box::new(LuGre::new(second)),
            Box::new(SoftConstraint::new(third, 0.01)),
        ]
    };
    let campaign = recorded_campaign_with(&robot, 1002, &laws);
    let found = identify(&campaign, &|_| {}).unwrap();
    let sentences = found.laws.each_ref().map(|law| law.sentence());
    let taken = found.laws.each_ref().map(|law| law.law);
    assert_eq!(taken, [Law::Static, Law::LuGre, Law::Static], "{sentences:#?}");
    for (friction, truth) in found.robot.friction.iter().zip(&robot.friction) {
        assert!((friction.alpha0_v / truth.alpha0_v - 1.0).abs() < 0.02, "{friction:?} {truth:?}");
        assert!((1.0..1e5).contains(&friction.sigma0_v_per_rad), "{friction:?}");
    }
    let bristles = found.robot.friction[1].sigma0_v_per_rad;
    assert!((bristles / robot.friction[1].sigma0_v_per_rad - 1.0).abs() < 0.07, "{bristles}");
    let held_out = found.held_out.iter().flat_map(|held| held.residuals());
    held_out.for_each(|residual| assert!(residual.share < 0.02, "{residual:?}"));
    assert!(torque_error(&found.robot, &robot) < 0.01);
    let file = model_file(&found, &campaign.robot_file);
    let error = &file.friction[0].extra["standard_error"]["sigma0_V_per_rad"];
    assert_eq!(error.as_float(), Some(found.robot.friction[0].sigma0_v_per_rad));
}
