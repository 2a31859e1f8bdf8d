//! What the logs leave open of the amended model.

use nalgebra::DMatrix;

use crate::fit::linearisation::Linearisation;
use crate::fit::unknowns::Unknown;
use crate::logs::subject::Subject;
use crate::model_file::ModelFile;
use crate::trial::hypothesis::Hypothesis;

/// The amended model with the covariance of all that was fitted, from which
/// [`samples`](crate::report::samples) draws models.
///
/// Normal about the fit, by its curvature, rows weighted by what the model leaves of them and what
/// was known beforehand included. Effects are those of the amended model in every draw; their harmonics
/// are whole and stay.
#[derive(Clone, Debug)]
pub struct Posterior {
    pub(crate) subject: Subject,
    pub(crate) file: ModelFile,
    pub(crate) hypothesis: Hypothesis,
    pub(crate) unknowns: Vec<Unknown>,
    /// Lower factor of the inverse of the covariance.
    pub(crate) factor: DMatrix<f64>,
}

impl Posterior {
    /// Of a fitted model, and the file that was diagnosed.
    pub fn of(subject: &Subject, file: &ModelFile, fitted: &Linearisation) -> Self {
        Self {
            subject: subject.clone(),
            file: file.clone(),
            hypothesis: fitted.hypothesis.clone(),
            unknowns: fitted.expected.iter().map(|expected| expected.unknown).collect(),
            factor: fitted.factor(),
        }
    }
}
