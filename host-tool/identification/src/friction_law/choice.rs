//! The law of each joint.

use super::evidence::{Evidence, Fitted, blocks_of, carried_by};
use super::halves::halves;
use super::law::{FrictionLaw, Law};
use super::static_friction::with_stiffness;
use super::stiffness::softest;
use crate::base_parameters::FrictionEstimate;
use crate::presliding::Presliding;
use model::Friction;
use recordings::campaign::{Known, Trace};

/// The laws of all joints, and friction by them as the prior of the refinement.
///
/// `lugre` and `still` are friction by either law, as the steps before found it.
pub(crate) fn choose(
    excitations: &[&Trace],
    known: &Known,
    lugre: &[FrictionEstimate; 3],
    still: &[FrictionEstimate; 3],
    presliding: &[Presliding],
) -> ([FrictionLaw; 3], [FrictionEstimate; 3]) {
    let folds = halves(excitations);
    let (by_lugre, by_static) =
        rayon::join(|| carried_by(&folds, known, lugre), || carried_by(&folds, known, still));
    let evidence = |i: usize| {
        let (lugre, still) = (by_lugre.as_ref()?, by_static.as_ref()?);
        Evidence::of(&blocks_of(lugre, i), &blocks_of(still, i))
    };
    let laws = [0, 1, 2].map(|i| {
        let joint = i as u8 + 1;
        let frf = presliding.iter().find(|p| p.joint == joint);
        let friction = stiffest(lugre[i].value, by_lugre.as_deref().unwrap_or_default(), i);
        FrictionLaw::of(joint, evidence(i), frf, &friction, known.encoder_step_rad)
    });
    let stands = |i: usize| laws[i].law == Law::Static;
    let stiffness = by_static.filter(|_| (0..3).any(stands)).map(|fitted| softest(&folds, &fitted));
    let friction = [0, 1, 2].map(|i| match (stands(i), &stiffness) {
        (true, Some(stiffness)) => with_stiffness(&still[i], stiffness[i]),
        (true, None) => still[i],
        (false, _) => lugre[i],
    });
    (laws, friction)
}

/// The stiffest of what the steps before and either half say of a joint (0 to 2).
fn stiffest(before: Friction<f64>, halves: &[Fitted], joint: usize) -> Friction<f64> {
    halves.iter().map(|fitted| fitted.robot.friction[joint]).fold(before, |stiffest, friction| {
        let is_stiffer = friction.sigma0_v_per_rad > stiffest.sigma0_v_per_rad;
        if is_stiffer { friction } else { stiffest }
    })
}
