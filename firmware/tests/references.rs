//! Every motion's velocity and acceleration are the derivatives of its angle.
#![allow(missing_docs)]

use firmware::Angle;
use firmware::reference::{ConstantVelocity, FadeIn, FourierSeries, Motion, Setpoint, Sine, Time};

const PERIOD_S: f32 = 1e-3;

fn motions() -> [(&'static str, Motion); 5] {
    let fade_in = FadeIn { duration_s: 1.0 };
    [
        ("hold", Motion::Hold { angle_rad: -0.7 }),
        ("quintic", Motion::Quintic { from_rad: 0.5, to_rad: -1.1, duration_s: 1.5 }),
        (
            "sine",
            Motion::Sine(Sine { centre_rad: 1.5, amplitude_rad: 1.57, period_s: 5.0, fade_in }),
        ),
        (
            "Fourier",
            Motion::Fourier(FourierSeries {
                centre_rad: 0.2,
                period_s: 4.0,
                sine_rad: [0.5, -0.3, 0.2, 0.1, -0.05],
                cosine_rad: [-0.4, 0.2, 0.1, -0.1, 0.05],
                fade_in,
            }),
        ),
        (
            "legs",
            Motion::ConstantVelocity(ConstantVelocity {
                start_rad: -1.0,
                speeds_rad_per_s: [0.5, 1.5].into_iter().collect(),
                leg_s: 0.8,
                ramp_s: 0.2,
            }),
        ),
    ]
}

fn setpoints(motion: &Motion) -> Vec<Setpoint> {
    (0..6000).map(|tick| motion.at(Time::new(tick, PERIOD_S, 1.0 / PERIOD_S))).collect()
}

/// The largest of |a - b| over a sequence of pairs.
fn worst(pairs: impl Iterator<Item = (f32, f32)>) -> f32 {
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn velocity_is_the_slope_of_the_angle() {
    for (name, motion) in motions() {
        let points = setpoints(&motion);
        let error = worst(points.windows(2).map(|w| {
            let slope = w[1].angle.minus(w[0].angle) / PERIOD_S;
            (slope, 0.5 * (w[0].velocity_rad_per_s + w[1].velocity_rad_per_s))
        }));
        assert!(error < 4e-3, "{name}: {error} rad/s");
    }
}

#[test]
fn acceleration_is_the_slope_of_the_velocity() {
    for (name, motion) in motions() {
        let points = setpoints(&motion);
        let rough = points.windows(2).filter(|w| {
            // A trapezoid's acceleration jumps at its corners.
            let jump = w[1].acceleration_rad_per_s2 - w[0].acceleration_rad_per_s2;
            jump.abs() < 1.0
        });
        let error = worst(rough.map(|w| {
            let slope = (w[1].velocity_rad_per_s - w[0].velocity_rad_per_s) / PERIOD_S;
            (slope, 0.5 * (w[0].acceleration_rad_per_s2 + w[1].acceleration_rad_per_s2))
        }));
        assert!(error < 2e-2, "{name}: {error} rad/s^2");
    }
}

#[test]
fn fading_motions_begin_at_rest() {
    for (name, motion) in motions() {
        let first = setpoints(&motion)[0];
        assert!(first.velocity_rad_per_s.abs() < 5e-3, "{name}: {first:?}");
    }
}

#[test]
fn half_a_tick_earlier_is_the_tick_itself() {
    let (_, motion) = &motions()[2];
    let points = setpoints(motion);
    for w in points.windows(3).skip(2000) {
        let between = w[1].earlier(0.5 * PERIOD_S).angle.minus(w[0].angle);
        let half = 0.5 * w[1].angle.minus(w[0].angle);
        assert!((between - half).abs() < 2e-6, "{between} {half}");
    }
}

#[test]
fn periodic_motions_repeat_exactly() {
    const FADE_IN: usize = 1000;
    let (_, motion) = &motions()[3];
    let angles: Vec<Angle> = setpoints(motion).iter().map(|p| p.angle).collect();
    let second_period = &angles[4000 + FADE_IN..];
    assert_eq!(second_period, &angles[FADE_IN..FADE_IN + second_period.len()]);
}

#[test]
fn legs_come_back_to_the_start() {
    let (_, motion) = &motions()[4];
    let points = setpoints(motion);
    let start = Angle::from_radians(-1.0);
    for pair_end in [1600, 3200, 4800] {
        let gap = points[pair_end].angle.minus(start);
        assert!(gap.abs() < 1e-5, "{gap} at {pair_end}");
    }
}
