//! The effects of a hypothesis, acting along the measured motion of a stretch.
//!
//! They are those of the simulator: what changes the command is applied to the recorded
//! command, what adds torque or friction is added, what changes the encoder's reading is
//! undone. Commands are recorded without noise, so nothing is inverted that would amplify it.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use model::chain::MAX_JOINTS;
use model::friction::FrictionScale;
use model::friction_parameters::COUNT as FRICTION_COUNT;
use model::{Dual, Friction, FrictionState, Real};

use super::hypothesis::Hypothesis;
use super::reading;
use super::warmth;
use crate::logs::kinematics::{Joints, Kinematics, Middles, Sliding};
use crate::logs::loads::loads;
use crate::logs::stretch::Stretch;
use rig::Plant;
use rig::effects::{Effect, JointState, Table, TableAxis, Transmission};

/// Slopes of friction: along its parameters, along its lead, and along the gears' loss.
pub const FRICTION_SLOPES: usize = FRICTION_COUNT + 2;

/// Places of the parameters of friction that warmth scales: alpha0, alpha1 and alpha2.
const SCALED: [usize; 3] = [0, 1, 3];

/// Whether warmth scales this parameter of friction.
pub fn is_scaled(parameter: usize) -> bool {
    SCALED.contains(&parameter)
}

/// The effects of a hypothesis on a stretch.
pub struct ActiveEffects<'a> {
    pub(super) stretch: &'a Stretch,
    pub(super) hypothesis: &'a Hypothesis,
    effects: Vec<Box<dyn Effect>>,
    /// The plant with what effects change in it, motors of elastic joints included.
    pub plant: Plant,
    /// Motion of the motors: borrowed from the stretch where the encoders read true.
    pub motor: Cow<'a, Kinematics>,
    /// Its middles, where that is not the stretch's.
    middles: OnceLock<Middles>,
    /// Load on the joints in every interval, once it is asked for.
    loads: OnceLock<Arc<Vec<Joints>>>,
    /// Torques of the motors in every interval, once they are asked for [Nm].
    motor_nm: OnceLock<Vec<Joints>>,
    /// Torques that effects on the whole robot add in every interval, by joints, once they are asked for [Nm].
    pub(super) from_outside_nm: OnceLock<Vec<Vec<f64>>>,
}

impl<'a> ActiveEffects<'a> {
    /// Those of a hypothesis, none of which has acted yet.
    pub fn of(stretch: &'a Stretch, hypothesis: &'a Hypothesis) -> Self {
        let effects = effects_at_rest(hypothesis, stretch.period_s);
        let mut plant = hypothesis.plant.clone();
        effects.iter().for_each(|effect| effect.change_robot(&mut plant));
        let motor = reading::corrected(&stretch.motion, &effects);
        let (middles, loads, motor_nm, from_outside_nm) = Default::default();
        Self {
            stretch,
            hypothesis,
            effects,
            plant,
            motor,
            middles,
            loads,
            motor_nm,
            from_outside_nm,
        }
    }

    /// Joints (from 0) with a spring between motor and link.
    pub fn springs(&self) -> Vec<(usize, Transmission)> {
        self.effects.iter().filter_map(|effect| effect.transmission()).collect()
    }

    /// Torque that the motor of a joint gives of every command, in parts of what its torque constant says.
    pub fn motor_gain(&self, joint: usize) -> f64 {
        self.effects.iter().map(|effect| effect.motor_gain(joint)).product()
    }

    /// Friction of a joint of `plant` in the interval after each sample [V].
    pub fn friction_v(&self, joint: usize, plant: &Plant) -> Vec<f64> {
        let Hypothesis { friction_lead_s, gear_loss, .. } = self.hypothesis;
        let (friction, lead_s) = (&plant.friction[joint], friction_lead_s[joint]);
        self.friction_with(joint, friction, (lead_s, *gear_loss), |friction_v| friction_v)
    }

    /// Slopes of a joint's friction in the interval after each sample: along each of its
    /// parameters, in their order, along its lead, and along the gears' loss [V per their unit].
    pub fn friction_slopes(&self, joint: usize) -> Vec<[f64; FRICTION_SLOPES]> {
        let mut place = 0;
        let mut along = |value: f64| {
            place += 1;
            Dual::along(value, place - 1)
        };
        let friction = Friction::from_array(self.plant.friction[joint].to_array().map(&mut along));
        let lead_s = along(self.hypothesis.friction_lead_s[joint]);
        let gear_loss = along(self.hypothesis.gear_loss);
        self.friction_with(joint, &friction, (lead_s, gear_loss), |friction_v| friction_v.slope)
    }

