//! When the search ends, which effects are physical, and which say more than others: conditions on what
//! models leave, and nothing that is computed.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::braking::braked_part;
use crate::criteria::{Criteria, SelectionCriteria};
use crate::fit::excess::excess_v2;
use crate::fit::fitted_model::FittedModel;
use crate::fit::residual_stats::ResidualStats;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::EffectInstance;
use files::Role;
use rig::Plant;
use rig::effects::{Carrier, Kind, Search};

/// Whether nothing is left that asks for another effect: nothing above the noise, and parameters so near to
/// what is known of them that an effect could not gain enough by bringing them back; or so little of the gap
/// that it may be the method's own, for effects that are not linear are not removed to the last.
pub fn is_done(gap: &ResidualStats, left: &ResidualStats, criteria: &Criteria) -> bool {
    let (fit, policy) = (&criteria.fit, &criteria.selection);
    let nearly = left.worst() < policy.done_ratio
        && left.excess < policy.done_part * gap.excess
        && !left.asks_for_cause(fit);
    let near = left.prior_penalty < 2.0 * policy.least_log_likelihood;
    (left.excess == 0.0 && near) || nearly
}

/// Whether a model whose fit is not yet at its end may leave so little of the gap there that the search is done.
pub fn may_be_done(gap: &ResidualStats, model: &FittedModel) -> bool {
    let policy = &model.evidence.criteria.selection;
    let part = if model.ends_with_spring() {
        policy.may_be_done_by_spring
    } else {
        policy.may_be_done_part
    };
    model.stats.excess <= part * gap.excess
}

/// Effects that are another and something more, with that other.
const CONTAINED: [(&str, &str); 2] =
    [("cable_spring", "dac_offset"), ("backlash", "joint_elasticity")];

/// Whether an effect is another of the same joint and something more: a cable that rests far away is an
/// offset. It gains at least as much, and says no more unless it gains what an effect must.
pub fn is_more_than(more: &EffectInstance, simple: &EffectInstance) -> bool {
    let both = (more.definition.name, simple.definition.name);
    CONTAINED.contains(&both) && more.joint == simple.joint
}

/// Squares above the noise that a model leaves of a joint (0: of all) where it was not fitted [V^2].
pub fn left_on_v2(model: &FittedModel, joint: u8) -> f64 {
    let of_joints = excess_v2(&model.evidence, &model.left_out_v, Role::Train);
    let counts = |index: usize| joint == 0 || index + 1 == usize::from(joint);
    let both = model.evidence.joints.iter().zip(of_joints);
    both.filter(|(index, _)| counts(**index)).map(|(_, v2)| v2).sum()
}

/// Whether a rival's model takes a good part of what an effect on a joint (0: of the whole robot) takes
/// there of what is left without it; or gains as much of what it gains, where that is parameters' alone and
/// nothing of the rows.
pub fn explains_as(
    joint: u8,
    without: &FittedModel,
    with: &FittedModel,
    rival: &FittedModel,
) -> bool {
    let left_v2 = |model: &FittedModel| left_on_v2(model, joint);
    let least = without.evidence.criteria.selection.least_as_rival;
    let taken_v2 = left_v2(without) - left_v2(with);
    match taken_v2 > 0.0 {
        true => left_v2(without) - left_v2(rival) >= least * taken_v2,
        false => gain(without, rival) >= least * gain(without, with),
    }
}

/// Log-likelihood that a model gains over another.
pub fn gain(over: &FittedModel, model: &FittedModel) -> f64 {
    model.gain_over(over)
}

/// Whether an effect is not at its bound, rests near the motion and is no other one by another name, whether a spring
/// rings and leaves its motor some inertia, without which it would only smooth what the encoder reads, and whether its
/// backlash, if it has some, is more than the spring's deflection.
pub fn is_physical(effect: &EffectInstance, subject: &Subject, evidence: &Evidence) -> bool {
    let policy = &evidence.criteria.selection;
    if !effect.is_spring() && effect.is_at_bound(policy.near_bound) {
        return false;
    }
    if rests_far(effect, evidence) || warms_at_once(effect, policy) {
        return false;
    }
    if is_hardly_a_wave(effect, subject, evidence) || is_within_a_sample(effect, evidence) {
        return false;
    }
    if is_coulomb_friction(effect, evidence) {
        return false;
    }
    let Some((joint, spring)) = effect.build().and_then(|effect| effect.transmission()) else {
        return true;
    };
    let command_v = evidence.stretches.iter().flat_map(|stretch| &stretch.command_v[joint]);
    let largest_v = command_v.fold(0.0, |largest, u| f64::max(largest, u.abs()));
    let largest_nm = subject.plant.torque_constant_nm_per_v[joint] * largest_v;
    let least_inertia_kg_m2 = policy.least_motor_inertia * subject.inertia_kg_m2(joint);
    let has_motor = spring.motor_inertia_kg_m2 > least_inertia_kg_m2;
    let link_kg_m2 = subject.inertia_kg_m2(joint) - spring.motor_inertia_kg_m2;
    let rings = spring.damping_nm_s_per_rad
        < 2.0
            * policy.most_damping_ratio
            * (spring.stiffness_nm_per_rad * link_kg_m2.max(0.0)).sqrt();
    let is_free = spring.gap_rad * spring.stiffness_nm_per_rad > policy.least_gap * largest_nm;
    has_motor && rings && (is_free || !effect.has_backlash())
}

