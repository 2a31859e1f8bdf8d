//! The second test of section 3.3: with friction compensated the joint swings on by itself.
#![allow(missing_docs)]

use firmware::Mode;
use firmware::reference::{FrictionExcitation, Injection};
use rig::plan;
use simulation::board::InProcess;
use simulation::{Settings, record};
use tests::rig;

/// Peak angle of joint 3 from hanging [rad] in the seconds 7 to 9 and 17 to 19, after six
/// seconds of sinusoidal voltage.
fn swing(mode: Mode, amplitude_v: f32) -> [f64; 2] {
    let rig = rig();
    let mut plan = plan::friction_excitation(&rig);
    plan.mode[2] = mode;
    plan.reference.duration_s = 6.0;
    plan.reference.injection[2] = Injection::FrictionExcitation(FrictionExcitation {
        first_amplitude_v: amplitude_v,
        last_amplitude_v: amplitude_v,
        growth_s: 6.0,
        slow_period_s: 2.0,
        fast_period_s: 1.2,
    });
    let block = plan.block(&rig);
    let settings = Settings::default();
    let mut board = InProcess::default();
    let recording = record(&mut board, &block, &rig.model, &settings, 20_000, &mut |_| {}).unwrap();
    let q = recording.log.joints[2].position_rad(f64::from(rig.encoder_counts_per_turn));
    [7000..9000, 17_000..19_000].map(|range| {
        let (low, high) =
            q[range].iter().fold((f64::MAX, f64::MIN), |(l, h), &x| (l.min(x), h.max(x)));
        0.5 * (high - low)
    })
}

#[test]
fn compensated_friction_lets_the_joint_swing_on() {
    let [early, late] = swing(Mode::FrictionOnly, 0.1);
    println!("compensated: {early:.3} rad, ten seconds later {late:.3} rad");
    assert!(early > 0.1, "it swings: {early}");
    assert!((0.5..1.6).contains(&(late / early)), "it swings on: {early} {late}");
}

#[test]
fn without_compensation_friction_stops_it() {
    let [early, late] = swing(Mode::OpenLoop, 0.8);
    println!("not compensated: {early:.3} rad, ten seconds later {late:.4} rad");
    assert!(late < 0.01, "{early} {late}");
}