    /// A part of a joint's friction in the interval after each sample, were it `friction`, its dry part ahead of the
    /// velocity by `lead_s`, and its level grew by the part `gear_loss` of the command. Viscous friction is not ahead:
    /// that would be inertia by another name.
    fn friction_with<T: Real, P>(
        &self,
        joint: usize,
        friction: &Friction<T>,
        (lead_s, gear_loss): (T, T),
        part: impl Fn(T) -> P,
    ) -> Vec<P> {
        let (half, quarter) = (T::constant(0.5), T::constant(0.25));
        let half_s = half * T::constant(self.stretch.period_s);
        let sliding = self.sliding(joint);
        let last = sliding.velocity_rad_per_s.len() - 1;
        let at = |k: usize| sliding.ahead_by(lead_s, k);
        let mut before = at(0);
        let scaling = at_rest(self.hypothesis.effects_on_friction_of(joint), self.stretch.period_s);
        let felt = TorquesFelt::by(&scaling);
        let warmth = self.hypothesis.warmth(joint, self.stretch.log);
        let command_v = &self.stretch.command_v[joint];
        let mut bristles = FrictionState { deflection_rad: T::zero() };
        let mut scales = [FrictionScale::unchanged(); MAX_JOINTS];
        let scales = &mut scales[..self.plant.joints()];
        let mut interval = |k: usize| {
            if !scaling.is_empty() {
                scales.fill(FrictionScale::unchanged());
                let joint_state = self.joint_state(k, felt);
                scaling.iter().for_each(|e| e.change_friction(&joint_state, scales));
            }
            let mut scale: FrictionScale<T> = scales[joint].cast();
            if let Some(warmth) = warmth {
                let factor = T::constant(warmth.factor(self.middle_s(k)));
                (scale.level, scale.viscous) = (scale.level * factor, scale.viscous * factor);
            }
            scale.added_v = scale.added_v + gear_loss * T::constant(command_v[k].abs());
            let ((here, ahead), (next, next_ahead)) = (before, at((k + 1).min(last)));
            before = (next, next_ahead);
            let quarter_on = (next - here) * quarter;
            let early = bristles.step_scaled(friction, scale, here + quarter_on, half_s);
            let late = bristles.step_scaled(friction, scale, next - quarter_on, half_s);
            let viscous = friction.alpha2_v_s_per_rad * scale.viscous;
            part(half * (early + late - viscous * (ahead + next_ahead)))
        };
        (0..=last).map(&mut interval).collect()
    }

    /// Slopes of a joint's friction along the parts of its warmth in the log, by those along its parameters: warmth
    /// changes slowly, so it acts as the parameters would that it scales [V].
    pub fn warmth_slopes(&self, joint: usize, slopes: &[[f64; FRICTION_SLOPES]]) -> [Vec<f64>; 2] {
        let of = self.plant.friction[joint].to_array();
        let warmth = self.hypothesis.warmth(joint, self.stretch.log).unwrap_or_default();
        let scaled = |(k, slope): (usize, &[f64; FRICTION_SLOPES])| {
            let scaled_v: f64 = SCALED.iter().map(|&at| of[at] * slope[at]).sum();
            let level_v = scaled_v / warmth.factor(self.middle_s(k));
            warmth::shape(self.middle_s(k)).map(|shape| shape * level_v)
        };
        let both = slopes.iter().enumerate().map(scaled).map(|[begin, later]| (begin, later));
        let (begin, later) = both.unzip();
        [begin, later]
    }

    /// Time of the middle of the interval after a sample since its log began [s].
    fn middle_s(&self, k: usize) -> f64 {
        self.stretch.start_s + (k as f64 + 0.5) * self.stretch.period_s
    }

