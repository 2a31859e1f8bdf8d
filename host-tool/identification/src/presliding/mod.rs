//! Pre-sliding friction from the FRF (section 3.2, eq. (12)), with the neighbours' motion.
//!
//! The FRF of eq. (12) is one row of the linearised robot with all other joints fixed. Held
//! joints are compliant, so here all rows are taken together, each with its own bristles:
//!
//! ```text
//! M(s) q = u,   M_ij = (D_ij s^2 + dh_i/dq_j) / k_t,i   (+ friction where i = j),
//! friction_i = (sigma0 + sigma1 s) (1 - kappa) s / (s + lambda) + alpha2 s
//! ```
//!
//! The commands u of all joints are known exactly, those of the held ones included, so
//! q_i = row i of M^-1 u is fitted to the averaged spectra without the quantised
//! positions of neighbours that move by less than a count. The residual of that fit is
//! correlated with the exciting signal alone and weighted by its own spectrum.
//!
//! LuGre friction is not linear at the amplitudes used: noise lets the bristles creep.
//! `lambda` and `kappa` are its statistical linearisation ([`creep`]); without them
//! sigma0 of joint 1 comes out several per cent low.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`prior`] | the earlier steps' results, and settings |
//! | `record` | a log as spectra |
//! | [`linear`] | the linearised robot, M and its inverse |
//! | [`creep`] | lambda and kappa |
//! | `start`, `prior_distribution`, `problem`, `fit` | first guess, means and errors before the fit, least-squares problem, weighted fit |
//! | [`result`] | estimates, intervals, remarks, the FRF for Fig. 4 |

pub mod creep;
mod fit;
pub mod linear;
pub mod prior;
mod prior_distribution;
mod problem;
mod record;
pub mod result;
mod start;

pub use prior::{Bristles, Prior, RigidBody, Settings, Sliding};
pub use result::{FrfPoint, Presliding};

use record::Record;
use recordings::StepError;
use recordings::campaign::{Known, Trace};

/// Stiffness and damping of a joint's bristles from a log of noise on it.
///
/// `joint` is 1 to 3.
///
/// # Errors
/// A log without the joint, too short, uneven in time, without motion or without
/// noise on the joint; a fit that did not work out.
pub fn identify(
    trace: &Trace,
    joint: u8,
    known: &Known,
    prior: &Prior,
) -> Result<Presliding, StepError> {
    identify_with(trace, joint, known, prior, &Settings::default())
}

/// [`identify`] with other settings.
///
/// # Errors
/// Those of [`identify`].
pub fn identify_with(
    trace: &Trace,
    joint: u8,
    known: &Known,
    prior: &Prior,
    settings: &Settings,
) -> Result<Presliding, StepError> {
    let record = Record::of(trace, joint, known, settings)?;
    let fitted = fit::fit(&record, known, prior, settings)?;
    Ok(result::conclude(&record, &fitted, prior, settings))
}

/// All joints that have a log, twice: the second time each knows its neighbours'
/// bristles from the first.
///
/// The logs' own joint numbers say which joint is excited.
pub fn identify_all(
    traces: &[&Trace],
    known: &Known,
    prior: &Prior,
    settings: &Settings,
) -> Vec<(u8, Result<Presliding, StepError>)> {
    let of_joint = |trace: &Trace| trace.joint.or_else(|| known.joints.first().copied());
    let pass = |prior: &Prior| -> Vec<(u8, Result<Presliding, StepError>)> {
        let one = |trace: &&Trace| {
            let joint = of_joint(trace)?;
            Some((joint, identify_with(trace, joint, known, prior, settings)))
        };
        traces.iter().filter_map(one).collect()
    };
    let mut informed = prior.clone();
    for (joint, found) in pass(prior) {
        // A joint that was found has a number from 1 to 3.
        if let Ok(found) = found {
            informed.bristles[usize::from(joint) - 1] = Some(found.bristles());
        }
    }
    pass(&informed)
}
