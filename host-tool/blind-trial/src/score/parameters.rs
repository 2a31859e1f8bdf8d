//! Errors of the parameters of causes that are rightly named.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::Share;
use super::median::median;
use crate::cause::TrueCause;
use crate::outcome::Outcome;
use diagnosis::{Cause, Value};

/// An error within this counts as small: in parts of the truth, or rad for angles.
const SMALL: f64 = 0.1;

/// The error of one parameter, or of a vector of some.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterError {
    /// The parameter's name.
    pub parameter: &'static str,
    /// In parts of the truth; in rad for angles that have no natural size.
    pub error: f64,
    /// Whether it is in rad.
    pub in_rad: bool,
}

/// Errors of one parameter over all cases.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterScore {
    /// The effect.
    pub effect: String,
    /// The parameter.
    pub parameter: String,
    /// Whether errors are in rad instead of parts of the truth.
    pub in_rad: bool,
    /// The middle error.
    pub median_error: Option<f64>,
    /// Errors within 10 %, or 0.1 rad.
    pub small: Share,
}

/// Every parameter of every cause that is rightly named.
pub(super) fn scores(outcomes: &[Outcome]) -> Vec<ParameterScore> {
    let mut all: BTreeMap<(String, &'static str), Vec<ParameterError>> = BTreeMap::new();
    for outcome in outcomes {
        for named in outcome.answer.named() {
            let truth = outcome.truth.iter().find(|truth| truth.is(named));
            for error in truth.map(|truth| errors(truth, named)).unwrap_or_default() {
                all.entry((named.effect.clone(), error.parameter)).or_default().push(error);
            }
        }
    }
    let score = |((effect, parameter), errors): ((String, &'static str), Vec<ParameterError>)| {
        ParameterScore {
            effect,
            parameter: parameter.to_owned(),
            in_rad: errors.first().is_some_and(|error| error.in_rad),
            small: errors.iter().fold(Share::default(), |s, e| s.with(e.error <= SMALL)),
            median_error: median(errors.iter().map(|error| error.error).collect()),
        }
    };
    all.into_iter().map(score).collect()
}

/// Errors of a cause's parameters. A phase counts modulo a turn, and only where the
/// harmonic is right; the two tilts count as one vector.
pub fn errors(truth: &TrueCause, named: &Cause) -> Vec<ParameterError> {
    if truth.effect == "base_tilt" {
        let names = ["tilt_x_rad", "tilt_y_rad"];
        let [truth, found] = [&truth.parameters, &named.parameters].map(|parameters| {
            names.iter().flat_map(|name| components(parameters.get(*name))).collect::<Vec<f64>>()
        });
        return vec![relative("tilt", &truth, &found)];
    }
    let definition = rig::effects::Definition::by_name(&truth.effect);
    let mut names: Vec<&'static str> =
        definition.map_or(&[][..], |d| d.parameters).iter().map(|p| p.name).collect();
    names.dedup();
    if !same_harmonic(truth, named) {
        names.retain(|name| *name != "phase_rad");
    }
    let one = |name: &'static str| {
        let value = |parameters: &BTreeMap<String, Value>| components(parameters.get(name));
        let (truth, found) = (value(&truth.parameters), value(&named.parameters));
        match name {
            "phase_rad" => angle(name, &truth, &found, |gap| (gap + PI).rem_euclid(TAU) - PI),
            "rest_rad" => angle(name, &truth, &found, |gap| gap),
            _ => relative(name, &truth, &found),
        }
    };
    names.into_iter().map(one).collect()
}

fn same_harmonic(truth: &TrueCause, named: &Cause) -> bool {
    let harmonic = |parameters: &BTreeMap<String, Value>| components(parameters.get("harmonic"));
    let (truth, found) = (harmonic(&truth.parameters), harmonic(&named.parameters));
    match (truth.first(), found.first()) {
        (None, _) => true,
        (Some(truth), Some(found)) => (truth - found).abs() < 0.5,
        (Some(_), None) => false,
    }
}

fn components(value: Option<&Value>) -> Vec<f64> {
    match value {
        Some(Value::Number(number)) => vec![*number],
        Some(Value::Vector(vector)) => vector.clone(),
        None => Vec::new(),
    }
}

/// |found - truth| / |truth|; infinite where the parameter is missing.
fn relative(parameter: &'static str, truth: &[f64], found: &[f64]) -> ParameterError {
    let norm = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>().sqrt();
    let gap: Vec<f64> = truth.iter().zip(found).map(|(truth, found)| found - truth).collect();
    let missing = truth.len() != found.len();
    let error = if missing { f64::INFINITY } else { norm(&gap) / norm(truth).max(1e-12) };
    ParameterError { parameter, error, in_rad: false }
}

fn angle(
    parameter: &'static str,
    truth: &[f64],
    found: &[f64],
    wrapped: impl Fn(f64) -> f64,
) -> ParameterError {
    let error = match (truth, found) {
        ([truth], [found]) => wrapped(found - truth).abs(),
        _ => f64::INFINITY,
    };
    ParameterError { parameter, error, in_rad: true }
}
