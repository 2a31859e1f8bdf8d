//! Whether a reference stays in the joints' ranges, found before it is played.

use firmware::ParameterBlock;
use firmware::reference::{BRAKING_S, Time, braking_distance_rad};

/// No reference is looked at for longer [s]; `rrr run` plays none that is.
const LONGEST_S: f32 = 3600.0;

/// A reference that the board would brake, since its joint comes too near the end of its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaving {
    /// The joint, 1 to 3.
    pub joint: u8,
    /// When [s].
    pub time_s: f32,
    /// Where the joint would be at rest if it were braked then [rad].
    pub rest_rad: f32,
    /// The end of the range [rad].
    pub end_rad: f32,
}

impl std::fmt::Display for Leaving {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { joint, time_s, rest_rad, end_rad } = self;
        write!(
            f,
            "joint {joint} leaves its range at {time_s:.3} s of the reference: braked then, it comes \
             to rest at {rest_rad:.3} rad, beyond {end_rad:.3} rad"
        )
    }
}

/// The first moment at which a joint's reference leaves its range.
pub fn leaving(block: &ParameterBlock) -> Option<Leaving> {
    let each = (1..=3).filter_map(|joint| leaving_of(block, joint));
    each.min_by(|one, other| one.time_s.total_cmp(&other.time_s))
}

fn leaving_of(block: &ParameterBlock, joint: u8) -> Option<Leaving> {
    let index = usize::from(joint) - 1;
    let range = block.safety.position[index]?;
    let (motion, period_s) = (&block.reference.motion[index], block.sample_period_s);
    let ticks = (block.reference.duration_s.min(LONGEST_S) / period_s).round() as u32;
    (0..=ticks).find_map(|tick| {
        let setpoint = motion.at(Time::new(tick, period_s, 1.0 / period_s));
        let velocity = setpoint.velocity_rad_per_s;
        // At its end a reference brakes by itself, whatever the range.
        let distance_rad = match tick == ticks {
            true => velocity.abs() * BRAKING_S / 3.0,
            false => braking_distance_rad(velocity, range.braking_rad_per_s2),
        };
        let (lowest, highest) = match velocity {
            v if v > 0.0 => (0.0, distance_rad),
            v if v < 0.0 => (distance_rad, 0.0),
            _ => (0.0, 0.0),
        };
        let (low_rad, high_rad) = (setpoint.position_rad - lowest, setpoint.position_rad + highest);
        let (rest_rad, end_rad) = match () {
            () if high_rad > range.upper_rad => (high_rad, range.upper_rad),
            () if low_rad < range.lower_rad => (low_rad, range.lower_rad),
            () => return None,
        };
        Some(Leaving { joint, time_s: tick as f32 * period_s, rest_rad, end_rad })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rig, plan};
    use model::reference_robot::reference_robot;

    #[test]
    fn a_reference_is_refused_with_the_time_at_which_it_leaves() {
        let wide = Some([-7.0, 7.0]);
        let mut rig = Rig { limits_rad: [wide; 3], ..Rig::new(reference_robot()) };
        let plan = plan::task(20.0);
        assert_eq!(leaving(&plan.block(&rig)), None);
        rig.limits_rad[2] = Some([-1.0, 1.0]);
        let found = leaving(&plan.block(&rig)).expect("it swings by 1.57 rad");
        assert_eq!(found.joint, 3);
        assert!((0.3..2.5).contains(&found.time_s), "{found}");
        assert!(found.rest_rad.abs() > 1.0 && found.to_string().contains(" s of the reference"));
        assert_eq!(leaving(&crate::joints::with_joints(plan.block(&rig), &[1, 2])), None);
    }

    #[test]
    fn what_an_arm_can_brake_with_is_what_gravity_leaves_of_its_command() {
        let rig = Rig::new(reference_robot());
        let (strong, weak) = (rig.braking_rad_per_s2(), Rig { command_limit_v: 4.0, ..rig });
        let weak = weak.braking_rad_per_s2();
        for i in 0..3 {
            assert!(strong[i] > weak[i] && weak[i] > 0.0, "{strong:?} {weak:?}");
        }
    }
}
