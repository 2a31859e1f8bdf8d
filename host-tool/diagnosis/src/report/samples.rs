//! Models drawn from what the logs leave open, and a table of their parameters.

use nalgebra::DVector;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::amended::amended;
use super::parameters_changed::name;
use crate::fit::unknowns::{Unknown, kept_physical};
use crate::model_file::ModelFile;
use crate::posterior::Posterior;

/// How many models a table of them has: enough for percentiles of 2.5 and 97.5.
pub const SAMPLES: usize = 200;

/// A model drawn.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Values of the parameters that [`Posterior::names`] names.
    pub values: Vec<f64>,
    /// The model.
    pub model: ModelFile,
}

impl Posterior {
    /// The parameters of model files that are open, `friction[2].alpha2_V_s_per_rad` or
    /// `cogging[3].amplitude_V` say.
    pub fn names(&self) -> Vec<String> {
        self.unknowns.iter().filter_map(|unknown| self.name(*unknown)).collect()
    }

    /// Models, the same for the same seed.
    pub fn samples(&self, count: usize, seed: u64) -> Vec<Sample> {
        let mut generator = Pcg64Mcg::new(u128::from(seed));
        (0..count).map(|_| self.sample(&mut generator)).collect()
    }

    fn sample(&self, generator: &mut Pcg64Mcg) -> Sample {
        let mut draw = |_, _| StandardNormal.sample(generator);
        let even = DVector::from_fn(self.unknowns.len(), &mut draw);
        let change = self.factor.tr_solve_lower_triangular(&even).unwrap_or(0.0 * even);
        let mut drawn = self.hypothesis.clone();
        for (unknown, change) in self.unknowns.iter().zip(change.iter()) {
            unknown.set(&mut drawn, unknown.get(&self.hypothesis) + change);
        }
        kept_physical(&mut drawn, &self.subject);
        drawn.effects.iter_mut().for_each(|effect| effect.normalise());
        let named = self.unknowns.iter().filter(|unknown| self.name(**unknown).is_some());
        let values = named.map(|unknown| unknown.get(&drawn)).collect();
        Sample { values, model: amended(&self.subject, &self.file, &drawn) }
    }

    /// A parameter's name; none for what model files do not hold.
    fn name(&self, unknown: Unknown) -> Option<String> {
        let (index, value) = match unknown {
            Unknown::Effect { index, value } => (index, value),
            Unknown::Table { index, knot } => {
                let table = &self.hypothesis.tables[index];
                let joint = self.subject.outer_joint(table.joint);
                return Some(format!("table[{joint}].{}.values_V[{knot}]", table.axis.name()));
            }
            other => return name(&self.subject, other),
        };
        let effect = &self.hypothesis.effects[index];
        let parameters = effect.definition.parameters;
        let own = parameters[value].name;
        let joint = self.subject.outer_joint(effect.joint);
        let first = parameters.iter().position(|parameter| parameter.name == own)?;
        let is_vector = parameters.iter().filter(|parameter| parameter.name == own).count() > 1;
        let component = if is_vector { format!("[{}]", value - first) } else { String::new() };
        Some(format!("{}[{joint}].{own}{component}", effect.definition.name))
    }

    /// A table of samples as CSV, a column for each parameter; in the units of model files.
    pub fn table(&self, count: usize, seed: u64) -> String {
        let row = |sample: Sample| -> String {
            sample.values.iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n"
        };
        let rows: String = self.samples(count, seed).into_iter().map(row).collect();
        format!("{}\n{rows}", self.names().join(","))
    }
}
