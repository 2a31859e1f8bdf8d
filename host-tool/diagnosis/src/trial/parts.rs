//! What a model's equation consists of along a stretch, and how it changes with an effect.

use std::sync::{Arc, OnceLock};

use super::coupling::Coupling;
use super::equation::Trial;
use super::hypothesis::EffectInstance;
use super::motor_side::MotorSide;
use crate::logs::intervals::at_samples;
use crate::logs::joint_dynamics::JointDynamics;
use rig::effects::{Table, Touches};

/// The equation of a joint over a stretch, on the log's clock [V].
#[derive(Clone)]
pub struct Parts {
    /// What drives the joint, by intervals.
    pub drive: Vec<f64>,
    /// Friction, by intervals.
    pub friction: Vec<f64>,
    /// Drive less friction, by intervals.
    pub net: Vec<f64>,
    /// What the rigid body needs, by samples; once asked for.
    needed: OnceLock<Vec<f64>>,
    /// Part of the torque that its constant says which the motor gives.
    motor_gain: f64,
    /// Dynamics of the joint as if it were stiff, by samples; once a spring on it is tried.
    dynamics: OnceLock<Arc<Vec<JointDynamics>>>,
    /// What a link of the joint ahead of its motor pulls at all joints; likewise.
    coupling: OnceLock<Coupling>,
}

/// Those of a joint that is not there.
impl Default for Parts {
    fn default() -> Self {
        let (drive, friction, net) = Default::default();
        let (needed, dynamics, coupling) = Default::default();
        Self { drive, friction, net, needed, motor_gain: 1.0, dynamics, coupling }
    }
}

impl Parts {
    /// Those of a model under trial.
    pub fn of(trial: &Trial, joint: usize) -> Self {
        let drive = trial.drive(joint);
        let friction = trial.friction(joint, trial.plant());
        let net = drive.iter().zip(&friction).map(|(drive, friction)| drive - friction).collect();
        let motor_gain = trial.motor_gain(joint);
        let (needed, dynamics, coupling) = Default::default();
        Self { drive, friction, net, needed, motor_gain, dynamics, coupling }
    }

    /// What the rigid body needs, by samples; from the trial that these parts are of, at first.
    fn needed<'a>(&self, before: &dyn Fn() -> &'a Trial<'a>, joint: usize) -> &[f64] {
        self.needed.get_or_init(|| before().needed(joint).to_vec())
    }

    /// Change of the residual at the samples when a trial takes the place of the one `before`, which these parts are
    /// of.
    pub fn change_to<'a>(
        &self,
        before: &dyn Fn() -> &'a Trial<'a>,
        trial: &Trial,
        joint: usize,
        touches: Touches,
    ) -> Vec<f64> {
        let mut net = vec![0.0; self.drive.len()];
        let mut add = |after: Vec<f64>, before: &[f64], sign: f64| {
            let both = after.iter().zip(before);
            net.iter_mut().zip(both).for_each(|(net, (a, b))| *net += sign * (a - b));
        };
        if touches.drive {
            add(trial.drive(joint), &self.drive, 1.0);
        }
        if touches.friction {
            add(trial.friction(joint, trial.plant()), &self.friction, -1.0);
        }
        let mut change = at_samples(&net);
        if touches.body {
            let both = trial.needed(joint).iter().zip(self.needed(before, joint));
            change.iter_mut().zip(both).for_each(|(change, (a, b))| *change -= a - b);
        }
        self.as_sent(change, before, trial, joint)
    }

    /// A change of what these parts leave of the motor's volts, in volts of the command as it was sent.
    fn as_sent<'a>(
        &self,
        mut change: Vec<f64>,
        of_before: &dyn Fn() -> &'a Trial<'a>,
        trial: &Trial,
        joint: usize,
    ) -> Vec<f64> {
        let (before, after) = (self.motor_gain, trial.motor_gain(joint));
        if before == after {
            change.iter_mut().for_each(|change| *change /= after);
            return change;
        }
        let given = at_samples(&self.net);
        let left =
            given.iter().zip(self.needed(of_before, joint)).map(|(given, needed)| given - needed);
        let both = change.iter_mut().zip(left);
        both.for_each(|(change, left)| *change = (left + *change) / after - left / before);
        change
    }
}

impl MotorSide for Vec<Parts> {
    fn dynamics(
        &self,
        joint: usize,
        make: &dyn Fn() -> Arc<Vec<JointDynamics>>,
    ) -> &Arc<Vec<JointDynamics>> {
        self[joint].dynamics.get_or_init(make)
    }

