//! What a trial of the whole way draws.

use crate::diverse::FrictionRanges;

/// What a trial of the whole way draws.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeWaySettings {
    /// Same seed, same robots and changes.
    pub seed: u32,
    /// Number of the first robot.
    pub first: u32,
    /// How many robots.
    pub robots: u32,
    /// All durations of the logs after the change times this. The campaign is never shortened:
    /// its eight minutes are simulated in seconds, and without all of its legs the Stribeck curve
    /// is not determined.
    pub duration_scale: f64,
    /// Only these effects, by name; all of the catalogue where it is empty.
    pub only: Vec<String>,
    /// The laws' own parameters, as in the diverse trial.
    pub friction: FrictionRanges,
}

/// The laws of friction in turn, robot by robot, as places of [`FrictionRanges::laws`]: LuGre,
/// regularised Coulomb (tanh, ramp), no Stribeck curve or many bristles (Dahl, Maxwell slip),
/// Stribeck with lag, soft constraint.
pub const LAWS: [&[usize]; 5] = [&[0], &[1, 2], &[3, 4], &[5], &[6]];

/// Amplifier noise [V rms], as the plain trial draws it.
pub const NOISE_V: (f64, f64) = (0.003, 0.006);

/// A user notices a change whose part of the command gap, in parts of what the identified model
/// leaves without it, is this much on some joint and log: with it the gap is twice as large,
/// sqrt(2^2 - 1).
pub const NOTICED: f64 = 1.732;

impl WholeWaySettings {
    /// The whole catalogue, logs of full length.
    pub fn new(seed: u32, first: u32, robots: u32) -> Self {
        let friction = FrictionRanges::default();
        Self { seed, first, robots, duration_scale: 1.0, only: Vec::new(), friction }
    }
}
