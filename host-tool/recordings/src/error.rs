//! Why recorded experiments cannot be used.

/// Why a step has no result; the message names the cure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepError {
    /// No log of this experiment.
    #[error("{step}: no log of {experiment} is there; record that experiment")]
    NoLog {
        /// The step that needs it.
        step: &'static str,
        /// The experiment, with its joint where it has one.
        experiment: String,
    },
    /// A log that does not hold what the step needs.
    #[error("{file}: {what}")]
    Unusable {
        /// The log.
        file: String,
        /// What is wrong with it, and what to do.
        what: String,
    },
    /// The numbers did not work out.
    #[error("{step}: {what}")]
    Numerical {
        /// The step.
        step: &'static str,
        /// What happened.
        what: String,
    },
}
