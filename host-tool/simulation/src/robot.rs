//! The arm that the board believes it drives: eq. (8) with LuGre friction, in `f64`.

use model::friction::FrictionScale;
use model::vector::Vector3;
use model::{FrictionState, Posture, Robot};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::friction_law::{FrictionLaw, LuGre};
use super::leapfrog::Motion;
pub use super::settings::Settings;
use rig::effects::{Effect, JointState, Transmission};

/// A robot in motion.
///
/// Integrated by the midpoint leapfrog: positions half a step, velocities a whole
/// one with forces in the middle, positions the other half; one evaluation of the
/// dynamics a step, second order; ten steps a tick err by 1.4e-6 rad over a second of
/// sliding and reversing, a seventh of an encoder count. Friction takes its exact step at the middle
/// velocity, so its relaxation at up to 51,000 1/s asks for no smaller step.
#[derive(Debug)]
pub struct SimulatedRobot {
    /// The robot that effects have changed, motors of elastic joints included.
    robot: Robot<f64>,
    /// What moves with the links.
    links: Robot<f64>,
    transmissions: [Option<Transmission>; 3],
    /// Dry friction between motors and links [Nm].
    rubbing_nm: Vector3<f64>,
    effects: Vec<Box<dyn Effect>>,
    step_s: f64,
    substeps: u32,
    noise_v: f64,
    random: Pcg64Mcg,
    time_s: f64,
    link: Motion,
    /// The side of the encoders and of friction; the links' where the joint is stiff.
    motor: Motion,
    friction: [Box<dyn FrictionLaw>; 3],
}

impl SimulatedRobot {
    /// A robot at rest, exactly as its model.
    pub fn at_rest(robot: Robot<f64>, q_rad: Vector3<f64>, settings: &Settings) -> Self {
        Self::with_effects(robot, Vec::new(), q_rad, settings)
    }

    /// A checked robot at rest that differs from its model by these effects.
    pub fn with_effects(
        mut robot: Robot<f64>,
        mut effects: Vec<Box<dyn Effect>>,
        q_rad: Vector3<f64>,
        settings: &Settings,
    ) -> Self {
        let step_s = settings.sample_period_s / f64::from(settings.substeps);
        for effect in &mut effects {
            effect.change_robot(&mut robot);
            effect.set_step(step_s);
        }
        let mut links = robot;
        let mut transmissions = [None; 3];
        for (joint, transmission) in effects.iter().filter_map(|effect| effect.transmission()) {
            links = transmission.without_motor(joint, &links);
            transmissions[joint] = Some(transmission);
        }
        let mut rubbing_nm = [0.0; 3];
        for (joint, level_nm) in effects.iter().filter_map(|e| e.transmission_friction_nm()) {
            rubbing_nm[joint] += level_nm;
        }
        Self {
            robot,
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
            friction: robot.friction.map(|friction| Box::new(LuGre::new(friction)) as _),
        }
    }

    /// The same robot with other laws of friction in place of LuGre's; effects scale them alike.
    pub fn with_friction_laws(mut self, laws: [Box<dyn FrictionLaw>; 3]) -> Self {
        self.friction = laws;
        self
    }

    /// Ends the robot and gives its laws of friction back, for the next log: at rest, but as
    /// warm as they are.
    pub fn into_friction_laws(self) -> [Box<dyn FrictionLaw>; 3] {
        let mut laws = self.friction;
        laws.iter_mut().for_each(|law| law.rest());
        laws
    }

    /// Puts the robot into motion where it is: velocities, accelerations and bristles.
    pub fn set_motion(
        &mut self,
        qd_rad_per_s: Vector3<f64>,
        qdd_rad_per_s2: Vector3<f64>,
        friction: [FrictionState<f64>; 3],
    ) {
        for side in [&mut self.link, &mut self.motor] {
            side.qd_rad_per_s = qd_rad_per_s;
            side.qdd_rad_per_s2 = qdd_rad_per_s2;
        }
        for (law, state) in self.friction.iter_mut().zip(friction) {
            law.set_bristles(state);
        }
    }

    /// Sets the time since the log began [s].
    pub fn set_time(&mut self, time_s: f64) {
        self.time_s = time_s;
    }

    /// Gives effects with memory the commands of one sample period, the robot at rest.
    pub fn update_effects_at_rest(&mut self, command_v: &Vector3<f64>) {
        for _ in 0..self.substeps {
            let joint_state = self.joint_state(&[0.0; 3]);
            let mut driving_v = *command_v;
            for effect in &mut self.effects {
                effect.change_command(&joint_state, &mut driving_v);
            }
        }
    }

    /// Joint angles on the motors' side [rad].
    pub fn q_rad(&self) -> &Vector3<f64> {
        &self.motor.q_rad
    }

    /// Joint velocities on the motors' side [rad/s].
    pub fn qd_rad_per_s(&self) -> &Vector3<f64> {
        &self.motor.qd_rad_per_s
    }

    /// The angles that the encoders read [rad].
    pub fn reading_rad(&self) -> Vector3<f64> {
        let mut reading = self.motor.q_rad;
        for effect in &self.effects {
            effect.change_reading(&mut reading);
        }
        reading
    }

