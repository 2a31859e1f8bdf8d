//! What a diagnosis made of a case, beside the truth.

use serde::Serialize;

use super::kind::ArmKind;
use crate::case::Kind;
use crate::cause::TrueCause;
use crate::claim::Claim;
use crate::diverse::{KNOWABLE, names};

/// A case's truth and the answer.
#[derive(Clone, Debug, Serialize)]
pub struct ArmOutcome {
    /// Number of the case.
    pub case: u32,
    /// The kind of arm.
    pub arm: ArmKind,
    /// Whether something is hidden.
    pub kind: Kind,
    /// What is hidden.
    pub truth: Option<TrueCause>,
    /// The probability that somebody who knows the arm names it.
    pub oracle: Option<f64>,
    /// The verdict, or "failed".
    pub verdict: String,
    /// Why there is no report, where there is none.
    pub failure: Option<String>,
    /// The causes named, in the report's order.
    pub claims: Vec<Claim>,
    /// Processor time of the diagnosis [s].
    pub seconds: f64,
}

impl ArmOutcome {
    /// Whether a claim names what is hidden.
    pub fn is_true(&self, claim: &Claim) -> bool {
        let is_it = |truth: &TrueCause| names(claim, truth) || self.is_same_lean(claim, truth);
        self.truth.as_ref().is_some_and(is_it)
    }

    /// Whether both turn all of a planar pendulum against gravity: its base leans, or its first joint's
    /// zero lies elsewhere.
    fn is_same_lean(&self, claim: &Claim, truth: &TrueCause) -> bool {
        const LEANS: [(&str, u8); 2] = [("base_tilt", 0), ("encoder_offset", 1)];
        let leans = |name: &str, joint: u8| LEANS.contains(&(name, joint));
        self.arm == ArmKind::TwoLinkPendulum
            && leans(&claim.effect, claim.joint)
            && leans(&truth.effect, truth.joint)
    }

    /// Whether a name was given for which there is nothing.
    pub fn has_wrong_name(&self) -> bool {
        self.claims.iter().any(|claim| !self.is_true(claim))
    }

    /// Whether the first name is right.
    pub fn is_first_right(&self) -> bool {
        self.claims.first().is_some_and(|claim| self.is_true(claim))
    }

    /// Whether what is hidden could be known.
    pub fn is_knowable(&self) -> bool {
        self.oracle.is_some_and(|oracle| oracle > KNOWABLE)
    }

    /// Whether the answer to an arm without anything hidden is that.
    pub fn is_none(&self) -> bool {
        self.verdict == "none" && self.claims.is_empty()
    }
}
