//! What can be chosen in the identification of an arm.

/// Choices, each with the reason for its default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Highest cut-off of the low-pass that positions and commands pass [Hz]. Above lie the
    /// first resonances of arms, which rigid links do not have.
    pub highest_cutoff_hz: f64,
    /// The same in parts of the sampling frequency: there the derivative formulas are still
    /// right to one in a thousand.
    pub cutoff_by_rate: f64,
    /// Lowest cut-off [Hz]: arms move at this frequency and below.
    pub lowest_cutoff_hz: f64,
    /// Most noise in the acceleration, in parts of the acceleration itself, of a joint that
    /// moves: least squares shrink what they find by the square of it, here 1 %, before the second
    /// low-pass leaves a thirtieth of that.
    pub acceleration_noise: f64,
    /// Cut-off of the second low-pass, which regressor and command pass alike, in parts of the
    /// first: the first then takes 0.4 % at its edge.
    pub second_cutoff: f64,
    /// What is cut off either end of a stretch, in periods of the second cut-off.
    pub edge: f64,
    /// Rows per period of the second cut-off: hardly more than are independent.
    pub rows_per_period: f64,
    /// Shortest stretch that is used, in periods of the second cut-off, its edges included.
    pub shortest: f64,
    /// Longest step of time within a stretch, in sampling periods: a lost sample or two
    /// is interpolated.
    pub longest_gap: f64,
    /// A joint stands below this part of its rms velocity: its friction may then be anything
    /// up to its level.
    pub standstill: f64,
    /// And below so many standard deviations of the velocity's noise.
    pub standstill_noise: f64,
    /// Fewest rows of a joint: four times as many as a link has parameters.
    pub fewest_rows: usize,
    /// Doubt of a link's given value without a standard error, in parts of it, a centre of mass in
    /// parts of the link's size: drawings without cables and screws are about so wrong.
    pub doubt_of_link: f64,
    /// The same of friction, which changes with temperature and age.
    pub doubt_of_friction: f64,
    /// Passes of weighting: each joint's weight has settled after three.
    pub weighting_passes: usize,
    /// An unknown rotor whose logarithm has a smaller standard error than this is beyond doubt.
    pub rotor_doubt: f64,
    /// Any other unknown rotor is written only where the fit without it is worse by this many squared
    /// standard deviations: three of them.
    pub rotor_evidence: f64,
    /// Friction has a term beyond Coulomb's and viscous friction where this many standard errors say so: what friction of
    /// another law leaves is no noise, and three would not do.
    pub term_errors: f64,
    /// A constant where this many say so: gravity over a part of a turn looks like one, and what friction of another law
    /// leaves comes to five.
    pub constant_errors: f64,
    /// And where it takes this part of the squares that are left without: less is of no use to anybody.
    pub term_part: f64,
    /// Widths of the Stribeck peak that are tried, in parts of a joint's largest velocity, up to where viscous friction is
    /// as good; those below the slowest rows are passed over.
    pub stribeck_velocities: [f64; 6],
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            highest_cutoff_hz: 40.0,
            cutoff_by_rate: 0.15,
            lowest_cutoff_hz: 1.0,
            acceleration_noise: 0.1,
            second_cutoff: 0.5,
            edge: 1.5,
            rows_per_period: 2.5,
            shortest: 6.0,
            longest_gap: 3.5,
            standstill: 0.2,
            standstill_noise: 4.0,
            fewest_rows: 44,
            doubt_of_link: 0.2,
            doubt_of_friction: 1.0,
            weighting_passes: 5,
            rotor_doubt: 0.05,
            rotor_evidence: 9.0,
            term_errors: 5.0,
            constant_errors: 10.0,
            term_part: 0.05,
            stribeck_velocities: [0.01, 0.02, 0.04, 0.08, 0.16, 0.32],
        }
    }
}
