//! What mechanisms cost, as the fastest of many batches: fit for a machine that does other work too.
//!
//! `cargo run --release -p model --example mechanism_costs`

use std::hint::black_box;
use std::time::Instant;

use model::mechanism::{Mechanism, Rrr};
use model::reference_robot::reference_robot;

#[path = "../benches/common/arm.rs"]
mod arm;

const BATCHES: usize = 500;
const CALLS: usize = 500;

/// Time of a call [ns].
fn cost(mut call: impl FnMut()) -> f64 {
    let mut batch = || {
        let start = Instant::now();
        (0..CALLS).for_each(|_| call());
        start.elapsed().as_secs_f64() / CALLS as f64
    };
    1e9 * (0..BATCHES).map(|_| batch()).fold(f64::INFINITY, f64::min)
}

fn row(name: &str, arm: &dyn Mechanism<f64>) {
    let (n, p) = (arm.joints(), arm.parameter_count());
    let state = |scale: f64| (0..n).map(|k| scale * (1.0 + 0.7 * k as f64).sin()).collect();
    let [q, qd, qdd]: [Vec<f64>; 3] = [3.0, 2.0, 10.0].map(state);
    let (mut torque, mut square, mut rows) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * p]);
    let mut jacobian = vec![0.0; 6 * n];
    let costs = [
        cost(|| arm.inverse_dynamics(black_box(&q), black_box(&qd), &qdd, &mut torque)),
        cost(|| arm.forward_dynamics(black_box(&q), black_box(&qd), &qdd, &mut torque)),
        cost(|| arm.mass_matrix(black_box(&q), &mut square)),
        cost(|| arm.regressor(black_box(&q), black_box(&qd), &qdd, &mut rows)),
        cost(|| arm.tip_jacobian(black_box(&q), &mut jacobian)),
    ];
    let costs: Vec<String> = costs.iter().map(|cost| format!("{cost:.0}")).collect();
    println!("| {name} | {} |", costs.join(" | "));
}

fn main() {
    println!(
        "| [ns] | inverse dynamics | forward dynamics | mass matrix | regressor | tip Jacobian |"
    );
    println!("| --- | --- | --- | --- | --- | --- |");
    row("closed form, 3 joints", black_box(&Rrr::of(&reference_robot())));
    for joints in [3, 6, 7] {
        row(&format!("chain, {joints} joints"), black_box(&arm::arm(joints)));
    }
}
