//! The truth, whose hash is printed before the first diagnosis and whose text is written after
//! the last.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::path::Path;

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::case::{Case, Kind};
use super::cause::TrueCause;
use super::error::TrialError;
use super::output::write_text;
use super::plans::Motions;
use super::reality::Reality;
use super::visibility::Visibility;
use files::Problem;

/// What the hash is of.
#[derive(Serialize)]
struct Truth<T> {
    /// A random number, so that nobody finds the truth by trying hashes.
    nonce: String,
    cases: Vec<T>,
}

/// The truth of a case.
#[derive(Serialize)]
struct CaseTruth<'a> {
    case: u32,
    kind: Kind,
    verdict: &'static str,
    causes: &'a [TrueCause],
    visibility: Option<Visibility>,
    motions: Motions,
    #[serde(rename = "noise_V")]
    noise_v: f64,
    seed: u32,
    robot: &'a model::Robot<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reality: Option<&'a Reality>,
}

impl<'a> CaseTruth<'a> {
    fn of(case: &'a Case) -> Self {
        Self {
            case: case.number,
            kind: case.kind,
            verdict: verdict(case.kind),
            causes: &case.causes,
            visibility: case.visibility,
            motions: case.motions,
            noise_v: case.noise_v,
            seed: case.seed,
            robot: &case.robot,
            reality: case.reality.as_ref(),
        }
    }
}

/// What a perfect diagnosis says of a kind.
fn verdict(kind: Kind) -> &'static str {
    match kind {
        Kind::None => "none",
        Kind::Single | Kind::Pair => "effect",
        Kind::Foreign => "unknown",
    }
}

/// The truth of all cases, kept in memory until it is revealed.
#[derive(Clone, Debug)]
pub struct SealedTruth {
    text: String,
    hash: String,
}

impl SealedTruth {
    /// Seals the truth with a random number.
    pub fn new(cases: &[Case]) -> Self {
        Self::of(cases.iter().map(CaseTruth::of).collect())
    }

    /// Seals whatever tells the truth of each case.
    pub fn of<T: Serialize>(cases: Vec<T>) -> Self {
        let truth = Truth { nonce: nonce(), cases };
        // Numbers and words alone: this cannot fail.
        let text = serde_json::to_string_pretty(&truth).unwrap_or_default() + "\n";
        Self { hash: sha256(text.as_bytes()), text }
    }

    /// SHA-256 of the truth's file.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// Writes the hash to `seal.txt`, as sha256sum checks it once the truth is there.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_hash(&self, directory: &Path) -> Result<(), TrialError> {
        write_text(&directory.join("seal.txt"), &format!("{}  truth.json\n", self.hash))
    }

    /// Writes the truth to `truth.json` and reads it back.
    ///
    /// # Errors
    /// The file cannot be written, or its hash is not the one that was announced.
    pub fn reveal(&self, directory: &Path) -> Result<(), TrialError> {
        let path = directory.join("truth.json");
        write_text(&path, &self.text)?;
        let found = std::fs::read(&path).map_err(|e| Problem::Unreadable(e).in_file(&path))?;
        let opened = sha256(&found);
        if opened == self.hash {
            return Ok(());
        }
        Err(TrialError::Seal { sealed: self.hash.clone(), opened })
    }
}

/// Writes a case's own truth into its directory, for cases that are only drawn.
///
/// # Errors
/// The file cannot be written.
pub fn write_truth(case: &Case, directory: &Path) -> Result<(), TrialError> {
    let text = serde_json::to_string_pretty(&CaseTruth::of(case)).unwrap_or_default() + "\n";
    write_text(&directory.join("truth.json"), &text)
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// 128 bits from the system's own random numbers.
fn nonce() -> String {
    let word = || RandomState::new().build_hasher().finish();
    format!("{:016x}{:016x}", word(), word())
}