    /// What a joint's friction follows: that of the stretch where the encoders read true.
    fn sliding(&self, joint: usize) -> Cow<'_, Sliding> {
        let Stretch { at_rest_rad, period_s, derived, .. } = self.stretch;
        let make = || self.motor.sliding(joint, at_rest_rad[joint], *period_s);
        match &self.motor {
            Cow::Borrowed(_) => Cow::Borrowed(derived.sliding[joint].get_or_init(make)),
            Cow::Owned(_) => Cow::Owned(make()),
        }
    }

    /// How far the bristles of each joint are bent at every sample.
    pub fn bristles(&self) -> Vec<Vec<FrictionState<f64>>> {
        let mut bristles = vec![FrictionState::default(); self.plant.joints()];
        let mut scale = vec![FrictionScale::unchanged(); self.plant.joints()];
        let sliding: Vec<Cow<Sliding>> =
            (0..self.plant.joints()).map(|joint| self.sliding(joint)).collect();
        let felt = TorquesFelt::by(&self.effects);
        let mut at = |k: usize| {
            let before = bristles.clone();
            scale.fill(FrictionScale::unchanged());
            let joint_state = self.joint_state(k, felt);
            self.effects.iter().for_each(|e| e.change_friction(&joint_state, &mut scale));
            for (joint, state) in bristles.iter_mut().enumerate() {
                let v = sliding[joint].velocity_rad_per_s[k];
                let friction = &self.plant.friction[joint];
                state.step_scaled(friction, scale[joint], v, self.stretch.period_s);
            }
            before
        };
        (0..self.stretch.len()).map(&mut at).collect()
    }

    /// Where on an axis a joint is in the interval after each sample, in the axis' unit.
    pub fn abscissa(&self, joint: usize, axis: TableAxis) -> Vec<f64> {
        let table = Table { joint: joint as u8 + 1, axis, knots: vec![], values_v: vec![] };
        let felt = TorquesFelt { load: axis == TableAxis::Load, motor_torque: false };
        let at = |k: usize| {
            let state = self.joint_state(k, felt);
            table.abscissa(&state, self.stretch.command_v[joint][k])
        };
        (0..self.stretch.len()).map(at).collect()
    }

    /// The middle of an interval, as effects see it; torques are zero unless they are felt.
    #[inline]
    pub(super) fn joint_state(&self, k: usize, felt: TorquesFelt) -> JointState<'_> {
        const NONE_NM: Joints = [0.0; MAX_JOINTS];
        let (q_rad, qd_rad_per_s) = self.middles().at(k);
        let load_nm = if felt.load { &self.loads()[k] } else { &NONE_NM };
        let motor_nm = if felt.motor_torque { &self.motor_torques()[k] } else { &NONE_NM };
        JointState {
            time_s: self.middle_s(k),
            q_rad,
            qd_rad_per_s,
            load_nm: &load_nm[..q_rad.len()],
            motor_nm: &motor_nm[..q_rad.len()],
        }
    }

    /// Torques that the motors make of what they are sent in every interval [Nm; N].
    fn motor_torques(&self) -> &[Joints] {
        self.motor_nm.get_or_init(|| {
            let sent = self.stretch.command_v.iter().zip(&self.plant.torque_constant_nm_per_v);
            let mut torques_nm = vec![Joints::default(); self.stretch.len()];
            for (joint, (command_v, k_t)) in sent.enumerate() {
                let both = torques_nm.iter_mut().zip(command_v);
                both.for_each(|(torques_nm, command_v)| torques_nm[joint] = k_t * command_v);
            }
            torques_nm
        })
    }

    /// Load on the joints in every interval: those of the stretch where the encoders read true.
    fn loads(&self) -> &[Joints] {
        let body = &self.plant.body;
        let make = || loads(body, self.middles());
        self.loads.get_or_init(|| match &self.motor {
            Cow::Borrowed(_) => self.stretch.derived.loads.of(body, make),
            Cow::Owned(_) => Arc::new(make()),
        })
    }

    /// Middles of the motors' motion: those of the stretch where the encoders read true.
    fn middles(&self) -> &Middles {
        let make = || Middles::of(&self.motor);
        match &self.motor {
            Cow::Borrowed(_) => self.stretch.derived.middles.get_or_init(make),
            Cow::Owned(_) => self.middles.get_or_init(make),
        }
    }

    /// Load c + h on a joint at the samples [Nm].
    pub fn load_nm(&self, joint: usize) -> Vec<f64> {
        self.load_at_every_nm(joint, 1)
    }

    /// The same at every so many samples [Nm].
    pub fn load_at_every_nm(&self, joint: usize, samples: usize) -> Vec<f64> {
        let at = |k: usize| {
            let [q, qd, _] = self.motor.state(k);
            load_nm(&self.plant, &q, &qd)[joint]
        };
        (0..self.stretch.len()).step_by(samples).map(at).collect()
    }
}

/// Effects as they are before a pass over samples so far apart [s]: lags and delays remember.
fn effects_at_rest(hypothesis: &Hypothesis, period_s: f64) -> Vec<Box<dyn Effect>> {
    at_rest(hypothesis.built_effects(), period_s)
}

/// Which torques effects feel.
#[derive(Clone, Copy, Debug)]
pub(super) struct TorquesFelt {
    /// Those of gravity and Coriolis.
    load: bool,
    /// Those of the motors.
    motor_torque: bool,
}

impl TorquesFelt {
    /// By these effects.
    pub fn by(effects: &[Box<dyn Effect>]) -> Self {
        let any = |feels: fn(&dyn Effect) -> bool| effects.iter().any(|effect| feels(&**effect));
        Self { load: any(|e| e.feels_load()), motor_torque: any(|e| e.feels_motor_torque()) }
    }
}

pub(super) fn at_rest(mut effects: Vec<Box<dyn Effect>>, period_s: f64) -> Vec<Box<dyn Effect>> {
    for effect in &mut effects {
        effect.set_step(period_s);
        effect.set_interval(period_s);
    }
    effects
}

/// Coriolis and gravity torque on each joint, c + h of eq. (5) [Nm].
fn load_nm(plant: &Plant, q_rad: &Joints, qd_rad_per_s: &Joints) -> Joints {
    let mut load_nm = Joints::default();
    plant.body.load(q_rad, qd_rad_per_s, &mut load_nm);
    load_nm
}