/// Whether friction drifts so fast that it has another level from the first motion on, which is no
/// warming.
fn warms_at_once(effect: &EffectInstance, policy: &SelectionCriteria) -> bool {
    let mut parameters = effect.definition.parameters.iter().zip(&effect.values);
    effect.definition.name == "friction_drift"
        && parameters
            .any(|(p, value)| p.kind == Kind::TimeConstant && *value < policy.least_warming_s)
}

/// A row is made of the two intervals about its sample.
const ROW_SAMPLES: f64 = 2.0;

/// Whether a command comes later by less than a row of logs so slow that a joint turns round within one: when its
/// command and its friction change their sign is not told by a row, and passes for a lag.
fn is_within_a_sample(effect: &EffectInstance, evidence: &Evidence) -> bool {
    if !effect.is_late() {
        return false;
    }
    let train = &evidence.stretches[..evidence.train_stretches()];
    let sampled_s = train.iter().map(|stretch| stretch.sampled_s).fold(f64::INFINITY, f64::min);
    sampled_s > evidence.criteria.selection.turns_round_s
        && effect.values[0] < ROW_SAMPLES * sampled_s
}

/// Lowest and highest angle of a joint (from 0) in the logs [rad; m].
fn angles(evidence: &Evidence, joint: usize) -> [f64; 2] {
    span(evidence.stretches.iter().flat_map(|stretch| &stretch.motion.q_rad[joint]))
}

/// The least and the largest of some values.
fn span<'a>(values: impl IntoIterator<Item = &'a f64>) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    values.into_iter().fold(none, |[low, high], value| [low.min(*value), high.max(*value)])
}

/// Whether the motor passes less than a quarter of a wave of voltage in the logs, which is a cable by another name.
fn is_hardly_a_wave(effect: &EffectInstance, subject: &Subject, evidence: &Evidence) -> bool {
    let Some((joint, order)) = wave_of_voltage(effect) else { return false };
    order * motor_passes_rad(&subject.plant, joint, angles(evidence, joint)) < FRAC_PI_2
}

/// How many periods of a wave of voltage the motor passes in one log, at most; none of what is no such wave.
pub(super) fn periods_passed(
    effect: &EffectInstance,
    plant: &Plant,
    evidence: &Evidence,
) -> Option<f64> {
    let (joint, order) = wave_of_voltage(effect)?;
    let passed_rad =
        |stretch: &Stretch| motor_passes_rad(plant, joint, span(&stretch.motion.q_rad[joint]));
    let train = &evidence.stretches[..evidence.train_stretches()];
    Some(order / TAU * train.iter().map(passed_rad).fold(0.0, f64::max))
}

/// How far a motor turns while its joint (from 0) goes from one angle to another.
fn motor_passes_rad(plant: &Plant, joint: usize, [lowest, highest]: [f64; 2]) -> f64 {
    plant.gears[joint].motor.abs() * (highest - lowest)
}

/// The joint (from 0) and the order of a wave of voltage.
fn wave_of_voltage(effect: &EffectInstance) -> Option<(usize, f64)> {
    let is_one = matches!(effect.definition.search, Search::Harmonics(Carrier::Unity));
    let joint = usize::from(effect.joint).checked_sub(1).filter(|_| is_one)?;
    Some((joint, effect.order()?))
}

/// Whether an effect takes a constant from the command by its sign, where that is the sign of the velocity almost always
/// that the joint moves: Coulomb friction by another name.
fn is_coulomb_friction(effect: &EffectInstance, evidence: &Evidence) -> bool {
    let Some(joint) = usize::from(effect.joint).checked_sub(1) else { return false };
    effect.definition.name == "dead_zone"
        && braked_part(evidence, joint) < evidence.criteria.selection.least_braked
}

/// Whether an angle of an effect lies so far from the motion that it is none: cables that rest ten turns
/// away are a constant by another name.
fn rests_far(effect: &EffectInstance, evidence: &Evidence) -> bool {
    let far_rad = evidence.criteria.selection.far_rest_rad;
    let Some(joint) = usize::from(effect.joint).checked_sub(1) else { return false };
    let [lowest, highest] = angles(evidence, joint);
    let near = lowest - far_rad..=highest + far_rad;
    let parameters = effect.definition.parameters.iter().zip(&effect.values);
    parameters.filter(|(p, _)| p.kind == Kind::Angle).any(|(_, value)| !near.contains(value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::test_effects::wave;
    use crate::trial::test_stretch::rows_of_sines;
    use model::reference_robot::reference_robot;

    #[test]
    fn a_log_holds_periods_of_a_wave_of_voltage_as_its_motor_turns() {
        let evidence = rows_of_sines(&Criteria::default());
        let mut plant = Plant::of_robot(&reference_robot());
        let [lowest, highest] = span(&evidence.stretches[0].motion.q_rad[1]);
        let periods =
            |plant: &Plant, name: &str| periods_passed(&wave(name, 2, 9.0), plant, &evidence);
        let expected = 9.0 * (highest - lowest) / TAU;
        assert!((periods(&plant, "cogging").unwrap() - expected).abs() < 1e-12);
        plant.gears[1].motor = -50.0;
        assert!((periods(&plant, "cogging").unwrap() - 50.0 * expected).abs() < 1e-9);
        assert_eq!(periods(&plant, "position_friction"), None);
        assert_eq!(periods(&plant, "torque_ripple"), None);
    }
}
