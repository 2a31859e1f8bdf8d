//! The arm that the board believes it drives: eq. (8) with LuGre friction, in `f64`.

use model::vector::Vector3;
use model::{FrictionState, Robot};

use super::friction_law::FrictionLaw;
use super::plant::SimulatedPlant;
pub use super::settings::Settings;
use rig::Plant;
use rig::effects::Effect;

/// The three-joint robot in motion.
#[derive(Debug)]
pub struct SimulatedRobot {
    plant: SimulatedPlant,
    /// Joint angles and velocities on the motors' side [rad, rad/s].
    q_rad: Vector3<f64>,
    qd_rad_per_s: Vector3<f64>,
}

impl SimulatedRobot {
    /// A robot at rest, exactly as its model.
    pub fn at_rest(robot: Robot<f64>, q_rad: Vector3<f64>, settings: &Settings) -> Self {
        Self::with_effects(robot, Vec::new(), q_rad, settings)
    }

    /// A checked robot at rest that differs from its model by these effects.
    pub fn with_effects(
        robot: Robot<f64>,
        effects: Vec<Box<dyn Effect>>,
        q_rad: Vector3<f64>,
        settings: &Settings,
    ) -> Self {
        let plant = Plant::of_robot(&robot);
        let plant = SimulatedPlant::with_effects(plant, effects, &q_rad, settings);
        Self { plant, q_rad, qd_rad_per_s: [0.0; 3] }
    }

    /// The same robot with other laws of friction in place of LuGre's; effects scale them alike.
    pub fn with_friction_laws(mut self, laws: [Box<dyn FrictionLaw>; 3]) -> Self {
        self.plant.set_friction_laws(laws);
        self
    }

    /// Ends the robot and gives its laws of friction back, for the next log: at rest, but as
    /// warm as they are.
    pub fn into_friction_laws(self) -> [Box<dyn FrictionLaw>; 3] {
        let laws = self.plant.into_friction_laws().try_into();
        laws.expect("one law for each of three joints")
    }

    /// Puts the robot into motion where it is: velocities, accelerations and bristles.
    pub fn set_motion(
        &mut self,
        qd_rad_per_s: Vector3<f64>,
        qdd_rad_per_s2: Vector3<f64>,
        friction: [FrictionState<f64>; 3],
    ) {
        self.plant.set_motion(&qd_rad_per_s, &qdd_rad_per_s2, &friction);
        self.look();
    }

    /// Sets the time since the log began [s].
    pub fn set_time(&mut self, time_s: f64) {
        self.plant.set_time(time_s);
    }

    /// Gives effects with memory the commands of one sample period, the robot at rest.
    pub fn update_effects_at_rest(&mut self, command_v: &Vector3<f64>) {
        self.plant.update_effects_at_rest(command_v);
    }

    /// Joint angles on the motors' side [rad].
    pub fn q_rad(&self) -> &Vector3<f64> {
        &self.q_rad
    }

    /// Joint velocities on the motors' side [rad/s].
    pub fn qd_rad_per_s(&self) -> &Vector3<f64> {
        &self.qd_rad_per_s
    }

    /// The angles that the encoders read [rad].
    pub fn reading_rad(&self) -> Vector3<f64> {
        let mut reading = self.q_rad;
        self.plant.change_reading(&mut reading);
        reading
    }

    /// Lets the commanded voltages act for one sample period.
    pub fn advance(&mut self, command_v: &Vector3<f64>) {
        self.plant.advance(command_v);
        self.look();
    }

    fn look(&mut self) {
        self.q_rad.copy_from_slice(self.plant.q_rad());
        self.qd_rad_per_s.copy_from_slice(self.plant.qd_rad_per_s());
    }
}

#[cfg(test)]
mod tests;
