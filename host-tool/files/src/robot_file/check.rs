//! What a robot or model file must be beyond its syntax.

use super::RobotFile;
use crate::error::{FileError, Problem};

/// No joint has a range beyond [rad].
const FURTHEST_RAD: f64 = 1000.0;

impl RobotFile {
    /// Checks joint numbers and that tables agree with one another.
    pub(super) fn check(&self) -> Result<(), FileError> {
        self.check_ranges()?;
        self.check_torque_constants()?;
        self.check_limits()?;
        self.check_motors()?;
        self.check_pendulum()?;
        self.check_friction()?;
        self.check_effects()
    }

    fn check_torque_constants(&self) -> Result<(), FileError> {
        let found = self.robot.torque_constant_nm_per_v.len();
        if found == 3 || (found == 1 && self.pendulum.is_some()) {
            return Ok(());
        }
        let what = format!(
            "torque_constant_Nm_per_V has {found} values, but must have 3, \
             or 1 with a [pendulum]"
        );
        let problem = Problem::Contradiction(what);
        Err(self.source.problem_in(problem, "robot", None, "torque_constant_Nm_per_V"))
    }

    /// One range a joint, each from the lower to the upper end.
    fn check_limits(&self) -> Result<(), FileError> {
        let Some(limits) = &self.robot.limits_rad else { return Ok(()) };
        let is_whole = limits.len() == 3 || (limits.len() == 1 && self.pendulum.is_some());
        let is_range = |[lower, upper]: &[f64; 2]| {
            lower < upper && lower.abs() <= FURTHEST_RAD && upper.abs() <= FURTHEST_RAD
        };
        let what = match limits.iter().position(|range| !is_range(range)) {
            _ if !is_whole => format!(
                "limits_rad has {} pairs, but must have 3, or 1 with a [pendulum]",
                limits.len()
            ),
            Some(index) => format!(
                "limits_rad of joint {} is {:?}, but must be [lower, upper], at most 1000 rad",
                index + 1,
                limits[index]
            ),
            None => return Ok(()),
        };
        Err(self.source.problem_in(Problem::Contradiction(what), "robot", None, "limits_rad"))
    }

    /// Two figures a motor, or none.
    fn check_motors(&self) -> Result<(), FileError> {
        let (continuous, warming) =
            (&self.robot.motor_continuous_v, &self.robot.motor_time_constant_s);
        let expected = self.robot.torque_constant_nm_per_v.len();
        let names = ["motor_continuous_V", "motor_time_constant_s"];
        for (column, name) in [continuous, warming].into_iter().zip(names) {
            let what = match column {
                None if continuous.is_none() == warming.is_none() => continue,
                Some(values) if values.len() == expected && values.iter().all(|v| *v > 0.0) => {
                    continue;
                }
                None => format!("{name} is missing: {} and {} belong together", names[0], names[1]),
                Some(_) => format!("{name} must have {expected} values above 0, one a motor"),
            };
            return Err(self.source.problem_in(Problem::Contradiction(what), "robot", None, name));
        }
        Ok(())
    }

    fn check_pendulum(&self) -> Result<(), FileError> {
        match &self.pendulum {
            Some(pendulum) if !(1..=3).contains(&pendulum.joint) => {
                let problem = not_a_joint("pendulum", pendulum.joint, "1, 2 or 3");
                Err(self.source.problem_in(problem, "pendulum", None, "joint"))
            }
            _ => Ok(()),
        }
    }

    fn check_friction(&self) -> Result<(), FileError> {
        let joints: Vec<u8> = self.friction.iter().map(|friction| friction.joint).collect();
        for (index, &joint) in joints.iter().enumerate() {
            let problem = if !(1..=3).contains(&joint) {
                not_a_joint("friction", joint, "1, 2 or 3")
            } else if joints[..index].contains(&joint) {
                Problem::Contradiction(format!("joint {joint} has two [[friction]] tables"))
            } else {
                continue;
            };
            return Err(self.source.problem_in_nth(problem, "friction", index));
        }
        Ok(())
    }

    fn check_effects(&self) -> Result<(), FileError> {
        match self.effects.iter().position(|effect| effect.joint > 3) {
            None => Ok(()),
            Some(index) => {
                let problem = not_a_joint("effect", self.effects[index].joint, "0, 1, 2 or 3");
                Err(self.source.problem_in_nth(problem, "effect", index))
            }
        }
    }
}

fn not_a_joint(table: &str, joint: u8, must: &str) -> Problem {
    Problem::Contradiction(format!("joint of the {table} is {joint}, but must be {must}"))
}
