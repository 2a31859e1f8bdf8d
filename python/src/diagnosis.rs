//! A diagnosis for Python.

use std::path::{Path, PathBuf};

use diagnosis::report::samples::SAMPLES;
use diagnosis::{Criteria, Diagnosis, ModelFile, Posterior, Report};
use host_tool::commands::{diagnose as of_commands, diagnose_servos as of_motion};
use host_tool::failure::Failure;
use pyo3::prelude::*;
use report::Page;
use report::diagnosis_page::diagnosis_page;
use report::servo_page::servo_page;
use servo::report_words;

use crate::failure::{Error, exception, file_exception};
use crate::model::Model;
use crate::work;

/// Names of parameters, their values, sample by sample, and the models.
type Samples = (Vec<String>, Vec<Vec<f64>>, Vec<Model>);

/// What a diagnosis found, with the page and the model that it makes.
#[pyclass(frozen, module = "rrr._rrr")]
pub struct Diagnosed {
    report: Report,
    words: String,
    page: Page,
    model: ModelFile,
    posterior: Option<Posterior>,
}

impl Diagnosed {
    fn of_commands(diagnosis: &Diagnosis) -> Self {
        Self {
            report: diagnosis.report.clone(),
            words: of_commands::in_words(diagnosis),
            page: diagnosis_page(diagnosis),
            model: diagnosis.model.clone(),
            posterior: diagnosis.posterior.clone(),
        }
    }

    fn of_motion(outcome: &servo::Outcome, report: Report) -> Self {
        let words = report_words::in_words(&report);
        let page = servo_page(outcome, &report);
        let model = ModelFile::Arm(Box::new(servo::model_file::model_file(outcome)));
        Self { report, words, page, model, posterior: None }
    }
}

#[pymethods]
impl Diagnosed {
    /// `report.json`'s text.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.report).map_err(|error| Error::new_err(error.to_string()))
    }

    /// The verdict, the causes and the remarks, as the command line prints them.
    fn words(&self) -> &str {
        &self.words
    }

    /// `report.html`'s text: a page that needs no other file.
    fn html(&self) -> String {
        self.page.to_html()
    }

    /// The text of the amended model.
    fn model_toml(&self) -> PyResult<String> {
        self.model.to_toml().map_err(|problem| Error::new_err(problem.to_string()))
    }

    /// Models drawn from what the logs leave open: names of parameters, their values, sample by
    /// sample, and the models.
    fn samples(&self, count: usize, seed: u64) -> PyResult<Samples> {
        let posterior = self.posterior.as_ref().ok_or_else(|| {
            Error::new_err(
                "a diagnosis on motion keeps no covariance: no models can be drawn of it",
            )
        })?;
        let samples = posterior.samples(count, seed);
        let values = samples.iter().map(|sample| sample.values.clone()).collect();
        let models = samples.into_iter().map(|sample| Model::of(sample.model)).collect();
        Ok((posterior.names(), values, models))
    }

    /// Writes report.json, report.html, model.toml and samples.csv, as `rrr diagnose` does, into a directory.
    fn write(&self, directory: PathBuf) -> PyResult<()> {
        host_tool::output_files::create_directory(&directory).map_err(|e| exception(&e))?;
        self.model.write(directory.join(of_commands::MODEL)).map_err(file_exception)?;
        if let Some(posterior) = &self.posterior {
            let table = posterior.table(SAMPLES, 1);
            let path = directory.join(of_commands::TABLE);
            host_tool::output_files::write_text(&table, &path).map_err(|e| exception(&e))?;
        }
        self.page.write(&directory.join(of_commands::PAGE)).map_err(file_exception)?;
        let path = directory.join(of_commands::REPORT);
        let json = host_tool::output_files::json(&self.report, &path);
        let written =
            json.and_then(|text| host_tool::output_files::write_text(&(text + "\n"), &path));
        written.map_err(|failure| exception(&failure))
    }
}

/// Diagnoses the data set in a directory by a model file; thresholds and the doubt about the model's
/// parameters as `rrr diagnose` takes them.
#[pyfunction]
#[pyo3(signature = (dataset, model, criteria=None, model_doubt=None, progress=None))]
pub fn diagnose(
    py: Python<'_>,
    dataset: PathBuf,
    model: PathBuf,
    criteria: Option<PathBuf>,
    model_doubt: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Diagnosed> {
    let criteria = chosen(criteria.as_deref(), model_doubt)?;
    work::run(py, progress, move |steps| judged(&dataset, &model, &criteria, steps))
}

fn chosen(path: Option<&Path>, model_doubt: Option<f64>) -> PyResult<Criteria> {
    let criteria = path.map(Criteria::read).transpose().map_err(file_exception)?;
    let mut criteria = criteria.unwrap_or_default();
    match model_doubt {
        Some(doubt) if !(doubt > 0.0 && doubt <= 1.0) => Err(Error::new_err(format!(
            "model_doubt is {doubt}, but must be a part of the parameters above 0, at most 1: 0.2 for 20 %"
        ))),
        Some(doubt) => {
            criteria.prior.hold_at(doubt);
            Ok(criteria)
        }
        None => Ok(criteria),
    }
}

fn judged(
    dataset: &Path,
    model: &Path,
    criteria: &Criteria,
    progress: &dyn Fn(&str),
) -> Result<Diagnosed, Failure> {
    if of_motion::is_judged_on_motion(model) {
        let (outcome, report) = of_motion::judge(dataset, model, progress)?;
        return Ok(Diagnosed::of_motion(&outcome, report));
    }
    let diagnosis = of_commands::judge(dataset, model, criteria, progress)?;
    progress("drawing the pictures");
    Ok(Diagnosed::of_commands(&diagnosis))
}

/// All thresholds with their meaning and default, as `criteria` takes them.
#[pyfunction]
pub fn default_criteria() -> String {
    Criteria::default().to_toml()
}
