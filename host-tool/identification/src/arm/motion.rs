//! The smoothed motion of a stretch, and its command smoothed alike.

use signal::LowPass;
use signal::derivative::{decimated, first, midpoints, second};

use super::band::Band;
use super::stretch::Stretch;

/// When the command of a row acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CommandTime {
    /// From the row on until the next: its middle lies half a sample later.
    Held,
    /// At the time of the row: a measured voltage, current or torque.
    Sampled,
}

/// A stretch's motion, thinned to eight samples per period of the first cut-off.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Time between samples [s].
    pub period_s: f64,
    /// Position, velocity and acceleration per joint.
    pub states: [Vec<Vec<f64>>; 3],
    /// Commands per joint.
    pub command: Vec<Vec<f64>>,
}

impl Motion {
    /// Smooths a stretch within its band.
    pub fn of(stretch: &Stretch, band: &Band, time: CommandTime) -> Self {
        /// Samples per period of the first cut-off that stay.
        const SAMPLES_PER_PERIOD: f64 = 8.0;
        let period_s = stretch.period_s;
        let filter = LowPass::new(band.cutoff_hz, period_s);
        let stride = (1.0 / (SAMPLES_PER_PERIOD * band.cutoff_hz * period_s)).max(1.0) as usize;
        let thin = |signal: Vec<f64>| decimated(&signal, 0, stride);
        let smooth: Vec<Vec<f64>> = (stretch.position.iter())
            .map(|position| match time {
                CommandTime::Held => midpoints(&filter.zero_phase(position)),
                CommandTime::Sampled => filter.zero_phase(position),
            })
            .collect();
        let slope = |q: &Vec<f64>| thin(first(q, period_s));
        let curvature = |q: &Vec<f64>| thin(second(q, period_s));
        Self {
            period_s: stride as f64 * period_s,
            command: stretch.command.iter().map(|u| thin(filter.zero_phase(u))).collect(),
            states: [
                smooth.iter().map(|q| thin(q.clone())).collect(),
                smooth.iter().map(slope).collect(),
                smooth.iter().map(curvature).collect(),
            ],
        }
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.command.first().map_or(0, Vec::len)
    }

    /// Position, velocity and acceleration of all joints at a sample.
    pub fn at(&self, sample: usize) -> [Vec<f64>; 3] {
        [0, 1, 2].map(|order| self.states[order].iter().map(|joint| joint[sample]).collect())
    }
}
