//! Errors of the parameters of causes that are rightly named.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::Share;
use super::median::median;
use crate::cause::TrueCause;
use crate::outcome::Outcome;
use diagnosis::{Cause, Value};
use rig::effects::{Kind, Parameter};

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
/// harmonic is right; the components of a rotation count as one vector, and alone.
pub fn errors(truth: &TrueCause, named: &Cause) -> Vec<ParameterError> {
    let parameters = truth.known_parameters();
    let rotation = parameters.iter().filter(|parameter| parameter.kind == Kind::Rotation);
    let rotation: Vec<&str> = rotation.map(|parameter| parameter.name).collect();
    if !rotation.is_empty() {
        let [truth, found] = [&truth.parameters, &named.parameters].map(|parameters| {
            rotation.iter().flat_map(|name| components(parameters.get(*name))).collect::<Vec<f64>>()
        });
        return vec![relative("tilt", &truth, &found)];
    }
    let one = |Parameter { name, kind, .. }: &Parameter| {
        let [truth, found] = values(truth, named, name);
        match kind {
            Kind::Phase => angle(name, &truth, &found, |gap| (gap + PI).rem_euclid(TAU) - PI),
            Kind::Angle => angle(name, &truth, &found, |gap| gap),
            _ => relative(name, &truth, &found),
        }
    };
    let is_first =
        |index: usize| index == 0 || parameters[index - 1].name != parameters[index].name;
    let counts = |kind: Kind| match kind {
        Kind::Phase => same_harmonic(truth, named),
        kind => kind != Kind::Choice,
    };
    let wanted =
        parameters.iter().enumerate().filter(|(index, p)| is_first(*index) && counts(p.kind));
    wanted.map(|(_, parameter)| one(parameter)).collect()
}

fn same_harmonic(truth: &TrueCause, named: &Cause) -> bool {
    let harmonic = truth.known_parameters().iter().find(|p| p.kind == Kind::Harmonic);
    let Some(harmonic) = harmonic else { return true };
    let [truth, found] = values(truth, named, harmonic.name);
    match (truth.first(), found.first()) {
        (None, _) => true,
        (Some(truth), Some(found)) => (truth - found).abs() < 0.5,
        (Some(_), None) => false,
    }
}

/// The values of a parameter, true and found.
fn values(truth: &TrueCause, named: &Cause, name: &str) -> [Vec<f64>; 2] {
    [&truth.parameters, &named.parameters].map(|parameters| components(parameters.get(name)))
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
