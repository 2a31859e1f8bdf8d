//! A rig as its board sees it: the model, the converter, the encoders, the gains.

use firmware::block::{MotorHeating, PositionLimits, SafetyLimits};
use firmware::reference::Reference;
use firmware::{Gains, Mode, ParameterBlock};
use model::{Posture, Robot};

use crate::compensation::Compensations;
use files::{FileError, RobotFile, RobotTable};

/// What is the same in all experiments of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// The model that the board works with.
    pub model: Robot<f64>,
    /// Encoder counts per turn.
    pub encoder_counts_per_turn: u32,
    /// Time from tick to tick [s].
    pub sample_period_s: f64,
    /// Largest command [V].
    pub command_limit_v: f64,
    /// Natural frequency of the PD loops [rad/s].
    pub loop_frequency_rad_per_s: f64,
    /// Bandwidth of the velocity estimates [rad/s].
    pub velocity_bandwidth_rad_per_s: f64,
    /// Lower and upper end of each joint's range [rad]; `None`: it may turn without end.
    pub limits_rad: [Option<[f64; 2]>; 3],
    /// What each motor bears; `None`: nobody has told.
    pub motor_heating: [Option<MotorHeating>; 3],
    /// What the board compensates for beyond the model.
    pub compensations: Compensations,
}

impl Rig {
    /// A rig with the paper's converter, encoders and sample period.
    ///
    /// Gains are those that a careful hand would set: loops of 5 Hz, damped to 0.7.
    pub fn new(model: Robot<f64>) -> Self {
        Self {
            model,
            encoder_counts_per_turn: 655_360,
            sample_period_s: 1e-3,
            command_limit_v: 10.0,
            loop_frequency_rad_per_s: 32.0,
            velocity_bandwidth_rad_per_s: 300.0,
            limits_rad: [None; 3],
            motor_heating: [None; 3],
            compensations: Compensations::default(),
        }
    }

    /// The rig that a model file describes; its `[[effect]]` tables are not looked at.
    ///
    /// # Errors
    /// The file lacks a part of the model.
    pub fn of_file(file: &RobotFile) -> Result<Self, FileError> {
        Ok(Self::with_settings(file.robot()?, file))
    }

    /// The rig of one joint that a `[pendulum]` file describes, as joint 3 of an arm whose
    /// others are there in name only.
    ///
    /// # Errors
    /// A parameter that is missing or that no pendulum can have, with its line.
    pub fn of_one_joint(file: &RobotFile) -> Result<Self, FileError> {
        const OTHERS_KG_M2: f64 = 1.0;
        Ok(Self::with_settings(file.as_third_joint(OTHERS_KG_M2)?, file))
    }

    fn with_settings(robot: Robot<f64>, file: &RobotFile) -> Self {
        let mut rig = Self::new(robot);
        let table = &file.robot;
        if let Some(counts) = table.encoder_counts_per_rev {
            rig.encoder_counts_per_turn = counts as u32;
        }
        rig.sample_period_s = table.sample_period_s.unwrap_or(rig.sample_period_s);
        if let Some(limits) = &table.limits_rad {
            rig.limits_rad = match limits[..] {
                [alone] => [None, None, Some(alone)],
                _ => [0, 1, 2].map(|i| limits.get(i).copied()),
            };
        }
        rig.motor_heating = motor_heating(table);
        rig.command_limit_v = table.command_limit_v.unwrap_or(rig.command_limit_v);
        rig
    }

    /// A parameter block: this rig with these modes and this reference.
    ///
    /// A payload that is compensated is in the base parameters, not in the gains.
    pub fn block(&self, mode: [Mode; 3], reference: Reference) -> ParameterBlock {
        let loaded = Robot { base: self.compensations.base(&self.model), ..self.model };
        ParameterBlock {
            robot: loaded.cast(),
            encoder_counts_per_turn: self.encoder_counts_per_turn,
            sample_period_s: self.sample_period_s as f32,
            gains: self.gains(),
            velocity_bandwidth_rad_per_s: [self.velocity_bandwidth_rad_per_s as f32; 3],
            command_limit_v: self.command_limit_v as f32,
            in_use: [true; 3],
            mode,
            reference,
            compensations: self.compensations.joints.clone(),
            external_load: self.compensations.outside(),
            safety: SafetyLimits {
                position: self.position_limits(),
                heating: self.motor_heating,
                ..Default::default()
            },
        }
    }