    fn coupling(&self, joint: usize, make: &dyn Fn() -> Coupling) -> &Coupling {
        self[joint].coupling.get_or_init(make)
    }

    fn net_v(&self, joint: usize) -> &[f64] {
        &self[joint].net
    }
}

/// The motors' side of the springs in these parts, for a hypothesis that differs from theirs in
/// `effect` alone: nothing unless that is a spring.
pub fn motor_side<'a>(parts: &'a Vec<Parts>, effect: &EffectInstance) -> Option<&'a dyn MotorSide> {
    effect.is_spring().then_some(parts)
}

/// What an effect changes in the equation of a model that has others, and tables, too.
pub fn touched(effect: &EffectInstance, others: &[EffectInstance], tables: &[Table]) -> Touches {
    let mut touches = effect.definition.touches;
    let alone = others.is_empty() && tables.is_empty();
    let moves_others = touches.body && !effect.is_spring() && !alone;
    // What is in the model already may depend on a body or a motion that changes.
    touches.drive |= moves_others;
    touches.friction |= moves_others;
    // A link behind a spring is corrected by the torque that drives its motor.
    let meets = |other: &EffectInstance| effect.joint == 0 || effect.joint == other.joint;
    touches.body |= others.iter().any(|other| other.is_spring() && meets(other));
    touches
}

#[cfg(test)]
mod tests {
    use model::friction::FrictionScale;
    use model::reference_robot::reference_robot;
    use rig::Plant;
    use rig::effects::{Catalogue, Definition, DrawContext, JointState, Random};

    use super::*;
    use crate::criteria::FitCriteria;
    use crate::logs::stretch::Stretch;
    use crate::trial::hypothesis::Hypothesis;
    use crate::trial::test_stretch::{PERIOD_S, sines, stretch_of};

    /// Knuth's linear congruential generator.
    struct Lcg(u64);

