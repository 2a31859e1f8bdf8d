//! Any rig in motion, as its drives and encoders see it, in `f64`.

use model::FrictionState;
use model::chain::MAX_JOINTS;
use model::friction::FrictionScale;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::friction_law::{FrictionLaw, LuGre};
use super::leapfrog::Motion;
use super::settings::Settings;
use rig::Plant;
use rig::effects::{Effect, JointState, Transmission};
use rig::plant::Body;

/// One value per joint.
type Joints = [f64; MAX_JOINTS];

/// A plant in motion.
///
/// Integrated by the midpoint leapfrog: positions half a step, velocities a whole
/// one with forces in the middle, positions the other half; one evaluation of the
/// dynamics a step, second order; ten steps a tick err by 1.4e-6 rad over a second of
/// sliding and reversing, a seventh of an encoder count. Friction takes its exact step at the middle
/// velocity, so its relaxation at up to 51,000 1/s asks for no smaller step.
#[derive(Debug)]
pub struct SimulatedPlant {
    /// The plant that effects have changed, motors of elastic joints included.
    plant: Plant,
    /// What moves with the links.
    links: Body,
    transmissions: Vec<Option<Transmission>>,
    /// Dry friction between motors and links [Nm].
    rubbing_nm: Vec<f64>,
    effects: Vec<Box<dyn Effect>>,
    step_s: f64,
    substeps: u32,
    noise_v: f64,
    random: Pcg64Mcg,
    time_s: f64,
    link: Motion,
    /// The side of the encoders and of friction; the links' where the joint is stiff.
    motor: Motion,
    friction: Vec<Box<dyn FrictionLaw>>,
}

impl SimulatedPlant {
    /// A checked plant at rest that differs from its model by these effects.
    pub fn with_effects(
        mut plant: Plant,
        mut effects: Vec<Box<dyn Effect>>,
        q_rad: &[f64],
        settings: &Settings,
    ) -> Self {
        let step_s = settings.sample_period_s / f64::from(settings.substeps);
        for effect in &mut effects {
            effect.change_robot(&mut plant);
            effect.set_step(step_s);
            effect.set_gears(&plant.gears);
        }
        let mut links = plant.body.clone();
        let mut transmissions = vec![None; plant.joints()];
        for (joint, transmission) in effects.iter().filter_map(|effect| effect.transmission()) {
            links.remove_motor(joint, transmission.motor_inertia_kg_m2);
            transmissions[joint] = Some(transmission);
        }
        let mut rubbing_nm = vec![0.0; plant.joints()];
        for (joint, level_nm) in effects.iter().filter_map(|e| e.transmission_friction_nm()) {
            rubbing_nm[joint] += level_nm;
        }
        Self {
            links,
            transmissions,
            rubbing_nm,
            effects,
            step_s,
            substeps: settings.substeps,
            noise_v: settings.noise_v,
            random: Pcg64Mcg::new(u128::from(settings.seed) << 1 | 1),
            time_s: 0.0,
            link: Motion::at_rest(q_rad),
            motor: Motion::at_rest(q_rad),
            friction: plant.friction.iter().map(|law| Box::new(LuGre::new(*law)) as _).collect(),
            plant,
        }
    }

    /// Replaces LuGre's law of friction, joint by joint; effects scale others alike.
    pub fn set_friction_laws(&mut self, laws: impl IntoIterator<Item = Box<dyn FrictionLaw>>) {
        self.friction = laws.into_iter().collect();
    }

    /// Ends the motion and gives its laws of friction back, for the next log: at rest, but as
    /// warm as they are.
    pub fn into_friction_laws(self) -> Vec<Box<dyn FrictionLaw>> {
        let mut laws = self.friction;
        laws.iter_mut().for_each(|law| law.rest());
        laws
    }

    /// Puts the joints into motion where they are: velocities, accelerations and bristles.
    pub fn set_motion(&mut self, qd: &[f64], qdd: &[f64], friction: &[FrictionState<f64>]) {
        let count = self.friction.len();
        for side in [&mut self.link, &mut self.motor] {
            side.qd_rad_per_s.copy_from_slice(&qd[..count]);
            side.qdd_rad_per_s2.copy_from_slice(&qdd[..count]);
        }
        for (law, state) in self.friction.iter_mut().zip(friction) {
            law.set_bristles(*state);
        }
    }

