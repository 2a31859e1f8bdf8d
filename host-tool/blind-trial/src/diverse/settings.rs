//! What diverse realities are drawn from; every range with its reason.

use crate::case::Kind;

/// From the least to the most.
pub type Range = (f64, f64);

/// What a diverse trial draws.
#[derive(Clone, Debug, PartialEq)]
pub struct DiverseSettings {
    /// Same seed, same cases.
    pub seed: u32,
    /// Number of the first case.
    pub first: u32,
    /// How many cases.
    pub cases: u32,
    /// All durations of the logs times this.
    pub duration_scale: f64,
    /// Where everything is drawn from.
    pub ranges: Ranges,
}

/// Where everything is drawn from. Ranges of sizes are drawn evenly in the logarithm.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranges {
    /// Kinds of cases, and how often. As in the plain trial, but for more pairs, since what
    /// matters in use is a large cause beside a small one.
    pub kinds: [(Kind, f64); 4],
    /// How often a cause of a pair is foreign: one in seven, as often as a single is.
    pub foreign_in_pair: f64,
    /// How often a foreign cause is a shape of one that the catalogue has, and not something
    /// wholly unlike: two thirds, since real machines rather have known things in odd shapes.
    pub shapes: f64,
    /// Friction.
    pub friction: FrictionRanges,
    /// Small effects.
    pub clutter: ClutterRanges,
    /// Noise, encoder, clock, bus.
    pub bus: BusRanges,
    /// Models as given.
    pub model: ModelRanges,
    /// Sizes of causes.
    pub sizes: SizeRanges,
}

/// Laws of friction and their own parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionRanges {
    /// How often each law is drawn, in the order LuGre, tanh, ramp, Dahl, Maxwell slip, Stribeck
    /// with lag, soft constraint; those with a smooth Coulomb step share one part. LuGre, which
    /// the diagnosis knows, is one in seven.
    pub laws: [f64; 7],
    /// Width of a smoothed Coulomb step [rad/s]: what simulators use, from fine to coarse.
    pub width_rad_per_s: Range,
    /// Dahl's stiffness in parts of sigma0: a quarter to twice.
    pub dahl_stiffness: Range,
    /// Elements of Maxwell slip: 4 to 8, as in the literature.
    pub slip_elements: Range,
    /// Deflection of the softest element in parts of the stiffest's: gears have one to two decades.
    pub slip_spread: Range,
    /// How fast a slipping element goes to its level [1/s]: within 5 to 100 ms.
    pub slip_attraction_per_s: Range,
    /// Lag of the Stribeck curve [s]: measured films of oil follow within 5 to 50 ms.
    pub stribeck_lag_s: Range,
    /// Stribeck velocity in parts of the model's: larger, so that the lag is met in motion.
    pub stribeck_factor: Range,
    /// Velocity at which a soft constraint gives in [rad/s]: MuJoCo's defaults on such joints.
    pub creep_rad_per_s: Range,
    /// How often friction falls with its own work.
    pub warm: f64,
    /// By which part.
    pub fall: Range,
    /// In what time [s]: some ten seconds, so that it goes on from log to log.
    pub warming_s: Range,
    /// Power that warms, in parts of what friction takes at 1 rad/s.
    pub relative_power: Range,
}

/// Small effects everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct ClutterRanges {
    /// How many, whole numbers: three to six.
    pub count: Range,
    /// Their size in parts of the command's rms on their joint.
    pub relative_size: Range,
}