    impl Random for Lcg {
        fn unit(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// Half a second in which all joints turn back and all commands change their sign.
    fn stretch() -> Stretch {
        let frequencies = [9.0, 11.0, 13.0];
        let command = |w: f64| -> Vec<f64> {
            let angles = (0..500).map(|k| w * PERIOD_S * f64::from(k));
            angles.map(|angle| 2.0 * angle.cos() - angle.sin()).collect()
        };
        let command_v = frequencies.map(command).to_vec();
        stretch_of(sines(0.3, frequencies, 500), command_v, false)
    }

    fn hypothesis(effects: &[&EffectInstance]) -> Hypothesis {
        let effects = effects.iter().copied().cloned().collect();
        Hypothesis { effects, ..Hypothesis::bare(Plant::of_robot(&reference_robot())) }
    }

    /// An effect of random size on every joint that it can act on.
    fn instances(definition: &'static Definition, random: &mut Lcg) -> Vec<EffectInstance> {
        let robot = reference_robot();
        let joints = if definition.whole_robot { 0..=0 } else { 1..=3 };
        let instance = |joint: u8| {
            let index = usize::from(joint.max(1)) - 1;
            let context = DrawContext { robot: &robot, peak_command_v: [2.0; 3], joint: index };
            EffectInstance { definition, joint, values: (definition.draw)(&context, random) }
        };
        joints.map(instance).collect()
    }

    /// The robot's effects and those that only arms of any kind have.
    fn catalogue() -> Catalogue {
        let (standard, of_arms) = (Catalogue::standard(), Catalogue::of_arm(3));
        let more = of_arms.iter().filter(|effect| standard.by_name(effect.name).is_none());
        more.fold(standard.clone(), Catalogue::with)
    }

    /// Turned about the vertical an arm needs what it needed.
    fn shows_nowhere(effect: &EffectInstance) -> bool {
        effect.definition.name == "encoder_offset" && effect.joint == 1
    }

    fn of_all_joints(trial: &Trial) -> Vec<Parts> {
        let of_joint = |joint: usize| {
            let parts = Parts::of(trial, joint);
            parts.needed(&|| trial, joint);
            parts
        };
        (0..3).map(of_joint).collect()
    }

    #[test]
    fn an_effect_touches_what_changes_when_all_is_computed_anew() {
        let (stretch, bare, criteria) = (stretch(), hypothesis(&[]), FitCriteria::default());
        let before = of_all_joints(&Trial::of(&stretch, &bare, &criteria));
        for definition in catalogue().iter() {
            let effects = instances(definition, &mut Lcg(1));
            for effect in effects.into_iter().filter(|effect| !shows_nowhere(effect)) {
                let with = hypothesis(&[&effect]);
                let after = of_all_joints(&Trial::of(&stretch, &with, &criteria));
                let differs = |of: fn(&Parts) -> &[f64]| {
                    [0, 1, 2].map(|joint| of(&before[joint]) != of(&after[joint]))
                };
                let needed = |parts: &Parts| parts.needed.get().unwrap().clone();
                let body = [0, 1, 2].map(|joint| needed(&before[joint]) != needed(&after[joint]));
                let changes = [differs(|p| &p.drive), differs(|p| &p.friction), body];
                let [drive, friction, body] = changes.map(|joints| joints.contains(&true));
                let found = Touches { drive, friction, body };
                assert_eq!(found, definition.touches, "{} {}", definition.name, effect.joint);
                let elsewhere = (0..3).any(|joint| {
                    joint + 1 != usize::from(effect.joint) && changes.iter().any(|c| c[joint])
                });
                assert!(definition.couples_joints || !elsewhere, "{}", definition.name);
            }
        }
    }

    #[test]
    fn an_effect_on_a_joint_leaves_the_friction_of_others_alone() {
        let here = JointState {
            time_s: 1.0,
            q_rad: &[0.4; 3],
            qd_rad_per_s: &[0.7; 3],
            load_nm: &[2.0; 3],
            motor_nm: &[3.0; 3],
        };
        for definition in catalogue().iter().filter(|definition| !definition.whole_robot) {
            for effect in instances(definition, &mut Lcg(3)) {
                let mut scale = [FrictionScale::unchanged(); 3];
                let built = hypothesis(&[&effect]).built_effects();
                built.iter().for_each(|built| built.change_friction(&here, &mut scale));
                scale[usize::from(effect.joint) - 1] = FrictionScale::unchanged();
                assert_eq!(scale, [FrictionScale::unchanged(); 3], "{}", definition.name);
            }
        }
    }

    #[test]
    fn what_is_left_counts_in_volts_as_they_were_sent() {
        let (stretch, criteria) = (stretch(), FitCriteria::default());
        let definition = catalogue().by_name("torque_constant").unwrap();
        let effect = EffectInstance { definition, joint: 2, values: vec![-0.4] };
        let (bare, with) = (hypothesis(&[]), hypothesis(&[&effect]));
        let (bare, with) =
            (Trial::of(&stretch, &bare, &criteria), Trial::of(&stretch, &with, &criteria));
        let (drive, left) = (bare.drive(1), bare.residual(1));
        for (k, changed) in with.residual(1).into_iter().enumerate() {
            let command_v = at_samples(&drive)[k];
            let as_sent_v = command_v - (command_v - left[k]) / 0.6;
            assert!((changed - as_sent_v).abs() < 1e-9, "{changed} rather than {as_sent_v}");
        }
    }

    #[test]
    fn what_an_effect_changes_beside_another_is_what_a_full_computation_says() {
        let (stretch, catalogue, criteria) = (stretch(), catalogue(), FitCriteria::default());
        let all: Vec<EffectInstance> =
            catalogue.iter().flat_map(|d| instances(d, &mut Lcg(2))).collect();
        for other in &all {
            let without = hypothesis(&[other]);
            let before = Trial::of(&stretch, &without, &criteria);
            let parts = of_all_joints(&before);
            for effect in &all {
                if effect.is_spring() && other.is_spring() {
                    continue;
                }
                let with = hypothesis(&[other, effect]);
                let after = Trial::of(&stretch, &with, &criteria);
                let touches = touched(effect, std::slice::from_ref(other), &[]);
                let quick =
                    Trial::with_motor_side(&stretch, &with, &criteria, motor_side(&parts, effect));
                for joint in 0..3 {
                    let change = parts[joint].change_to(&|| &before, &quick, joint, touches);
                    let (from, to) = (before.residual(joint), after.residual(joint));
                    let whole = to.iter().zip(&from).map(|(to, from)| to - from);
                    let worst = whole.zip(&change).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    let names =
                        (effect.definition.name, effect.joint, other.definition.name, other.joint);
                    assert!(worst < 1e-9, "{names:?} joint {joint}: {worst} V");
                }
            }
        }
    }
}
