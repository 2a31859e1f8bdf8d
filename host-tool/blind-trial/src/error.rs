//! Why a blind trial ends early.

use diagnosis::SubjectError;
use files::FileError;
use recordings::StepError;
use rig::effects::EffectError;
use rig::plant::PlantError;
use servo::ServoError;
use simulation::board::BoardError;

/// Why a blind trial ends early.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
    /// The board refuses a model that was drawn.
    #[error(transparent)]
    Board(#[from] BoardError),
    /// An effect that was drawn cannot be built.
    #[error(transparent)]
    Effect(#[from] EffectError),
    /// A file that cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Logs that cannot be used.
    #[error(transparent)]
    Step(#[from] StepError),
    /// Logs or an arm that the diagnosis cannot use.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// An arm of position servos that cannot be simulated.
    #[error(transparent)]
    Servo(#[from] ServoError),
    /// An arm that describes no plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// No draw of a case was fit for use.
    #[error("case {case}: {tries} draws of {what} gave nothing that is detectable and stable")]
    NothingDetectable {
        /// The case.
        case: u32,
        /// How often was drawn.
        tries: u32,
        /// What was drawn.
        what: String,
    },
    /// A case of the plain trial where one of the diverse trial is needed.
    #[error("case {0} is of the plain trial and has no reality of its own")]
    NoReality(u32),
    /// A data set that cannot be recorded by name.
    #[error("there is no recipe for the data set {0}")]
    NoRecipe(&'static str),
    /// What was identified is no robot.
    #[error("robot {case} was identified as what no robot can be: {what}")]
    NoModel {
        /// The robot.
        case: u32,
        /// What is wrong.
        what: String,
    },
    /// A name that is neither in the catalogue nor among the foreign effects.
    #[error("{0} is no effect, neither of the catalogue nor foreign to it")]
    UnknownEffect(String),
    /// What was sealed is not what comes out.
    #[error("the truth has changed since it was sealed: SHA-256 was {sealed}, is {opened}")]
    Seal {
        /// The hash of the sealed truth.
        sealed: String,
        /// The hash of what came out.
        opened: String,
    },
}
