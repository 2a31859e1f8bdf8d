//! Cost on the host of the calls that the simulator and the estimators live on.
#![allow(missing_docs)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use model::reference_robot::reference_robot;
use model::regressor::regressor;
use model::{FrictionState, Posture, Real};

fn inverse_dynamics<T: Real>(criterion: &mut Criterion, name: &str) {
    let robot = reference_robot::<T>();
    let [q, qd, qdd] = [[0.3, -1.2, 0.8], [1.5, -2.0, 3.0], [9.0, -8.0, 7.0]]
        .map(|state: [f64; 3]| state.map(T::constant));
    criterion.bench_function(&format!("inverse dynamics, sines included, {name}"), |b| {
        b.iter(|| {
            let q = black_box(q);
            Posture::new(q[1], q[2]).inverse_dynamics(
                &robot.base,
                &robot.geometry,
                &black_box(qd),
                &black_box(qdd),
            )
        })
    });
    criterion.bench_function(&format!("forward dynamics, sines included, {name}"), |b| {
        b.iter(|| {
            let q = black_box(q);
            Posture::new(q[1], q[2]).forward_dynamics(
                &robot.base,
                &robot.geometry,
                &black_box(qd),
                &black_box(qdd),
            )
        })
    });
    criterion.bench_function(&format!("regressor 3x16, {name}"), |b| {
        b.iter(|| {
            let q = black_box(q);
            regressor(&Posture::new(q[1], q[2]), &robot.geometry, &black_box(qd), &black_box(qdd))
        })
    });
}

fn friction<T: Real>(criterion: &mut Criterion, name: &str) {
    let robot = reference_robot::<T>();
    let mut state = FrictionState { deflection_rad: T::zero() };
    let step_s = T::constant(1e-4);
    criterion.bench_function(&format!("friction step of one joint, {name}"), |b| {
        b.iter(|| state.step(&robot.friction[2], black_box(T::constant(0.004)), step_s))
    });
}

fn all(criterion: &mut Criterion) {
    inverse_dynamics::<f64>(criterion, "f64");
    inverse_dynamics::<f32>(criterion, "f32");
    friction::<f64>(criterion, "f64");
    friction::<f32>(criterion, "f32");
}

criterion_group!(benches, all);
criterion_main!(benches);
