//! Arms of any kind as the model's types.

use model::chain::SerialChain;

use super::arm::ArmFile;
use super::joint::ArmJoint;
use crate::error::{FileError, Problem};

impl ArmFile {
    /// The chain of links; a rotor that the file does not name has no inertia.
    ///
    /// # Errors
    /// A link is not known, with the line of its joint.
    pub fn chain(&self) -> Result<SerialChain<f64>, FileError> {
        match self.joints.iter().position(|joint| !joint.is_link_known()) {
            None => self.chain_of_what_is_known(),
            Some(index) => {
                let link = &self.joints[index].link;
                let name = match (link.mass_kg, link.com_m) {
                    (None, _) => "mass_kg",
                    (_, None) => "com_m",
                    _ => "inertia_kg_m2",
                };
                let what = format!("{name} of joint {}", self.describe(index));
                Err(self.problem(index, Problem::MissingParameter(what)))
            }
        }
    }

    /// The chain in which what is unknown of a link is zero.
    ///
    /// # Errors
    /// The joints make no chain, which only changed values can bring about.
    pub fn chain_of_what_is_known(&self) -> Result<SerialChain<f64>, FileError> {
        let joints: Vec<_> = self.joints.iter().map(ArmJoint::of_chain).collect();
        SerialChain::new(self.gravity_m_s2, &joints).map_err(|error| {
            let index = usize::from(error.joint).saturating_sub(1);
            self.problem(index, Problem::Parameter(error))
        })
    }

    /// Remarks on links that no matter can have, which is no error: many published inertias are so.
    pub fn remarks(&self) -> Vec<String> {
        let known = (0..self.joints.len()).filter(|index| self.joints[*index].is_link_known());
        let is_odd = |index: &usize| {
            let mut body = self.joints[*index].of_chain().body;
            // A rod or a point is the limit of bodies, and published digits are rounded.
            let [xx, _, _, yy, _, zz] = &mut body.inertia_kg_m2;
            let little = 1e-4 * (*xx + *yy + *zz) + 1e-12;
            [xx, yy, zz].into_iter().for_each(|moment| *moment += little);
            body.mass_kg > 0.0 && !body.is_physical()
        };
        let remark = |index| {
            format!(
                "no body has the inertia of joint {}: one of its moments exceeds the sum of the others",
                self.describe(index)
            )
        };
        known.filter(is_odd).map(remark).collect()
    }

    /// `2 (elbow)`, from an index.
    fn describe(&self, index: usize) -> String {
        match self.joints.get(index).and_then(|joint| joint.name.as_ref()) {
            Some(name) => format!("{} ({name})", index + 1),
            None => format!("{}", index + 1),
        }
    }

    /// A problem at the line of a joint, from its index.
    pub fn problem(&self, joint: usize, problem: Problem) -> FileError {
        self.source.problem_in_nth(problem, "joint", joint)
    }
}
