//! Cost on the host of mechanisms behind their interface.
#![allow(missing_docs)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use model::mechanism::{Mechanism, Rrr};
use model::reference_robot::reference_robot;

#[path = "common/arm.rs"]
mod arm;

use arm::arm;

fn costs(criterion: &mut Criterion, name: &str, arm: &dyn Mechanism<f64>) {
    let (n, p) = (arm.joints(), arm.parameter_count());
    let state = |scale: f64| (0..n).map(|k| scale * (1.0 + 0.7 * k as f64).sin()).collect();
    let [q, qd, qdd]: [Vec<f64>; 3] = [3.0, 2.0, 10.0].map(state);
    let (mut torque, mut square, mut rows) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * p]);
    let mut jacobian = vec![0.0; 6 * n];
    criterion.bench_function(&format!("{name}: inverse dynamics"), |b| {
        b.iter(|| arm.inverse_dynamics(black_box(&q), black_box(&qd), &qdd, &mut torque))
    });
    criterion.bench_function(&format!("{name}: forward dynamics"), |b| {
        b.iter(|| arm.forward_dynamics(black_box(&q), black_box(&qd), &qdd, &mut torque))
    });
    criterion.bench_function(&format!("{name}: mass matrix"), |b| {
        b.iter(|| arm.mass_matrix(black_box(&q), &mut square))
    });
    criterion.bench_function(&format!("{name}: regressor"), |b| {
        b.iter(|| arm.regressor(black_box(&q), black_box(&qd), &qdd, &mut rows))
    });
    criterion.bench_function(&format!("{name}: Jacobian of the tip"), |b| {
        b.iter(|| arm.tip_jacobian(black_box(&q), &mut jacobian))
    });
}

fn all(criterion: &mut Criterion) {
    costs(criterion, "closed form, 3 joints", &Rrr::of(&reference_robot()));
    costs(criterion, "chain, 3 joints", &arm(3));
    costs(criterion, "chain, 6 joints", &arm(6));
    costs(criterion, "chain, 7 joints", &arm(7));
}

criterion_group!(benches, all);
criterion_main!(benches);