    /// Sets the time since the log began [s].
    pub fn set_time(&mut self, time_s: f64) {
        self.time_s = time_s;
    }

    /// Gives effects with memory the commands of one sample period, the joints at rest.
    pub fn update_effects_at_rest(&mut self, command_v: &[f64]) {
        let rest = [0.0; MAX_JOINTS];
        for _ in 0..self.substeps {
            let mut driving_v = Joints::default();
            let driving_v = &mut driving_v[..command_v.len()];
            driving_v.copy_from_slice(command_v);
            let load_nm = self.load_nm(&rest);
            let motor_nm = self.motor_nm(command_v);
            let state = joint_state(self.time_s, [&self.motor.q_rad, &rest, &load_nm, &motor_nm]);
            for effect in &mut self.effects {
                effect.change_command(&state, driving_v);
            }
        }
    }

    /// Joint angles on the motors' side [rad].
    pub fn q_rad(&self) -> &[f64] {
        &self.motor.q_rad
    }

    /// Joint velocities on the motors' side [rad/s].
    pub fn qd_rad_per_s(&self) -> &[f64] {
        &self.motor.qd_rad_per_s
    }

    /// Joint velocities on the links' side [rad/s].
    pub fn link_qd_rad_per_s(&self) -> &[f64] {
        &self.link.qd_rad_per_s
    }

    /// The angles that the encoders read [rad].
    pub fn reading_rad(&self) -> Vec<f64> {
        let mut reading = self.motor.q_rad.clone();
        self.change_reading(&mut reading);
        reading
    }

    /// What the encoders make of angles [rad].
    pub(super) fn change_reading(&self, angles_rad: &mut [f64]) {
        for effect in &self.effects {
            effect.change_reading(angles_rad);
        }
    }

    /// Lets the commanded voltages act for one sample period.
    pub fn advance(&mut self, command_v: &[f64]) {
        let mut noisy_v = Joints::default();
        let noisy_v = &mut noisy_v[..command_v.len()];
        for (noisy_v, command_v) in noisy_v.iter_mut().zip(command_v) {
            *noisy_v = command_v + self.noise_sample();
        }
        for _ in 0..self.substeps {
            self.substep(noisy_v);
        }
    }

    fn noise_sample(&mut self) -> f64 {
        let deviate: f64 = StandardNormal.sample(&mut self.random);
        self.noise_v * deviate
    }

    fn substep(&mut self, voltage_v: &[f64]) {
        let half_s = 0.5 * self.step_s;
        let count = voltage_v.len();
        let (mut link_qd, mut motor_qd) = (Joints::default(), Joints::default());
        self.link.drift_to_midpoint(half_s, &mut link_qd[..count]);
        let elastic = self.transmissions.iter().any(Option::is_some);
        if elastic {
            self.motor.drift_to_midpoint(half_s, &mut motor_qd[..count]);
        } else {
            self.motor.copy_from(&self.link);
            motor_qd = link_qd;
        }
        let (link_qd, motor_qd) = (&link_qd[..count], &motor_qd[..count]);
        let mut torque_nm = Joints::default();
        let torque_nm = &mut torque_nm[..count];
        self.motor_torque(voltage_v, motor_qd, torque_nm);
        if elastic {
            self.advance_elastic(torque_nm, link_qd, motor_qd);
        } else {
            let mut qdd = Joints::default();
            self.links.forward_dynamics(&self.link.q_rad, link_qd, torque_nm, &mut qdd[..count]);
            self.link.kick_and_drift(&qdd[..count], half_s);
            self.motor.copy_from(&self.link);
        }
        self.time_s += self.step_s;
    }

    /// Torques of the motors less friction [Nm], in the middle of a step.
    fn motor_torque(&mut self, voltage_v: &[f64], qd: &[f64], torque_nm: &mut [f64]) {
        let count = voltage_v.len();
        let mut scale = [FrictionScale::unchanged(); MAX_JOINTS];
        let mut driving_v = Joints::default();
        let driving_v = &mut driving_v[..count];
        driving_v.copy_from_slice(voltage_v);
        let has_effects = !self.effects.is_empty();
        let load_nm = if has_effects { self.load_nm(qd) } else { Joints::default() };
        let (q_rad, motor_nm) = (&self.motor.q_rad, self.motor_nm(voltage_v));
        let state = joint_state(self.time_s, [q_rad, qd, &load_nm, &motor_nm]);
        for effect in &mut self.effects {
            effect.change_command(&state, driving_v);
            effect.change_friction(&state, &mut scale[..count]);
        }
        for effect in &self.effects {
            effect.add_voltage(&state, driving_v);
        }
        let k_t = &self.plant.torque_constant_nm_per_v;
        for i in 0..count {
            let friction_v = self.friction[i].step(scale[i], qd[i], self.step_s);
            torque_nm[i] = (driving_v[i] - friction_v) * k_t[i];
        }
        for effect in &self.effects {
            effect.add_torque(&state, &self.plant, torque_nm);
        }
    }

