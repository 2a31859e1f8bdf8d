//! Draws realities, all but their clutter.

use super::settings::{BusRanges, FrictionRanges, ModelRanges, Range, Ranges};
use crate::reality::{Bus, ColouredNoise, Heat, JointFriction, Law, ModelError, Reality};
use crate::rng::Rng;
use crate::robots::model_off;
use model::{Geometry, Robot};
use rig::effects::Random;

/// A reality without clutter.
pub fn draw_reality(ranges: &Ranges, rng: &mut Rng) -> Reality {
    Reality {
        friction: draw_friction(&ranges.friction, rng),
        clutter: Vec::new(),
        coloured_noise: draw_colour(&ranges.bus, rng),
        bus: draw_bus(&ranges.bus, rng),
        model_error: draw_model_error(&ranges.model, rng),
    }
}

/// Evenly in the logarithm.
fn within(rng: &mut Rng, (least, most): Range) -> f64 {
    rng.log_uniform(least, most)
}

/// A whole number, each as often.
pub(super) fn whole(rng: &mut Rng, (least, most): Range) -> f64 {
    (least + (rng.unit() * (most - least + 1.0)).floor()).min(most)
}

/// A value where a defect is there, else 0.
fn perhaps(rng: &mut Rng, chance: f64, range: Range) -> f64 {
    let value = within(rng, range);
    if rng.unit() < chance { value } else { 0.0 }
}

/// One law for the whole robot, with numbers of its own for each joint.
fn draw_friction(ranges: &FrictionRanges, rng: &mut Rng) -> [JointFriction; 3] {
    let law = draw_law(ranges, rng);
    let warm = rng.unit() < ranges.warm;
    [(); 3].map(|()| JointFriction {
        law: parameters_of(law, ranges, rng),
        heat: warm.then(|| Heat {
            fall: within(rng, ranges.fall),
            time_constant_s: within(rng, ranges.warming_s),
            relative_power: within(rng, ranges.relative_power),
        }),
    })
}

/// Which law, as its place in [`FrictionRanges::laws`].
fn draw_law(ranges: &FrictionRanges, rng: &mut Rng) -> usize {
    let mut rest = rng.unit() * ranges.laws.iter().sum::<f64>();
    let chosen = ranges.laws.iter().position(|part| {
        rest -= part;
        rest <= 0.0
    });
    chosen.unwrap_or(0)
}

/// A law for each joint, one of those at these places of [`FrictionRanges::laws`] for the robot.
pub(crate) fn draw_law_among(
    places: &[usize],
    ranges: &FrictionRanges,
    rng: &mut Rng,
) -> [JointFriction; 3] {
    let place = *rng.pick(places);
    [(); 3].map(|()| JointFriction { law: parameters_of(place, ranges, rng), heat: None })
}

fn parameters_of(law: usize, ranges: &FrictionRanges, rng: &mut Rng) -> Law {
    match law {
        1 => Law::Tanh { width_rad_per_s: within(rng, ranges.width_rad_per_s) },
        2 => Law::Ramp { width_rad_per_s: within(rng, ranges.width_rad_per_s) },
        3 => Law::Dahl { relative_stiffness: within(rng, ranges.dahl_stiffness) },
        4 => Law::MaxwellSlip {
            elements: whole(rng, ranges.slip_elements) as usize,
            spread: within(rng, ranges.slip_spread),
            attraction_per_s: within(rng, ranges.slip_attraction_per_s),
        },
        5 => Law::StribeckLag {
            lag_s: within(rng, ranges.stribeck_lag_s),
            stribeck_factor: within(rng, ranges.stribeck_factor),
        },
        6 => Law::SoftConstraint { creep_rad_per_s: within(rng, ranges.creep_rad_per_s) },
        _ => Law::Lugre,
    }
}

fn draw_colour(ranges: &BusRanges, rng: &mut Rng) -> ColouredNoise {
    ColouredNoise {
        rms_v: perhaps(rng, ranges.coloured, ranges.coloured_v),
        correlation_time_s: within(rng, ranges.correlation_time_s),
    }
}

fn draw_bus(ranges: &BusRanges, rng: &mut Rng) -> Bus {
    let defect = ranges.defect;
    Bus {
        sample_period_s: *rng.pick(&ranges.sample_periods_s),
        encoder_bits: whole(rng, ranges.encoder_bits) as u32,
        sampling_jitter_s: perhaps(rng, defect, ranges.sampling_jitter_s),
        stamp_jitter_s: perhaps(rng, defect, ranges.stamp_jitter_s),
        clock_error: perhaps(rng, defect, ranges.clock_error),
        clock_wander_s: perhaps(rng, defect, ranges.clock_wander_s),
        wander_period_s: within(rng, ranges.wander_period_s),
        lost_part: perhaps(rng, defect, ranges.lost_part),
        lost_run: within(rng, ranges.lost_run),
        outlier_part: perhaps(rng, defect, ranges.outlier_part),
        outlier_rad: within(rng, ranges.outlier_rad),
    }
}

fn draw_model_error(ranges: &ModelRanges, rng: &mut Rng) -> ModelError {
    ModelError {
        parameters: within(rng, ranges.parameters),
        torque_constants: perhaps(rng, ranges.torque_constants_off, ranges.torque_constants),
        lengths: perhaps(rng, ranges.lengths_off, ranges.lengths),
    }
}

/// The model as given: so far off as `error` says, or less where no rigid body is.
pub(super) fn draw_model(truth: &Robot<f64>, error: &ModelError, rng: &mut Rng) -> Robot<f64> {
    const ATTEMPTS: i32 = 40;
    let off = |deviation: f64, rng: &mut Rng| 1.0 + deviation * rng.normal_within(2.5);
    let torque_constant_nm_per_v =
        truth.torque_constant_nm_per_v.map(|k_t| k_t * off(error.torque_constants, rng));
    let Geometry { gravity_m_s2, d1_m, d2_m, a2_m, d3_m, a3_m } = truth.geometry;
    let [d1_m, d2_m, a2_m, d3_m, a3_m] =
        [d1_m, d2_m, a2_m, d3_m, a3_m].map(|length| length * off(error.lengths, rng));
    let geometry = Geometry { gravity_m_s2, d1_m, d2_m, a2_m, d3_m, a3_m };
    // The deviation falls slowly from attempt to attempt: a CAD model is at least a body.
    let attempt = |k: i32| model_off(truth, error.parameters * 0.95_f64.powi(k), rng);
    let near = (0..ATTEMPTS).find_map(attempt).unwrap_or(*truth);
    let model = Robot { torque_constant_nm_per_v, geometry, ..near };
    model.checked().unwrap_or(Robot { torque_constant_nm_per_v, ..near })
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;

    use super::*;

    #[test]
    fn every_law_is_drawn_and_models_are_as_far_off_as_they_say() {
        let ranges = Ranges::default();
        let mut rng = Rng::new(1, 1);
        let truth = reference_robot::<f64>();
        let mut laws = std::collections::BTreeSet::new();
        for _ in 0..200 {
            let reality = draw_reality(&ranges, &mut rng);
            laws.insert(format!("{:?}", std::mem::discriminant(&reality.friction[0].law)));
            assert!((13..=19).contains(&reality.bus.encoder_bits));
            let model = draw_model(&truth, &reality.model_error, &mut rng);
            let ratio = model.torque_constant_nm_per_v[0] / truth.torque_constant_nm_per_v[0];
            assert!((ratio - 1.0).abs() <= 2.5 * reality.model_error.torque_constants + 1e-12);
            assert!(model.checked().is_ok());
        }
        assert_eq!(laws.len(), 7);
    }
}
