//! A wave over the turn of a shaft, at an instant or between the samples of a motion.

use model::effects::AngularHarmonic;

use crate::plant::Gear;

/// A wave over the turn of a shaft of a joint: sin(n g q + phi), with g turns of the shaft per turn of the joint.
#[derive(Clone, Debug)]
pub struct Wave {
    harmonic: AngularHarmonic<f64>,
    /// Turns of the shaft per turn of the joint.
    turns: f64,
    /// Between samples of the motion that it acts along [s]; 0 for an instant.
    interval_s: f64,
}

impl Wave {
    /// A wave of an order per turn of the joint, until it is told of gears.
    pub fn new(order: f64, phase_rad: f64) -> Self {
        Self { harmonic: AngularHarmonic { order, phase_rad }, turns: 1.0, interval_s: 0.0 }
    }

    /// Makes it one per turn of the motor.
    pub fn set_motor(&mut self, gear: Gear) {
        self.turns = gear.motor;
    }

    /// The time between samples of a motion that it acts along [s].
    pub fn set_interval(&mut self, interval_s: f64) {
        self.interval_s = interval_s;
    }

    /// The wave where the joint passes an angle at a velocity, at an instant; or in the interval about that, so that
    /// the mean over two intervals is what the second difference of their angles feels of it.
    pub fn sine(&self, q_rad: f64, qd_rad_per_s: f64) -> f64 {
        let half = 0.5 * self.harmonic.order * self.turns * qd_rad_per_s * self.interval_s;
        self.harmonic.sine(self.turns * q_rad) * of_interval(half)
    }
}

/// What second differences of a motion feel of a wave of the torque of which half a sample's phase is x: they weigh
/// it by a triangle over two intervals, whose gain is (sin(x) / x)^2.
pub fn felt_by_second_differences(x: f64) -> f64 {
    match x.abs() < 1e-2 {
        true => 1.0 - x * x / 3.0,
        false => (x.sin() / x).powi(2),
    }
}

/// At half the rate of the samples intervals take opposite parts of a wave, and would have to be infinite for their
/// mean to leave anything of it. Where that mean is less than about this part of theirs they are kept small: a wave
/// is told to be smaller there than it is, and filters of rows leave little of it.
const NEARLY_OPPOSITE: f64 = 0.3;

/// The part of a wave that each of two intervals takes, whose mean is cos(x) of that: what second differences feel
/// over cos(x), regularised.
fn of_interval(x: f64) -> f64 {
    let (cos, least) = (x.cos(), NEARLY_OPPOSITE * NEARLY_OPPOSITE);
    felt_by_second_differences(x) * cos * (1.0 + least) / (cos * cos + least)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD_S: f64 = 2e-3;

    /// A wave about an instant at which a joint passes `q_rad` at `qd_rad_per_s`, weighed by a triangle over two periods.
    fn felt(wave: &Wave, q_rad: f64, qd_rad_per_s: f64) -> f64 {
        const PARTS: usize = 4000;
        let at = |k: usize| {
            let part = 2.0 * (k as f64 + 0.5) / PARTS as f64 - 1.0;
            let q_rad = q_rad + qd_rad_per_s * part * PERIOD_S;
            2.0 * (1.0 - part.abs()) * wave.sine(q_rad, 0.0)
        };
        (0..PARTS).map(at).sum::<f64>() / PARTS as f64
    }

    #[test]
    fn the_mean_of_two_intervals_is_what_second_differences_feel() {
        let mut wave = Wave::new(9.0, 0.4);
        wave.set_motor(Gear { motor: -50.0, ..Gear::DIRECT });
        let instant = wave.clone();
        wave.set_interval(PERIOD_S);
        // Half a sample's phase is 0.45 rad per rad/s; 3.5 rad/s is half the rate of samples.
        let rates = [(0.0, 1e-6), (0.1, 1e-3), (0.5, 0.006), (2.0, 0.1), (7.0, 0.01)];
        for (qd_rad_per_s, most) in rates {
            let half_rad = 0.5 * PERIOD_S * qd_rad_per_s;
            let mean = 0.5
                * (wave.sine(0.7 - half_rad, qd_rad_per_s)
                    + wave.sine(0.7 + half_rad, qd_rad_per_s));
            let felt = felt(&instant, 0.7, qd_rad_per_s);
            assert!((mean - felt).abs() < most, "{qd_rad_per_s} rad/s: {mean} for {felt}");
        }
    }
}