    /// Coriolis and gravity torque [Nm].
    fn load_nm(&self, qd_rad_per_s: &[f64]) -> Joints {
        let mut load_nm = Joints::default();
        if self.effects.iter().any(|effect| effect.feels_load()) {
            self.plant.body.load(&self.motor.q_rad, qd_rad_per_s, &mut load_nm);
        }
        load_nm
    }

    /// Torques that the motors make of what they are sent [Nm].
    fn motor_nm(&self, voltage_v: &[f64]) -> Joints {
        let mut motor_nm = Joints::default();
        let sent = voltage_v.iter().zip(&self.plant.torque_constant_nm_per_v);
        motor_nm.iter_mut().zip(sent).for_each(|(torque, (voltage, k_t))| *torque = voltage * k_t);
        motor_nm
    }

    /// Dry friction that the motor passes on to the link as it moves past it [Nm].
    ///
    /// Its jump is a slope of 20 mrad/s, or as wide as the step needs to stay stable.
    fn rubbing(&self, joint: usize, transmission: &Transmission, ahead_rad_per_s: f64) -> f64 {
        const WIDTH_RAD_PER_S: f64 = 0.02;
        let level_nm = self.rubbing_nm[joint];
        let stable = 2.0 * level_nm * self.step_s / transmission.motor_inertia_kg_m2;
        level_nm * (ahead_rad_per_s / stable.max(WIDTH_RAD_PER_S)).tanh()
    }

    /// Ends a step in which some motors move apart from their links.
    fn advance_elastic(&mut self, motor_torque_nm: &[f64], link_qd: &[f64], motor_qd: &[f64]) {
        let (half_s, count) = (0.5 * self.step_s, motor_torque_nm.len());
        let (mut passed_nm, mut motor_qdd) = (Joints::default(), Joints::default());
        passed_nm[..count].copy_from_slice(motor_torque_nm);
        for i in 0..count {
            let Some(transmission) = &self.transmissions[i] else { continue };
            let ahead_rad = self.motor.q_rad[i] - self.link.q_rad[i];
            let ahead_rad_per_s = motor_qd[i] - link_qd[i];
            passed_nm[i] = transmission.torque_nm(ahead_rad, ahead_rad_per_s);
            if self.rubbing_nm[i] != 0.0 {
                passed_nm[i] += self.rubbing(i, transmission, ahead_rad_per_s);
            }
            motor_qdd[i] = (motor_torque_nm[i] - passed_nm[i]) / transmission.motor_inertia_kg_m2;
        }
        let mut link_qdd = Joints::default();
        let (q_rad, link_qdd) = (&self.link.q_rad, &mut link_qdd[..count]);
        self.links.forward_dynamics(q_rad, link_qd, &passed_nm[..count], link_qdd);
        self.link.kick_and_drift(link_qdd, half_s);
        self.motor.kick_and_drift(&motor_qdd[..count], half_s);
        for i in (0..count).filter(|&i| self.transmissions[i].is_none()) {
            self.motor.q_rad[i] = self.link.q_rad[i];
            self.motor.qd_rad_per_s[i] = self.link.qd_rad_per_s[i];
            self.motor.qdd_rad_per_s2[i] = self.link.qdd_rad_per_s2[i];
        }
    }
}

/// The joints at an instant, as effects see them: angles, velocities, loads, torques of the motors.
fn joint_state<'a>(time_s: f64, [q, qd, load, motor]: [&'a [f64]; 4]) -> JointState<'a> {
    let of_joints = |values: &'a [f64]| &values[..q.len()];
    JointState {
        time_s,
        q_rad: q,
        qd_rad_per_s: of_joints(qd),
        load_nm: of_joints(load),
        motor_nm: of_joints(motor),
    }
}
