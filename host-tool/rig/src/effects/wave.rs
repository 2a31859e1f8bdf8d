//! A wave over the turn of a shaft, at an instant or on average over an interval.

use model::effects::AngularHarmonic;

use crate::plant::Gear;

/// A wave over the turn of a shaft of a joint: sin(n g q + phi), with g turns of the shaft per turn of the joint.
#[derive(Clone, Debug)]
pub struct Wave {
    harmonic: AngularHarmonic<f64>,
    /// Turns of the shaft per turn of the joint.
    turns: f64,
    /// Over which it is averaged [s]; 0 for an instant.
    interval_s: f64,
}

impl Wave {
    /// A wave of an order per turn of the joint, until it is told of gears.
    pub fn new(order: f64, phase_rad: f64) -> Self {
        Self { harmonic: AngularHarmonic { order, phase_rad }, turns: 1.0, interval_s: 0.0 }
    }

    /// The same per turn of the motor.
    pub fn set_motor(&mut self, gear: Gear) {
        self.turns = gear.motor;
    }

    /// The time over which it is averaged [s].
    pub fn set_interval(&mut self, interval_s: f64) {
        self.interval_s = interval_s;
    }

    /// The wave where the joint passes an angle at a velocity; on average over the interval about that, sin(x) / x
    /// of it, with x half the phase that passes meanwhile.
    pub fn sine(&self, q_rad: f64, qd_rad_per_s: f64) -> f64 {
        let half = 0.5 * self.harmonic.order * self.turns * qd_rad_per_s * self.interval_s;
        self.harmonic.sine(self.turns * q_rad) * sine_over(half)
    }
}

/// sin(x) / x, to 1e-9.
fn sine_over(x: f64) -> f64 {
    match x.abs() < 0.1 {
        true => 1.0 - x * x / 6.0 * (1.0 - x * x / 20.0),
        false => x.sin() / x,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of a wave over an interval in which a joint passes `q_rad` at `qd_rad_per_s` in the middle, by sums.
    fn summed(wave: &Wave, q_rad: f64, qd_rad_per_s: f64, interval_s: f64) -> f64 {
        const PARTS: usize = 1000;
        let at = |k: usize| {
            let t_s = interval_s * ((k as f64 + 0.5) / PARTS as f64 - 0.5);
            wave.sine(q_rad + qd_rad_per_s * t_s, 0.0)
        };
        (0..PARTS).map(at).sum::<f64>() / PARTS as f64
    }

    #[test]
    fn the_mean_over_an_interval_is_that_of_a_sum() {
        let mut wave = Wave::new(9.0, 0.4);
        wave.set_motor(Gear { motor: -50.0, ..Gear::DIRECT });
        let instant = wave.clone();
        wave.set_interval(2e-3);
        for qd_rad_per_s in [0.0, 0.05, 0.4, 1.0, 3.0, 7.0] {
            let mean = wave.sine(0.7, qd_rad_per_s);
            let sum = summed(&instant, 0.7, qd_rad_per_s, 2e-3);
            assert!((mean - sum).abs() < 1e-5, "{qd_rad_per_s} rad/s: {mean} for {sum}");
        }
    }

    #[test]
    fn the_series_meets_the_quotient() {
        for x in [1e-6, 0.0999999, -0.05] {
            assert!((sine_over(x) - f64::sin(x) / x).abs() < 1e-9);
        }
    }
}
