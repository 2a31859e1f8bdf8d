//! Residuals summed by angle, from which the waves over a turn follow at little cost.

use std::f64::consts::TAU;

use super::samples::Samples;
use super::samples::root_mean_square;

/// What a wave over the angle is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// Nothing: it acts whatever the motion.
    Constant,
    /// The direction of motion, as friction is.
    Direction,
    /// The command, as the torque constant is.
    Command,
}

/// All carriers.
const CARRIERS: [Carrier; 3] = [Carrier::Constant, Carrier::Direction, Carrier::Command];

const BINS: usize = 1024;

/// Sums over the samples in each small range of the angle.
pub(super) struct AngleSums {
    /// Carrier times residual.
    right: [Vec<f64>; 3],
    /// Carrier squared.
    weight: [Vec<f64>; 3],
    cosine: Vec<f64>,
}

/// One wave over the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wave {
    pub order: usize,
    pub carrier: Carrier,
    /// What it takes off the residual's sum of squares [V^2].
    pub energy_v2: f64,
    /// Its amplitude at the carrier's rms [V].
    pub amplitude_v: f64,
}

impl Carrier {
    /// The carrier at every sample, of rms about 1.
    pub fn values(self, samples: &Samples) -> Vec<f64> {
        match self {
            Self::Constant => vec![1.0; samples.len()],
            Self::Direction => samples.direction.clone(),
            Self::Command => {
                let rms = root_mean_square(&samples.command_v).max(f64::MIN_POSITIVE);
                samples.command_v.iter().map(|u| u / rms).collect()
            }
        }
    }
}

impl AngleSums {
    /// The sums of a residual, one value per sample.
    pub fn of(samples: &Samples, residual_v: &[f64]) -> Self {
        let mut sums = Self {
            right: [(); 3].map(|()| vec![0.0; BINS]),
            weight: [(); 3].map(|()| vec![0.0; BINS]),
            cosine: (0..BINS).map(|bin| (TAU * bin as f64 / BINS as f64).cos()).collect(),
        };
        for (index, carrier) in CARRIERS.iter().enumerate() {
            for (k, value) in carrier.values(samples).into_iter().enumerate() {
                let bin = bin_of(samples.position_rad[k]);
                sums.right[index][bin] += value * residual_v[k];
                sums.weight[index][bin] += value * value;
            }
        }
        sums
    }

    /// The wave of one order and carrier that fits best.
    pub fn wave(&self, order: usize, carrier: Carrier) -> Wave {
        let index = CARRIERS.iter().position(|&c| c == carrier).unwrap_or(0);
        let (right, weight) = (&self.right[index], &self.weight[index]);
        let [mut cc, mut cs, mut ss, mut rc, mut rs] = [0.0; 5];
        for bin in 0..BINS {
            let turn = order * bin;
            let (c, s) = (self.cosine[turn % BINS], self.cosine[(turn + 3 * BINS / 4) % BINS]);
            let (w, r) = (weight[bin], right[bin]);
            cc += w * c * c;
            cs += w * c * s;
            ss += w * s * s;
            rc += r * c;
            rs += r * s;
        }
        let determinant = cc * ss - cs * cs;
        if determinant <= 1e-6 * (cc + ss).powi(2) {
            return Wave { order, carrier, energy_v2: 0.0, amplitude_v: 0.0 };
        }
        let (a, b) = ((ss * rc - cs * rs) / determinant, (cc * rs - cs * rc) / determinant);
        Wave { order, carrier, energy_v2: a * rc + b * rs, amplitude_v: a.hypot(b) }
    }

    /// The wave that takes most off the residual.
    pub fn best(&self, lowest: usize, highest: usize) -> Option<Wave> {
        let orders = (lowest..=highest).flat_map(|order| CARRIERS.map(|carrier| (order, carrier)));
        let waves = orders.map(|(order, carrier)| self.wave(order, carrier));
        waves.max_by(|a, b| a.energy_v2.total_cmp(&b.energy_v2))
    }
}

fn bin_of(angle_rad: f64) -> usize {
    let part = (angle_rad / TAU).rem_euclid(1.0);
    (part * BINS as f64).round() as usize % BINS
}