/// Noise, encoder, clock, bus.
#[derive(Clone, Debug, PartialEq)]
pub struct BusRanges {
    /// White amplifier noise [V rms]: a good amplifier to a switching one.
    pub noise_v: Range,
    /// How often noise is coloured as well; each of these defects is met on some rigs only.
    pub coloured: f64,
    /// Coloured noise [V rms].
    pub coloured_v: Range,
    /// How long it remembers itself [s].
    pub correlation_time_s: Range,
    /// Encoder bits, whole numbers: a servo's magnet to the reference robot's.
    pub encoder_bits: Range,
    /// Sample periods [s]: 2 kHz, 1 kHz (twice as often), 500 Hz.
    pub sample_periods_s: [f64; 4],
    /// How often each defect of clock and bus is there.
    pub defect: f64,
    /// Jitter of the sampling [s rms]: a timer's interrupt to a busy processor.
    pub sampling_jitter_s: Range,
    /// Jitter of the times written [s rms].
    pub stamp_jitter_s: Range,
    /// Error of the clock's rate: a bad crystal to a scheduler's.
    pub clock_error: Range,
    /// How far the clock wanders [s].
    pub clock_wander_s: Range,
    /// In what time [s].
    pub wander_period_s: Range,
    /// Part of the rows lost.
    pub lost_part: Range,
    /// How many at once.
    pub lost_run: Range,
    /// Part of the positions that are wrong.
    pub outlier_part: Range,
    /// By how much [rad rms].
    pub outlier_rad: Range,
}

/// How far models are off.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelRanges {
    /// Relative deviation of base and friction parameters: identified to drawn up in CAD.
    pub parameters: Range,
    /// How often torque constants are off.
    pub torque_constants_off: f64,
    /// By how much: data sheets.
    pub torque_constants: Range,
    /// How often lengths are off.
    pub lengths_off: f64,
    /// By how much: a drawing that is not the part.
    pub lengths: Range,
}

/// Sizes of causes.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeRanges {
    /// The least, in parts of the smallest that shows: what nobody can see must be among them.
    pub least: f64,
    /// The most, in parts of what the plain trial draws.
    pub most: f64,
}

impl Default for Ranges {
    fn default() -> Self {
        Self {
            kinds: [
                (Kind::None, 0.15),
                (Kind::Single, 0.42),
                (Kind::Pair, 0.28),
                (Kind::Foreign, 0.15),
            ],
            foreign_in_pair: 1.0 / 7.0,
            shapes: 2.0 / 3.0,
            friction: FrictionRanges::default(),
            clutter: ClutterRanges { count: (3.0, 6.0), relative_size: (0.01, 0.05) },
            bus: BusRanges::default(),
            model: ModelRanges::default(),
            sizes: SizeRanges { least: 0.5, most: 2.0 },
        }
    }
}

impl Default for FrictionRanges {
    fn default() -> Self {
        Self {
            laws: [1.0, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0],
            width_rad_per_s: (0.01, 0.05),
            dahl_stiffness: (0.25, 2.0),
            slip_elements: (4.0, 8.0),
            slip_spread: (10.0, 100.0),
            slip_attraction_per_s: (10.0, 200.0),
            stribeck_lag_s: (0.005, 0.05),
            stribeck_factor: (2.0, 20.0),
            creep_rad_per_s: (0.005, 0.03),
            warm: 0.25,
            fall: (0.1, 0.4),
            warming_s: (10.0, 60.0),
            relative_power: (0.5, 3.0),
        }
    }
}

impl Default for BusRanges {
    fn default() -> Self {
        Self {
            noise_v: (0.002, 0.01),
            coloured: 0.4,
            coloured_v: (0.002, 0.01),
            correlation_time_s: (0.002, 0.1),
            encoder_bits: (13.0, 19.0),
            sample_periods_s: [5e-4, 1e-3, 1e-3, 2e-3],
            defect: 0.3,
            sampling_jitter_s: (2e-6, 1e-4),
            stamp_jitter_s: (5e-6, 3e-4),
            clock_error: (1e-5, 1e-3),
            clock_wander_s: (1e-5, 2e-3),
            wander_period_s: (5.0, 60.0),
            lost_part: (5e-4, 0.05),
            lost_run: (1.0, 10.0),
            outlier_part: (1e-5, 1e-3),
            outlier_rad: (1e-3, 0.3),
        }
    }
}

impl Default for ModelRanges {
    fn default() -> Self {
        Self {
            parameters: (0.02, 0.2),
            torque_constants_off: 0.3,
            torque_constants: (0.01, 0.05),
            lengths_off: 0.3,
            lengths: (0.005, 0.03),
        }
    }
}
