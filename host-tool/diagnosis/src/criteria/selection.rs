//! Thresholds of what is added to the model.

use super::table::criteria;

criteria! {
    /// Which candidates are added to the model, and when that ends.
    SelectionCriteria {
        /// Most effects that are added.
        most_effects: usize = 10,
        /// Most candidates that are refitted at a time.
        finalists: usize = 6,
        /// How often the next ones are refitted where none of those before is accepted.
        batches: usize = 2,
        /// A candidate is refitted together with the best if it gains this part of what that gains.
        finalist_gain: f64 = 0.3,
        /// Most Gauss-Newton steps of a finalist's fit.
        finalist_steps: usize = 3,
        /// The same for the one that is accepted.
        accepted_steps: usize = 4,
        /// The same where that is a spring, whose values are far from linear.
        accepted_spring_steps: usize = 10,
        /// Folds of the cross-validation: each is fitted without, and then judged by what it leaves.
        folds: usize = 5,
        /// Length of the pieces of logs that go to one fold after the other [s].
        piece_s: f64 = 2.0,
        /// Log-likelihood that an effect must gain on what was left out, parameters' prior included:
        /// some 800 candidates, harmonics among them, gain half the logarithm of their number by
        /// chance, and what is left is not Gaussian.
        least_log_likelihood: f64 = 15.0,
        /// Once causes leave all logs near their noise, one more must gain so many times that: what lasts below the noise
        /// is told by thousands of rows.
        sure_gain: f64 = 4.0,
        /// Orders at which waves are likely: each is so many times less likely beforehand than an effect
        /// that is tried once.
        likely_orders: f64 = 24.0,
        /// Part of what is left above the noise of the joints it acts on that an effect must take
        /// away: less may be the method's own,
        least_of_excess: f64 = 0.08,
        /// or this part of what is left of one log, where other causes leave more of others,
        least_of_log_excess: f64 = 0.3,
        /// unless it takes away this part of the prior penalty,
        least_of_prior_penalty: f64 = 0.2,
        /// or is a wave of voltage of which a log holds so many periods, which a smooth curve over the angle does not make, and
        /// gains `sure_gain` times what an effect must: a cogging of 2.6 mV took most of what one log left above its noise,
        /// and little of what the others left around reversals.
        least_periods_of_sure_wave: f64 = 2.0,
        /// A spring between motor and link takes this part of what is left of its joint, or of all: one that takes
        /// less smooths something else, and hides it.
        least_by_spring: f64 = 0.6,
        /// An effect is refused if it makes parameters implausible and their prior penalty so many
        /// times larger,
        most_prior_penalty_growth: f64 = 1.2,
        /// unless it becomes less than so many times what is plausible, or what it was where that was more,
        most_growth_of_implausible: f64 = 2.0,
        /// and the log-likelihood that parameters lose is less than this part of what the effect gains.
        most_penalty_of_gain: f64 = 0.05,
        /// An effect is refused if it leaves less than this part of what encoder steps alone leave,
        /// for it takes noise for motion,
        least_of_encoder_noise: f64 = 0.7,
        /// where there was less than so many times that before.
        near_encoder_noise: f64 = 2.0,
        /// The search ends where no log is left with more than so many times the noise,
        done_ratio: f64 = 3.0,
        /// and this part of the refitted model's excess: effects that are not linear are not removed
        /// to the last.
        done_part: f64 = 5e-4,
        /// A fit of few steps that leaves more than this part of the excess, four times as much, does not come below
        /// that at its end,
        may_be_done_part: f64 = 2e-3,
        /// but a spring's, which is far from linear, may from here.
        may_be_done_by_spring: f64 = 0.5,
        /// Where no effect pays and a log is left with so many times the noise, that is taken to be systematic.
        systematic_ratio: f64 = 2.0,
        /// The fit without an effect has ended in a local minimum where it leaves so many times the squares of the effect's
        /// joint that the model without any effect leaves. It was twice as much where friction by load was named for that.
        local_minimum_ratio: f64 = 1.5,
        /// An effect that takes away less than this part of what a table over some axis of its joint
        /// does is not the cause,
        least_of_ceiling: f64 = 0.9,
        /// unless beside that table it still takes this part of what is left.
        least_beside_table: f64 = 0.15,
        /// A lag or a delay is not the cause either where a tone, one frequency in all train logs with an amplitude and a
        /// phase for each piece of this length [s], takes so much: a supply's frequency wanders by less than an eighth of a
        /// hertz,
        tone_piece_s: f64 = 8.0,
        /// and more than this part of what is left, and of what the lag takes, lies at that frequency,
        most_at_tone: f64 = 0.5,
        /// which has so many times the squares that 98 % of frequencies stay below. One frequency of noise alone has in one
        /// of 780 000 (exp(-4 ln 25 - ln 2), of one piece), the strongest of 10 000 in one of 78.
        tone_above_others: f64 = 4.0,
        /// Most steps of a fit with a table.
        table_steps: usize = 2,
        /// Most tables of a joint in the amended model.
        tables_of_joint: usize = 2,
        /// Part of what is left above the noise of its joint that a table must take away.
        least_of_table: f64 = 0.25,
        /// Rivals of a cause that are tried in its place once all causes are found.
        rivals: usize = 3,
        /// An effect whose size is this close to a bound, in parts of that, is refused: the search wanted
        /// on.
        near_bound: f64 = 0.005,
        /// An angle at which an effect rests lies no further from the motion [rad]: half a turn, beyond
        /// which a spring is an offset by another name.
        far_rest_rad: f64 = 3.2,
        /// No joint warms faster than with this time constant [s].
        least_warming_s: f64 = 0.5,
        /// A dead zone is told from Coulomb friction by samples of a moving joint whose command brakes it: by this part of
        /// them at least. Where friction is nearly all of the command there are a few thousandths, else more than 0.06.
        least_braked: f64 = 0.01,
        /// A joint turns round within so many seconds, its friction and what makes up for that in its command with it: logs
        /// whose samples lie further apart do not tell of a lag shorter than one [s].
        turns_round_s: f64 = 0.004,
        /// A spring leaves its motor this part of the joint's inertia, or it only smooths what the
        /// encoder reads.
        least_motor_inertia: f64 = 0.02,
        /// A rival takes this part of what an effect takes on its joint: what explains something else is
        /// no rival, but another cause.
        least_as_rival: f64 = 0.5,
        /// Most damping ratio of a link on its spring, the motor held: one that does not ring, and
        /// overshoots by less than a third, only smooths. Drives have some hundredths.
        most_damping_ratio: f64 = 0.35,
        /// Backlash is wider than the deflection of its spring under this part of the largest torque.
        least_gap: f64 = 0.02,
    }
}
