//! The paper's own numbers: its robot is simulated, identified, and set beside Tables 2, 3, (19).
#![allow(missing_docs)]

mod campaign;

use campaign::recorded_campaign;
use identification::procedure::identify;
use model::base::NAMES;
use model::reference_robot::reference_robot;

#[test]
fn the_papers_robot_comes_back() {
    let truth = reference_robot::<f64>();
    let found = identify(&recorded_campaign(&truth, 2), &|_| {}).unwrap();
    println!("{:12} {:>10} {:>10}", "parameter", "paper", "identified");
    let scale = truth.base.to_array().into_iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let pairs = truth.base.to_array().into_iter().zip(found.robot.base.to_array());
    for (name, (paper, identified)) in NAMES.iter().zip(pairs) {
        println!("{name:12} {paper:10.4} {identified:10.4}");
        assert!((paper - identified).abs() < 1e-3 * scale, "{name}");
    }
    for (joint, (paper, identified)) in (1..).zip(truth.friction.iter().zip(&found.robot.friction))
    {
        let rows = [
            ("alpha0", paper.alpha0_v, identified.alpha0_v, 0.03),
            ("alpha1", paper.alpha1_v, identified.alpha1_v, 0.3),
            ("alpha2", paper.alpha2_v_s_per_rad, identified.alpha2_v_s_per_rad, 0.03),
            ("sigma0", paper.sigma0_v_per_rad, identified.sigma0_v_per_rad, 0.07),
            ("sigma1", paper.sigma1_v_s_per_rad, identified.sigma1_v_s_per_rad, 0.2),
        ];
        for (name, paper, identified, share) in rows {
            println!("{:12} {paper:10.4} {identified:10.4}", format!("{name} {joint}"));
            assert!((identified / paper - 1.0).abs() < share, "{name} of joint {joint}");
        }
    }
}
