//! A stretch of a log for tests.

use files::Role;

use crate::criteria::Criteria;
use crate::logs::kinematics::Kinematics;
use crate::logs::stretch::Stretch;
use crate::rows::evidence::Evidence;
use crate::rows::noise::{Noise, NoiseByRate};

/// Distance of its samples [s].
pub const PERIOD_S: f64 = 1e-3;

/// A motion of three joints with its commands, without settling.
pub fn stretch_of(motion: Kinematics, command_v: Vec<Vec<f64>>, broadband: bool) -> Stretch {
    let postures = motion.postures();
    Stretch {
        log: 0,
        role: Role::Train,
        start_s: 0.0,
        period_s: PERIOD_S,
        motion,
        postures,
        derived: Default::default(),
        command_v,
        broadband,
        settled: vec![0; 3],
        unseen: Vec::new(),
        known_part: vec![Vec::new(); 3],
        roughness: Vec::new(),
        at_rest_rad: vec![0.0; 3],
        sampled_s: PERIOD_S,
    }
}

/// A motion of three joints on sines about -0.7 rad: their amplitude [rad], their frequencies [rad/s], how many samples.
pub fn sines(amplitude: f64, frequencies: [f64; 3], samples: i32) -> Kinematics {
    let mut motion = Kinematics::of_joints(3);
    for (joint, w) in frequencies.into_iter().enumerate() {
        for k in 0..samples {
            let (sine, cosine) = (w * PERIOD_S * f64::from(k)).sin_cos();
            motion.q_rad[joint].push(amplitude * sine - 0.7);
            motion.qd_rad_per_s[joint].push(amplitude * w * cosine);
            motion.qdd_rad_per_s2[joint].push(-amplitude * w * w * sine);
        }
    }
    motion.raw_rad = motion.q_rad.clone();
    motion
}

/// Rows of three joints on sines, six seconds under no command, with white noise.
pub fn rows_of_sines(criteria: &Criteria) -> Evidence {
    rows_of_sines_under(&[0.0; 6000], false, criteria)
}

/// The same under 6000 samples of a command of each joint [V].
pub fn rows_of_sines_under(command_v: &[f64], broadband: bool, criteria: &Criteria) -> Evidence {
    let motion = sines(0.3, [5.0, 7.0, 9.0], 6000);
    let white: Vec<f64> = (0..6000).map(|k| (f64::from(k * k % 977)).sin()).collect();
    let seen = Noise::of(&[&white], PERIOD_S, &criteria.rows);
    let mut noise = NoiseByRate::default();
    noise.push(PERIOD_S, &[seen; 3], vec![0.0; 3]);
    let stretch = stretch_of(motion, vec![command_v.to_vec(); 3], broadband);
    Evidence::new(vec![stretch], vec![0, 1, 2], &noise, criteria)
}
