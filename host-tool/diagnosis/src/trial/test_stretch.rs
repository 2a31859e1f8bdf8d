//! A stretch of a log for tests.

use files::Role;

use crate::logs::kinematics::Kinematics;
use crate::logs::stretch::Stretch;

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