    /// Lets the commanded voltages act for one sample period.
    pub fn advance(&mut self, command_v: &Vector3<f64>) {
        let noisy_v = command_v.map(|u| u + self.noise_sample());
        for _ in 0..self.substeps {
            self.substep(&noisy_v);
        }
    }

    fn noise_sample(&mut self) -> f64 {
        let deviate: f64 = StandardNormal.sample(&mut self.random);
        self.noise_v * deviate
    }

    fn substep(&mut self, voltage_v: &Vector3<f64>) {
        let half_s = 0.5 * self.step_s;
        let link_qd = self.link.drift_to_midpoint(half_s);
        let elastic = self.transmissions.iter().any(Option::is_some);
        if !elastic {
            self.motor = self.link;
        }
        let motor_qd = if elastic { self.motor.drift_to_midpoint(half_s) } else { link_qd };
        let torque_nm = self.motor_torque(voltage_v, &motor_qd);
        if elastic {
            self.advance_elastic(&torque_nm, &link_qd, &motor_qd);
        } else {
            let qdd = self.link_acceleration(&link_qd, &torque_nm);
            self.link.kick_and_drift(qdd, half_s);
            self.motor = self.link;
        }
        self.time_s += self.step_s;
    }

    /// Torques of the motors less friction [Nm], in the middle of a step.
    fn motor_torque(&mut self, voltage_v: &Vector3<f64>, qd: &Vector3<f64>) -> Vector3<f64> {
        let mut scale = [FrictionScale::unchanged(); 3];
        let mut driving_v = *voltage_v;
        if !self.effects.is_empty() {
            let joint_state = self.joint_state(qd);
            for effect in &mut self.effects {
                effect.change_command(&joint_state, &mut driving_v);
                effect.change_friction(&joint_state, &mut scale);
            }
            for effect in &self.effects {
                effect.add_voltage(&joint_state, &mut driving_v);
            }
        }
        let friction = &mut self.friction;
        let net_v =
            [0, 1, 2].map(|i| driving_v[i] - friction[i].step(scale[i], qd[i], self.step_s));
        let mut torque_nm = self.robot.voltage_to_torque(&net_v);
        if !self.effects.is_empty() {
            let joint_state = self.joint_state(qd);
            for effect in &self.effects {
                effect.add_torque(&joint_state, &self.robot, &mut torque_nm);
            }
        }
        torque_nm
    }

    fn joint_state(&self, qd_rad_per_s: &Vector3<f64>) -> JointState {
        let q_rad = self.motor.q_rad;
        let posture = Posture::new(q_rad[1], q_rad[2]);
        let Robot { base, geometry, .. } = &self.robot;
        let coriolis = posture.coriolis(base, geometry, qd_rad_per_s);
        let gravity = posture.gravity(base, geometry);
        JointState {
            time_s: self.time_s,
            q_rad,
            qd_rad_per_s: *qd_rad_per_s,
            load_nm: [0, 1, 2].map(|i| coriolis[i] + gravity[i]),
        }
    }

    fn link_acceleration(&self, qd: &Vector3<f64>, torque_nm: &Vector3<f64>) -> Vector3<f64> {
        let q_rad = &self.link.q_rad;
        let Robot { base, geometry, .. } = &self.links;
        Posture::new(q_rad[1], q_rad[2]).forward_dynamics(base, geometry, qd, torque_nm)
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
    fn advance_elastic(
        &mut self,
        motor_torque_nm: &Vector3<f64>,
        link_qd: &Vector3<f64>,
        motor_qd: &Vector3<f64>,
    ) {
        let half_s = 0.5 * self.step_s;
        let mut passed_nm = *motor_torque_nm;
        let mut motor_qdd = [0.0; 3];
        for i in 0..3 {
            let Some(transmission) = &self.transmissions[i] else { continue };
            let ahead_rad = self.motor.q_rad[i] - self.link.q_rad[i];
            let ahead_rad_per_s = motor_qd[i] - link_qd[i];
            passed_nm[i] = transmission.torque_nm(ahead_rad, ahead_rad_per_s);
            if self.rubbing_nm[i] != 0.0 {
                passed_nm[i] += self.rubbing(i, transmission, ahead_rad_per_s);
            }
            motor_qdd[i] = (motor_torque_nm[i] - passed_nm[i]) / transmission.motor_inertia_kg_m2;
        }
        let link_qdd = self.link_acceleration(link_qd, &passed_nm);
        self.link.kick_and_drift(link_qdd, half_s);
        self.motor.kick_and_drift(motor_qdd, half_s);
        for i in (0..3).filter(|&i| self.transmissions[i].is_none()) {
            self.motor.q_rad[i] = self.link.q_rad[i];
            self.motor.qd_rad_per_s[i] = self.link.qd_rad_per_s[i];
            self.motor.qdd_rad_per_s2[i] = self.link.qdd_rad_per_s2[i];
        }
    }
}

#[cfg(test)]
mod tests;
