//! Where the search for an effect's parameters begins.

use std::f64::consts::TAU;

/// How the parameters of an effect are searched for.
#[derive(Clone, Copy, Debug)]
pub enum Search {
    /// From these values, one list per start; none of them is zero where the parameter's
    /// size is not known, because steps are taken in parts of it.
    From(fn(&Typical) -> Vec<Vec<f64>>),
    /// An amplitude, a harmonic per turn and a phase: every harmonic is tried.
    Harmonics(Carrier),
}

/// What a harmonic of the angle multiplies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// Nothing: a voltage of its own.
    Unity,
    /// The command.
    Command,
    /// The level of friction, against the motion.
    Friction,
}

/// What is typical of the joint whose effect is searched for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Typical {
    /// Largest command [V].
    pub command_v: f64,
    /// Coulomb friction [V].
    pub friction_v: f64,
    /// Load c + h, rms, of the joint that bears most where an effect acts on the whole robot [Nm].
    pub load_nm: f64,
    /// Torque that the motor makes of the largest command [Nm].
    pub motor_nm: f64,
    /// Highest speed [rad/s].
    pub speed_rad_per_s: f64,
    /// Mean angle [rad].
    pub position_rad: f64,
    /// Inertia that the motor feels [kg m^2].
    pub inertia_kg_m2: f64,
    /// Lowest and highest place of the tip in the base frame [m]; zeros for what acts on one joint.
    pub tip_height_m: [f64; 2],
}

impl Typical {
    /// Stiffness, damping and motor inertia of a lightly damped spring, by its resonance
    /// with the motor held and the motor's part of the joint's inertia.
    pub fn spring(&self, resonance_hz: f64, motor_part: f64) -> [f64; 3] {
        const DAMPING_RATIO: f64 = 0.05;
        let link = (1.0 - motor_part) * self.inertia_kg_m2;
        let frequency = TAU * resonance_hz;
        let damping = 2.0 * DAMPING_RATIO * frequency * link;
        [link * frequency * frequency, damping, motor_part * self.inertia_kg_m2]
    }
}

/// How the first parameter of an effect tells its size.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Whether a larger value is more of the effect.
    pub grows: bool,
    /// The value from which on seeing the effect is no news.
    pub useless: fn(&Typical) -> f64,
}

impl Size {
    /// A larger value is more of the effect.
    pub const fn grows(useless: fn(&Typical) -> f64) -> Self {
        Self { grows: true, useless }
    }

    /// A larger value is less of the effect, as with a stiffness or a limit.
    pub const fn shrinks(useless: fn(&Typical) -> f64) -> Self {
        Self { grows: false, useless }
    }
}
