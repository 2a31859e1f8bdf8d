//! Small effects everywhere, each of a size told in parts of the command.

use super::settings::ClutterRanges;
use super::world::whole;
use crate::case::Recorded;
use crate::cause::{TrueCause, TrueEffect};
use crate::foreign;
use crate::plans::is_excitation;
use crate::rng::Rng;
use model::{HANGING_RAD, Robot};
use rig::effects::{Catalogue, Random};

/// What is typical of a joint in motion, for sizes that are told in volts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Typical {
    /// The command [V rms].
    pub command_v: f64,
    /// Coulomb friction [V].
    friction_v: f64,
    /// Squared velocity, its rms [rad^2/s^2].
    square_rad2_per_s2: f64,
    /// Largest load of gravity [Nm].
    load_nm: f64,
}

impl Typical {
    /// Of a joint (0 to 2) in the excitation.
    pub fn of(recorded: &[Recorded], robot: &Robot<f64>, counts: f64, joint: usize) -> Self {
        let log = recorded.iter().find(|r| is_excitation(&r.plan)).map(|r| &r.log);
        let joint_log = log.and_then(|log| log.joints.get(joint));
        let command = joint_log.map_or(&[][..], |joint| &joint.command_v);
        let period_s = log.and_then(files::Log::sample_period_s).unwrap_or(1e-3);
        let position = joint_log.map(|joint| joint.position_rad(counts)).unwrap_or_default();
        // Over 20 ms, so that encoder steps do not count.
        let every = (0.02 / period_s).round().max(1.0) as usize;
        let coarse: Vec<f64> = position.into_iter().step_by(every).collect();
        let squares: Vec<f64> = coarse
            .windows(2)
            .map(|pair| ((pair[1] - pair[0]) / (every as f64 * period_s)).powi(2))
            .collect();
        let base = &robot.base;
        let arm_kg_m = [0.0, base.mx2r.hypot(base.my2r), base.mx3r.hypot(base.my3r)][joint];
        Self {
            command_v: rms(command),
            friction_v: robot.friction[joint].alpha0_v,
            square_rad2_per_s2: rms(&squares),
            load_nm: robot.geometry.gravity_m_s2 * arm_kg_m,
        }
    }
}

fn rms(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|x| x * x).sum();
    (squares / values.len().max(1) as f64).sqrt()
}

/// An effect as clutter: its values for a size [V rms] on a joint (0 to 2).
struct Small {
    name: &'static str,
    values: fn(size_v: f64, typical: &Typical, joint: usize, rng: &mut Rng) -> Vec<f64>,
}

/// A sine has this amplitude for an rms of 1.
const CREST: f64 = std::f64::consts::SQRT_2;

/// Effects whose size in volts is plain to see, of the catalogue and foreign to it.
const ALL: [Small; 13] = [
    Small {
        name: "cogging",
        values: |size_v, _, _, rng| vec![CREST * size_v, rng.harmonic(24), rng.phase_rad()],
    },
    Small {
        name: "torque_ripple",
        values: |size_v, typical, _, rng| {
            vec![CREST * size_v / typical.command_v, rng.harmonic(24), rng.phase_rad()]
        },
    },
    Small {
        name: "position_friction",
        values: |size_v, typical, _, rng| {
            let amplitude = (CREST * size_v / typical.friction_v).min(0.5);
            vec![amplitude, rng.harmonic(24), rng.phase_rad()]
        },
    },
    Small {
        name: "asymmetric_friction",
        values: |size_v, typical, _, rng| vec![signed(rng, (size_v / typical.friction_v).min(0.5))],
    },
    Small {
        name: "load_friction",
        values: |size_v, typical, _, _| vec![(size_v / typical.load_nm.max(1.0)).min(0.1)],
    },
    Small {
        name: "quadratic_drag",
        values: |size_v, typical, _, _| vec![size_v / typical.square_rad2_per_s2.max(0.1)],
    },
    Small { name: "dac_offset", values: |size_v, _, _, rng| vec![signed(rng, size_v)] },
    Small { name: "dead_zone", values: |size_v, _, _, _| vec![size_v] },
    Small {
        name: "torque_constant",
        values: |size_v, typical, _, rng| vec![signed(rng, size_v / typical.command_v)],
    },
    Small {
        // About a radian from where it rests.
        name: "cable_spring",
        values: |size_v, _, joint, rng| vec![size_v, HANGING_RAD[joint] + rng.uniform(-1.0, 1.0)],
    },
    Small {
        name: "mains_hum",
        values: |size_v, _, _, rng| vec![CREST * size_v, rng.uniform(10.0, 50.0), rng.phase_rad()],
    },
    Small {
        name: "wandering_torque",
        values: |size_v, _, _, rng| vec![size_v, rng.log_uniform(0.05, 1.0), f64::from(rng.seed())],
    },
    Small {
        name: "friction_patches",
        values: |size_v, typical, joint, rng| {
            let angle = HANGING_RAD[joint] + rng.uniform(-1.5, 1.5);
            let change = (2.0 * size_v / typical.friction_v).min(0.5);
            vec![change, angle, rng.uniform(0.15, 0.6), 0.0, 0.0]
        },
    },
];

fn signed(rng: &mut Rng, size: f64) -> f64 {
    if rng.unit() < 0.5 { -size } else { size }
}

/// Some small effects on random joints, none of them where a cause of the same kind is.
pub fn draw_clutter(
    ranges: &ClutterRanges,
    typical: &[Typical; 3],
    causes: &[(TrueEffect, u8)],
    rng: &mut Rng,
) -> Vec<TrueCause> {
    let mut clutter: Vec<TrueCause> = Vec::new();
    let count = whole(rng, ranges.count) as usize;
    while clutter.len() < count {
        let (small, joint) = (rng.pick(&ALL), rng.joint());
        let index = usize::from(joint) - 1;
        let (least, most) = ranges.relative_size;
        let size_v = rng.log_uniform(least, most) * typical[index].command_v;
        let values = (small.values)(size_v, &typical[index], index, rng);
        let Some(effect) = effect_of(small.name) else { continue };
        let is_there = causes.iter().any(|(other, place)| *other == effect && *place == joint)
            || clutter.iter().any(|other| other.kind == effect && other.joint == joint);
        if !is_there {
            clutter.push(TrueCause::new(effect, joint, values));
        }
    }
    clutter
}

fn effect_of(name: &str) -> Option<TrueEffect> {
    let known = Catalogue::standard().by_name(name).map(TrueEffect::Catalogue);
    known.or_else(|| foreign::by_name(name).map(TrueEffect::Foreign))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clutter_can_be_built_and_is_not_a_cause() {
        let typical =
            Typical { command_v: 2.0, friction_v: 0.2, square_rad2_per_s2: 9.0, load_nm: 20.0 };
        let ranges = ClutterRanges { count: (3.0, 6.0), relative_size: (0.01, 0.05) };
        let mut rng = Rng::new(1, 1);
        let cause = (effect_of("cogging").unwrap(), 2);
        for _ in 0..50 {
            let clutter = draw_clutter(&ranges, &[typical; 3], &[cause], &mut rng);
            assert!((3..=6).contains(&clutter.len()));
            for small in &clutter {
                small.build().unwrap();
                assert!(small.effect != "cogging" || small.joint != 2);
            }
        }
        assert!(ALL.iter().all(|small| effect_of(small.name).is_some()));
    }
}
