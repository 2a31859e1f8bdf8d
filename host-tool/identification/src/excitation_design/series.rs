//! The motion of all joints, sampled: the host's counterpart of what the board plays.

use std::f64::consts::TAU;

use firmware::reference::{FadeIn, FourierSeries, Motion, TERMS};

/// Angles, velocities and accelerations of the joints at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Angles [rad].
    pub q_rad: [f64; 3],
    /// Velocities [rad/s].
    pub qd_rad_per_s: [f64; 3],
    /// Accelerations [rad/s^2].
    pub qdd_rad_per_s2: [f64; 3],
}

/// Five-term Fourier series of three joints with one period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series {
    /// Centres [rad].
    pub centre_rad: [f64; 3],
    /// Period of the first term [s].
    pub period_s: f64,
    /// Time in which the motion swells from rest [s].
    pub fade_in_s: f64,
    /// Sine amplitudes of each joint [rad].
    pub sine_rad: [[f64; TERMS]; 3],
    /// Cosine amplitudes of each joint [rad].
    pub cosine_rad: [[f64; TERMS]; 3],
}

impl Series {
    /// The states of one whole period, `count` of them, evenly spaced.
    pub fn period(&self, count: usize) -> impl Iterator<Item = State> {
        let step_s = self.period_s / count as f64;
        (0..count).map(move |k| self.steady(k as f64 * step_s))
    }

    /// The states from rest until the motion has swollen, about `step_s` apart.
    pub fn beginning(&self, step_s: f64) -> impl Iterator<Item = State> {
        let count = (self.fade_in_s / step_s).ceil() as usize;
        (0..count).map(move |k| self.swelling(k as f64 * step_s))
    }

    /// The same motion with every joint's amplitudes times a factor.
    pub fn scaled(&self, factor: [f64; 3]) -> Self {
        let scaled = |rows: [[f64; TERMS]; 3]| [0, 1, 2].map(|i| rows[i].map(|x| x * factor[i]));
        Self { sine_rad: scaled(self.sine_rad), cosine_rad: scaled(self.cosine_rad), ..*self }
    }

    /// Whether nothing moves by more than an encoder's count.
    pub fn is_still(&self) -> bool {
        let amplitudes = self.sine_rad.as_flattened().iter().chain(self.cosine_rad.as_flattened());
        amplitudes.copied().all(|amplitude| amplitude.abs() < 1e-5)
    }

    /// The motion in the form that the board plays.
    pub fn motion(&self) -> [Motion; 3] {
        [0, 1, 2].map(|i| {
            Motion::Fourier(FourierSeries {
                centre_rad: self.centre_rad[i] as f32,
                period_s: self.period_s as f32,
                sine_rad: self.sine_rad[i].map(|a| a as f32),
                cosine_rad: self.cosine_rad[i].map(|b| b as f32),
                fade_in: FadeIn { duration_s: self.fade_in_s as f32 },
            })
        })
    }

    /// The periodic motion.
    fn steady(&self, time_s: f64) -> State {
        let mut state = self.wave(time_s);
        for (q, centre) in state.q_rad.iter_mut().zip(self.centre_rad) {
            *q += centre;
        }
        state
    }

    /// The motion as it begins, swollen as [`FadeIn`] does it.
    fn swelling(&self, time_s: f64) -> State {
        let wave = self.wave(time_s);
        let [swell, slope, curvature] = quintic_rise(time_s, self.fade_in_s);
        let each = |f: &dyn Fn(usize) -> f64| [f(0), f(1), f(2)];
        State {
            q_rad: each(&|i| self.centre_rad[i] + swell * wave.q_rad[i]),
            qd_rad_per_s: each(&|i| slope * wave.q_rad[i] + swell * wave.qd_rad_per_s[i]),
            qdd_rad_per_s2: each(&|i| {
                curvature * wave.q_rad[i]
                    + 2.0 * slope * wave.qd_rad_per_s[i]
                    + swell * wave.qdd_rad_per_s2[i]
            }),
        }
    }

    /// The sum of the terms, about zero.
    fn wave(&self, time_s: f64) -> State {
        let mut state = State::default();
        for term in 0..TERMS {
            let frequency = TAU * (term + 1) as f64 / self.period_s;
            let (sine, cosine) = (frequency * time_s).sin_cos();
            for i in 0..3 {
                let (a, b) = (self.sine_rad[i][term], self.cosine_rad[i][term]);
                let value = a * sine + b * cosine;
                state.q_rad[i] += value;
                state.qd_rad_per_s[i] += frequency * (a * cosine - b * sine);
                state.qdd_rad_per_s2[i] -= frequency * frequency * value;
            }
        }
        state
    }
}

/// A quintic from 0 to 1 over `duration_s`, with its first two derivatives.
fn quintic_rise(time_s: f64, duration_s: f64) -> [f64; 3] {
    let x = time_s / duration_s;
    if x >= 1.0 {
        return [1.0, 0.0, 0.0];
    }
    let rest = 1.0 - x;
    [
        x * x * x * (10.0 + x * (6.0 * x - 15.0)),
        30.0 * (x * rest).powi(2) / duration_s,
        60.0 * x * rest * (1.0 - 2.0 * x) / duration_s.powi(2),
    ]
}

#[cfg(test)]
mod tests {
    use firmware::reference::Time;

    use super::*;

    fn some_series() -> Series {
        Series {
            centre_rad: [0.1, -1.5, 0.3],
            period_s: 10.0,
            fade_in_s: 2.0,
            sine_rad: [[1.0, -0.5, 0.3, 0.2, -0.1]; 3],
            cosine_rad: [[0.4, 0.5, -0.3, 0.1, 0.2]; 3],
        }
    }

    /// Largest distance from what the firmware plays: velocity and acceleration.
    fn distance(states: impl Iterator<Item = State>, first_tick: u32) -> f64 {
        let motion = &some_series().motion()[2];
        let distance = |(tick, state): (u32, State)| {
            let played = motion.at(Time::new(tick, 1e-3, 1e3));
            let velocity = f64::from(played.velocity_rad_per_s) - state.qd_rad_per_s[2];
            let acceleration = f64::from(played.acceleration_rad_per_s2) - state.qdd_rad_per_s2[2];
            velocity.abs().max(acceleration.abs())
        };
        (first_tick..).zip(states).map(distance).fold(0.0, f64::max)
    }

    #[test]
    fn it_is_what_the_firmware_plays() {
        let series = some_series();
        let middle_s = |tick: u32| (f64::from(tick) + 0.5) * 1e-3;
        let beginning = (0..2000).map(|tick| series.swelling(middle_s(tick)));
        assert!(distance(beginning, 0) < 1e-4);
        let steady = (2000..12_000).map(|tick| series.steady(middle_s(tick)));
        assert!(distance(steady, 2000) < 1e-4);
    }
}
