//! A sum of parameters that act together.

use model::mechanism::ParameterName;

/// Parameters that have their effect on the torques in common: a sum with factors.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Index and name of each parameter with its factor; the first, with factor one, stands for
    /// all: the regressor's column of the sum is its column.
    pub terms: Vec<(usize, ParameterName, f64)>,
}

impl Combination {
    /// The regressor's column.
    pub fn column(&self) -> usize {
        self.terms[0].0
    }

    /// The sum's value, from the values of all parameters.
    pub fn value(&self, parameters: &[f64]) -> f64 {
        self.terms.iter().map(|(index, _, factor)| factor * parameters[*index]).sum()
    }
}

/// `joint[1].izz_kg_m2 + 0.04 joint[2].mass_kg - joint[2].iyy_kg_m2`
impl std::fmt::Display for Combination {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (place, (_, name, factor)) in self.terms.iter().enumerate() {
            match (place, *factor < 0.0) {
                (0, _) => {}
                (_, true) => f.write_str(" - ")?,
                (_, false) => f.write_str(" + ")?,
            }
            let size = (factor.abs() * 1e9).round() / 1e9;
            if size != 1.0 {
                write!(f, "{size} ")?;
            }
            write!(f, "{name}")?;
        }
        Ok(())
    }
}
