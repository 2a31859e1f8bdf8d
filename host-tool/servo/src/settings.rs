//! Every choice with its reason.

/// What the diagnosis of servo arms goes by.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Longest step of the simulation [s]: a servo swings at 3 to 5 Hz, so the midpoint rule errs by
    /// (2 pi 5 Hz * 5 ms)^2 / 12 = 0.2 % of its period.
    pub step_s: f64,
    /// Longest step while hypotheses are searched for [s]; the same for all that are compared. Steps of
    /// 10 ms come late by what looks like a lag of 4 ms.
    pub search_step_s: f64,
    /// Half width of the parabola that gives velocity and acceleration at a row [s]: 12 bits at
    /// 50 Hz, differentiated twice, are then worth some 0.5 rad/s^2, a hundredth of a newton metre.
    pub half_window_s: f64,
    /// What counts begins so long after the start of a stretch [s]: velocities at its first rows are known
    /// from one side, and what they are wrong by is forgotten within the time of a step.
    pub start_s: f64,
    /// Rows that are further apart than this many periods end a stretch.
    pub gap_periods: f64,
    /// Shortest stretch that is simulated [s].
    pub shortest_s: f64,
    /// Length of the blocks that weigh alike [s]: a motion there and back.
    pub block_s: f64,
    /// Blocks of which the model misses more than this many times the median rms weigh less: least
    /// squares bends to them, and a chirp beyond what any model explains is such a block.
    pub outlying_rms: f64,
    /// Errors of rows that are closer than this say the same [s].
    pub correlation_s: f64,
    /// Standard deviation of the logarithm of rotor, viscous and Coulomb friction before the logs
    /// are seen: data sheets are wrong by a factor of two or three.
    pub drive_doubt: f64,
    /// Standard deviation of gravity's scale: what drive gains and drawn links are wrong by.
    pub gravity_doubt: f64,
    /// Of both joints that contact shows in, the least error by the joint's own robust deviation.
    /// In 40 motions free of contact the second largest error of slow joints stayed below 3.
    pub contact_deviations: f64,
    /// The least of such errors, summed over joints and integrated over a contact [s]: two joints at
    /// six deviations for a second. Steps of a random binary sequence leave two of them at five for
    /// half a second, now and then.
    pub contact_deviation_seconds: f64,
    /// A joint slower than this is held [rad/s; m/s]: contact is a stall.
    pub contact_speed: f64,
    /// Shortest contact [s].
    pub contact_s: f64,
    /// What is cut before and after a contact [s]: getting in and out of it.
    pub contact_margin_s: f64,
    /// Fewest pieces of train logs that cross-validation leaves out in turn.
    pub folds: usize,
    /// Part of the squares left out that an effect must take to be added.
    pub least_gain: f64,
    /// By how many deviations, from log to log, its gain must be above zero.
    pub least_certainty: f64,
    /// Part of what is left on the confirming logs, rms, that a named cause must take.
    pub least_shrinkage: f64,
    /// The same beside an effect of the whole arm: a load that sits a little elsewhere than it was found
    /// leaves what an effect of a joint takes a tenth of.
    pub least_beside_whole: f64,
    /// There it must also take this part, rms, of what the effect of the whole arm takes of its joint: loads 1 to 2 % off
    /// left what lags and load friction that are not there took 4 to 6 % of, and friction that is there 10 % and more.
    pub least_part_of_whole: f64,
    /// The least of that in each half of the data.
    pub least_half_shrinkage: f64,
    /// A rival does the same where it takes this part of what the cause takes.
    pub rival_part: f64,
    /// It does not where the cause leaves this part less of the squares than it does,
    pub apart_part: f64,
    /// by so many deviations from log to log.
    pub apart_certainty: f64,
    /// By how much the logarithm of the likelihood must be larger: odds of twenty.
    pub apart_evidence: f64,
    /// A joint leaves hardly more than noise up to this many times what the encoder's steps leave.
    pub near_noise: f64,
    /// There, what an effect must gain, take and take in each half is this part of what it must elsewhere.
    pub least_near_noise: f64,
    /// Most effects of one joint.
    pub most_effects: usize,
    /// Length of logs, those that the model misses most, in which effects are screened [s]; a few
    /// of them are then fitted to all logs.
    pub screened_s: f64,
    /// Most effects that go on from there: the best and what may be its rivals.
    pub screened: usize,
    /// Resampled data sets for intervals.
    pub resamples: usize,
    /// Part of the squares that an effect of the whole arm must take of arms with gravity as given.
    pub least_whole_gain: f64,
    /// A payload, or a force by its weight, is at least this part of what moves: drawn links are wrong by
    /// two or three percent each, which looks like a small load.
    pub least_load_part: f64,
    /// A base leans by more than this [rad]: half a degree is no fault of mounting.
    pub least_tilt_rad: f64,
    /// Part that it must take of what a scale of gravity for each joint takes.
    pub whole_part_of_scales: f64,
    /// Up to this many times the encoder's noise a refitted model leaves no gap: positions of the
    /// other joints, read by the same encoders, enter its torques.
    pub gap_by_noise: f64,
    /// Nor up to this [rad]: friction that sticks makes a sixth of a degree a matter of chance.
    pub small_gap_rad: f64,
    /// How far from the last link's own centre a load sits that was put in its place, in parts of that
    /// centre's distance: where a joint is alone only the product of mass and distance shows, and a
    /// wider doubt lets rows place it anywhere.
    pub place_doubt: f64,
    /// The same of a load that sits elsewhere.
    pub elsewhere_doubt: f64,
    /// The same of a load that sits far from there.
    pub far_doubt: f64,
    /// Part of what is left that a place elsewhere must take for that. Pendulums with the model's own law of friction take up to 0.001, six
    /// axes with a load 10 mm beyond the centre 0.06 and more: `docs/trial-history.md`.
    pub least_elsewhere_gain: f64,
    /// The same where a joint is alone. There a load's distance shows by its inertia only, and the rotor is fitted
    /// too: a wrong place, two fifths too near and with two thirds too much mass, took a tenth or more.
    pub least_elsewhere_gain_alone: f64,
    /// Length of logs in which effects of the whole arm are searched for [s].
    pub whole_arm_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step_s: 5e-3,
            search_step_s: 5e-3,
            half_window_s: 0.1,
            start_s: 0.3,
            gap_periods: 5.0,
            shortest_s: 2.0,
            block_s: 4.0,
            outlying_rms: 5.0,
            correlation_s: 0.5,
            drive_doubt: 1.0,
            gravity_doubt: 0.2,
            contact_deviations: 4.0,
            contact_deviation_seconds: 12.0,
            contact_speed: 0.1,
            contact_s: 0.5,
            contact_margin_s: 0.5,
            folds: 6,
            least_gain: 0.04,
            least_certainty: 2.0,
            least_shrinkage: 0.07,
            least_beside_whole: 0.2,
            least_part_of_whole: 0.08,
            least_half_shrinkage: 0.03,
            rival_part: 0.9,
            apart_part: 0.33,
            apart_certainty: 2.0,
            apart_evidence: 3.0,
            near_noise: 2.0,
            least_near_noise: 0.4,
            most_effects: 3,
            screened_s: 700.0,
            screened: 6,
            resamples: 500,
            least_whole_gain: 0.1,
            least_load_part: 0.03,
            least_tilt_rad: 8e-3,
            whole_part_of_scales: 0.95,
            gap_by_noise: 5.0,
            small_gap_rad: 3e-3,
            place_doubt: 0.01,
            elsewhere_doubt: 0.3,
            far_doubt: 10.0,
            least_elsewhere_gain: 0.02,
            least_elsewhere_gain_alone: 0.5,
            whole_arm_s: 200.0,
        }
    }
}

impl Settings {
    /// The part of what is left that a place elsewhere must take, by the number of joints.
    pub fn least_elsewhere(&self, joints: usize) -> f64 {
        if joints > 1 { self.least_elsewhere_gain } else { self.least_elsewhere_gain_alone }
    }

    /// Those for effects of joints beside one of the whole arm.
    pub fn beside_whole(&self) -> Self {
        Self { least_shrinkage: self.least_beside_whole, least_near_noise: 1.0, ..self.clone() }
    }
}