    /// The ranges as the board takes them.
    fn position_limits(&self) -> [Option<PositionLimits>; 3] {
        let braking = self.braking_rad_per_s2();
        [0, 1, 2].map(|i| {
            self.limits_rad[i].map(|[lower, upper]| PositionLimits {
                lower_rad: lower as f32,
                upper_rad: upper as f32,
                braking_rad_per_s2: braking[i] as f32,
            })
        })
    }

    /// What each joint can be decelerated with wherever the arm is [rad/s^2]: half of what is left
    /// of the command limit when the stretched arm is held against gravity.
    pub fn braking_rad_per_s2(&self) -> [f64; 3] {
        const SHARE: f64 = 0.5;
        const LEAST: f64 = 0.5;
        let stretched = Posture::new(0.0, 0.0);
        let (base, geometry) = (&self.model.base, &self.model.geometry);
        let inertia = stretched.mass_matrix(base, geometry);
        let gravity_v = self.model.torque_to_voltage(&stretched.gravity(base, geometry));
        [0, 1, 2].map(|i| {
            let left_v = self.command_limit_v - gravity_v[i].abs();
            let k_t = self.model.torque_constant_nm_per_v[i];
            (SHARE * left_v * k_t / inertia[i][i]).max(LEAST)
        })
    }

    /// The same rig, compensating for these effects.
    pub fn with_compensations(self, compensations: Compensations) -> Self {
        Self { compensations, ..self }
    }

    /// Gains of eq. (17) for the loop frequency, with the inertia of the stretched arm.
    pub fn gains(&self) -> [Gains; 3] {
        const DAMPING_RATIO: f64 = 0.7;
        let stretched = Posture::new(0.0, 0.0);
        let inertia = stretched.mass_matrix(&self.model.base, &self.model.geometry);
        [0, 1, 2].map(|i| {
            let unit_v = inertia[i][i] / self.model.torque_constant_nm_per_v[i];
            let frequency = self.loop_frequency_rad_per_s;
            Gains {
                proportional_v_per_rad: (unit_v * frequency * frequency) as f32,
                derivative_v_s_per_rad: (unit_v * 2.0 * DAMPING_RATIO * frequency) as f32,
            }
        })
    }
}

/// What each motor bears, where the file tells both figures.
fn motor_heating(table: &RobotTable) -> [Option<MotorHeating>; 3] {
    let of = |column: &Option<Vec<f64>>, i: usize| match column.as_deref()? {
        // A rig of one joint has it as joint 3.
        [alone] => (i == 2).then_some(*alone as f32),
        all => all.get(i).map(|value| *value as f32),
    };
    [0, 1, 2].map(|i| {
        let continuous_v = of(&table.motor_continuous_v, i)?;
        let time_constant_s = of(&table.motor_time_constant_s, i)?;
        Some(MotorHeating { continuous_v, time_constant_s })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::reference_robot::reference_robot;

    #[test]
    fn what_motors_bear_comes_from_the_file_where_it_has_both_figures() {
        let mut file = RobotFile::from_robot(&reference_robot());
        assert_eq!(Rig::of_file(&file).unwrap().motor_heating, [None; 3]);
        file.robot.motor_continuous_v = Some(vec![3.0, 3.0, 2.0]);
        file.robot.motor_time_constant_s = Some(vec![60.0, 60.0, 30.0]);
        let heating = Rig::of_file(&file).unwrap().motor_heating;
        assert_eq!(heating[2], Some(MotorHeating { continuous_v: 2.0, time_constant_s: 30.0 }));
    }
}
