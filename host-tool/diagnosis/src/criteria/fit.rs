//! Thresholds of the prior and of fits.

use super::table::criteria;

criteria! {
    /// What is known of the model beforehand: standard deviations of the true parameters about
    /// those of the model as given, and bounds.
    PriorCriteria {
        /// Deviation of a mass, an inertia or what follows from them in parts of it: identification leaves two to
        /// three per cent.
        relative: f64 = 0.025,
        /// The same of friction's parameters.
        relative_friction: f64 = 0.025,
        /// The most that these may become where logs show a model that is further off.
        widest: f64 = 0.3,
        /// Logs show that where a typical parameter, once all are nearly free, is off by more than so many deviations,
        least_typical: f64 = 1.5,
        /// and either so much log-likelihood is gained by that beyond what causes gain,
        least_gain: f64 = 50.0,
        /// or a wider doubt makes the logs likelier by so much, in logarithms, whatever the parameters are: a factor of
        /// twenty thousand. The doubt then becomes the one by which the logs are most likely,
        least_doubt_likelihood: f64 = 10.0,
        /// or one of masses and another of friction where these are likelier by so much log-likelihood, a factor of
        /// twenty;
        least_gain_apart: f64 = 3.0,
        /// that about masses is no wider than this times what a typical one is off by, of those that the logs tell,
        told_deviations: f64 = 1.5,
        /// where they tell so many;
        fewest_told: usize = 5,
        /// where a log is left with more than so many times the noise, effects are searched for with
        /// parameters all but free first: held far from the truth, they hide a cause.
        much_left: f64 = 6.0,
        /// Added for base parameters, in parts of the largest of their kind.
        of_largest: f64 = 0.004,
        /// Added for friction parameters, in parts of themselves.
        friction: f64 = 0.005,
        /// Added for the Stribeck level, in parts of Coulomb friction.
        stribeck_level: f64 = 0.02,
        /// Least added for viscous friction, in parts of Coulomb friction per rad/s: identification
        /// gives zero where it is small.
        viscous: f64 = 0.002,
        /// Least added for the bristles' damping, in parts of their stiffness.
        damping: f64 = 1e-5,
        /// The same where the model does not tell the bristles.
        unknown_damping: f64 = 0.02,
        /// Deviation of the instants of commands, in sample periods.
        lag_periods: f64 = 0.05,
        /// Deviation of a joint's lag about the other joints', in parts of the usual one, where an effect makes its command
        /// late: the two are one thing to the logs.
        lag_beside_lateness: f64 = 0.1,
        /// Deviation of dry friction's lead over velocity: soft constraints lead by some 10 ms, frictional
        /// memory lags by a few [s].
        friction_lead_s: f64 = 0.01,
        /// Deviation of the part of a motor's torque that gears take, the same on all joints of an arm of three and more:
        /// good ones take some hundredths.
        gear_loss: f64 = 0.04,
        /// The most that they take of it.
        most_gear_loss: f64 = 0.5,
        /// Deviation of a motor's torque constant in parts of it, where several are told against each other: magnets and
        /// amplifiers keep to what their sheets say within 5 to 10 %.
        torque_constant: f64 = 0.05,
        /// Deviation of what friction has more of in a log, in parts of itself, where logs ask for it: grease that warms
        /// takes a tenth to a third of it.
        warmth: f64 = 0.15,
        /// They do where more than half of the joints are likelier by so much so, in logarithms: half of what an effect must
        /// gain.
        least_warmth_likelihood: f64 = 7.5,
        /// Added for what shapes friction near standstill, the Stribeck velocity and the bristles, in
        /// parts of themselves: no machine's friction is of anybody's formula there.
        friction_shape: f64 = 3.0,
        /// The same for the Stribeck level, in parts of Coulomb friction.
        friction_shape_level: f64 = 1.0,
        /// Deviation of a table's values: so wide that it only keeps what the logs do not tell [V].
        table_v: f64 = 0.3,
        /// Least Coulomb friction of a fit, in parts of that given.
        least_coulomb: f64 = 0.02,
        /// Most by which Stribeck friction may be below Coulomb friction, in parts of the latter.
        most_stribeck_drop: f64 = 0.95,
        /// Least Stribeck velocity of a fit, in parts of that given.
        least_stribeck_velocity: f64 = 0.2,
        /// Least stiffness of bristles of a fit, in parts of that given.
        least_bristle_stiffness: f64 = 0.1,
    }
}

criteria! {
    /// Fits, and how they are judged.
    FitCriteria {
        /// Most Gauss-Newton steps of the first fit, which only serves to see the noise.
        first_steps: usize = 2,
        /// Most steps of the refit of the model as given.
        refit_steps: usize = 6,
        /// Most steps once rows are weighted by what the fit leaves of them.
        reweighted_steps: usize = 3,
        /// How often at most rows are weighted anew by what the refitted model leaves of them,
        most_reweightings: usize = 5,
        /// with so many steps each, slopes of their own,
        settling_steps: usize = 3,
        /// until that changes its log-likelihood by no more than this, a third of what an effect must
        /// gain.
        settled_log_likelihood: f64 = 5.0,
        /// A step that takes a smaller part off the objective ends a fit.
        converged_part: f64 = 2e-4,
        /// A step that promises to lower the objective by less is not tried: a hundredth of the
        /// evidence that an effect needs.
        least_step_gain: f64 = 0.3,
        /// A refit that is reported stays within so many prior deviations of the model as given.
        within_deviations: f64 = 3.0,
        /// Rounds in which parameters at these bounds are fixed and the others refitted.
        bound_rounds: usize = 3,
        /// Rms up to so many times the noise is the method's own: friction around reversals, where
        /// velocity is hardest to know, reaches it on one joint of one log of a robot without effect.
        own_ratio: f64 = 1.5,
        /// Prior penalty, in squared deviations, up to which a fault of the model need not explain it: some thirty
        /// parameters that are known to their deviation make thirty.
        unexplained_prior_penalty: f64 = 60.0,
        /// Parameters ask for a cause where their penalty is so many standard deviations above its mean.
        unexplained_deviations: f64 = 4.0,
        /// Prior penalty beyond which a model is no longer the one given: parameters some ten
        /// deviations off, a quarter of their values.
        implausible_prior_penalty: f64 = 240.0,
        /// Where the logs tell more than so many parameters it grows with their number: each may be off by a little.
        told_parameters: f64 = 30.0,
        /// What one parameter adds to that penalty at most: a third of it.
        most_penalty_of_one: f64 = 80.0,
        /// Torque on a link behind backlash that no model tells, in parts of the noise of the
        /// measured torque. More lets fewer errors of a bounce grow, but hides more of whatever slow
        /// torque a model lacks: about 1 - 1/sqrt(1 + part^2) of it, up to a quarter behind a
        /// very stiff spring.
        unknown_link_torque: f64 = 0.5,
        /// The same behind a spring without play, where no error grows by a bounce: what the encoder's
        /// steps put through the spring, without which a link that is heavy and hardly damped swings
        /// with them.
        unknown_spring_torque: f64 = 0.03,
        /// The same in parts of what the encoder's steps push through a spring, k s, over what they make of the motor's
        /// acceleration, J_m s / T^2, where that is more, and no more than behind backlash: a stiff spring, else, carries
        /// so much of those steps to a calm joint that a refit damps it three times too much. The noise of that
        /// acceleration is 2.4 times as large, and one third of that ratio hides less of slow torques.
        spring_torque_of_steps: f64 = 0.13,
    }
}
