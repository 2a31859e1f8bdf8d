//! What stands between a motor and its link: a spring and a damper, perhaps with backlash.

/// A spring and damper that act once the gap is closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission {
    /// Gap from one stop to the other [rad]; 0 for none.
    pub gap_rad: f64,
    /// Stiffness [Nm/rad].
    pub stiffness_nm_per_rad: f64,
    /// Damping while in contact [Nm s/rad].
    pub damping_nm_s_per_rad: f64,
    /// The motor's part of the joint's own inertia [kg m^2].
    pub motor_inertia_kg_m2: f64,
}

impl Transmission {
    /// Torque on the link when the motor is ahead by so much [Nm].
    pub fn torque_nm(&self, ahead_rad: f64, ahead_rad_per_s: f64) -> f64 {
        let beyond_rad = (ahead_rad.abs() - 0.5 * self.gap_rad).max(0.0);
        if beyond_rad == 0.0 && self.gap_rad > 0.0 {
            return 0.0;
        }
        self.stiffness_nm_per_rad * beyond_rad.copysign(ahead_rad)
            + self.damping_nm_s_per_rad * ahead_rad_per_s
    }

    /// How far the motor is ahead of the link when it holds a torque at rest [rad].
    pub fn hold(&self, torque_nm: f64) -> f64 {
        let bent_rad = torque_nm / self.stiffness_nm_per_rad;
        bent_rad + (0.5 * self.gap_rad).copysign(torque_nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPRING: Transmission = Transmission {
        gap_rad: 0.0,
        stiffness_nm_per_rad: 100.0,
        damping_nm_s_per_rad: 1.0,
        motor_inertia_kg_m2: 0.01,
    };

    #[test]
    fn a_spring_pulls_both_ways() {
        assert_eq!(SPRING.torque_nm(0.01, 0.0), 1.0);
        assert_eq!(SPRING.torque_nm(-0.01, 0.5), -0.5);
    }

    #[test]
    fn within_the_gap_nothing_is_passed_on() {
        let loose = Transmission { gap_rad: 0.02, ..SPRING };
        assert_eq!(loose.torque_nm(0.0099, 3.0), 0.0);
        assert!((loose.torque_nm(0.02, 0.0) - 1.0).abs() < 1e-12);
        assert!((loose.torque_nm(-0.02, 0.0) + 1.0).abs() < 1e-12);
    }
}
