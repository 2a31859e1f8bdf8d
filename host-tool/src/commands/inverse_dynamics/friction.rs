//! Friction of a joint in steady motion, in the unit of its command: eq. (10), and what effects of the model add.

use files::{ArmJoint, EffectTable, FrictionTable};
use model::Friction;
use model::effects::quadratic_drag_v;

/// A gear that took all of its motor's torque would not turn.
const MOST_TAKEN: f64 = 0.95;

/// Friction of a joint.
#[derive(Clone, Debug)]
pub struct SteadyFriction {
    /// Eq. (10).
    pub law: Friction<f64>,
    /// Effect `load_friction`: growth with the load [unit of the command by Nm; by N].
    growth: f64,
    /// The same by the motor's torque.
    growth_by_motor: f64,
    /// Effect `quadratic_drag`: growth with the square of the velocity.
    drag: f64,
}

impl SteadyFriction {
    /// That of eq. (10) alone.
    pub fn of(law: Friction<f64>) -> Self {
        Self { law, growth: 0.0, growth_by_motor: 0.0, drag: 0.0 }
    }

    /// Takes an effect of its joint; whether it is one of friction.
    pub fn add(&mut self, effect: &EffectTable) -> bool {
        let number =
            |value: &toml::Value| value.as_float().or(value.as_integer().map(|whole| whole as f64));
        let value = |name: &str| effect.parameters.get(name).and_then(number);
        let by_motor = value("by_motor_torque").is_some_and(|choice| choice >= 0.5);
        let (part, name) = match effect.effect.as_str() {
            "load_friction" if by_motor => (&mut self.growth_by_motor, "coefficient_V_per_Nm"),
            "load_friction" => (&mut self.growth, "coefficient_V_per_Nm"),
            "quadratic_drag" => (&mut self.drag, "coefficient_V_s2_per_rad2"),
            _ => return false,
        };
        let found = value(name);
        *part += found.unwrap_or_default();
        found.is_some()
    }

    /// At a velocity [rad/s; m/s] and a load, Coriolis and gravity torques [Nm; N], where the rigid body needs a
    /// `torque` [Nm; N] of a motor of this torque `constant`; at rest none.
    pub fn at(&self, velocity: f64, load: f64, torque: f64, constant: f64) -> f64 {
        if velocity == 0.0 {
            return 0.0;
        }
        let grown = self.growth * load.abs() * velocity.signum();
        let friction = self.law.sliding(velocity) + grown - quadratic_drag_v(self.drag, velocity);
        // u = torque / constant + friction + s |u| sgn(v), solved for the command u.
        let taken = (self.growth_by_motor * constant).min(MOST_TAKEN) * velocity.signum();
        let without = torque / constant + friction;
        friction + taken * (without / (1.0 - taken * without.signum())).abs()
    }
}

/// The friction of a table of format 1; bristles do not matter in steady motion.
pub fn of_table(table: &FrictionTable) -> Friction<f64> {
    Friction {
        alpha0_v: table.alpha0_v,
        alpha1_v: table.alpha1_v,
        stribeck_velocity_rad_per_s: table.stribeck_velocity_rad_per_s,
        alpha2_v_s_per_rad: table.alpha2_v_s_per_rad,
        sigma0_v_per_rad: 1.0,
        sigma1_v_s_per_rad: 0.0,
    }
}

/// That of a joint of format 2; what its file does not tell is none.
pub fn of_joint(joint: &ArmJoint) -> Option<Friction<f64>> {
    let friction = joint.friction?;
    Some(Friction {
        alpha0_v: friction.alpha0.unwrap_or(0.0),
        alpha1_v: friction.alpha1.filter(|_| friction.stribeck_velocity.is_some()).unwrap_or(0.0),
        stribeck_velocity_rad_per_s: friction.stribeck_velocity.unwrap_or(1.0),
        alpha2_v_s_per_rad: friction.alpha2.unwrap_or(0.0),
        sigma0_v_per_rad: 1.0,
        sigma1_v_s_per_rad: 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gear_takes_a_part_of_the_command_that_drives_it_and_helps_where_that_brakes() {
        let law = Friction { alpha0_v: 0.2, ..of_table(&FrictionTable::default()) };
        let mut friction = SteadyFriction::of(Friction { alpha2_v_s_per_rad: 0.0, ..law });
        friction.growth_by_motor = 0.03;
        for (velocity, torque) in [(1.0, 4.0), (-1.0, 4.0), (1.0, -4.0), (-1.0, 0.1)] {
            let found = friction.at(velocity, 0.0, torque, 2.0);
            let command = torque / 2.0 + found;
            let wanted = friction.law.sliding(velocity) + 0.06 * command.abs() * velocity.signum();
            assert!((found - wanted).abs() < 1e-12, "{found} rather than {wanted}");
        }
    }
}
