//! Coriolis and gravity torques along a stretch, which friction may follow.

use std::sync::{Arc, Mutex, PoisonError};

use super::kinematics::{Joints, Middles};
use rig::plant::Body;

/// What a body's motion asks of its joints, accelerations apart: c + h of eq. (5).
#[derive(Debug)]
pub struct Loads {
    body: Body,
    /// Load on the joints in the middle of every interval [Nm; N].
    pub by_interval_nm: Vec<Joints>,
}

impl Loads {
    /// Those of a body along the middles of the intervals.
    pub fn of(body: &Body, middles: &Middles) -> Self {
        let at = |k: usize| {
            let ((q_rad, qd_rad_per_s), mut load_nm) = (middles.at(k), Joints::default());
            body.load(q_rad, qd_rad_per_s, &mut load_nm);
            load_nm
        };
        Self { body: body.clone(), by_interval_nm: (0..middles.len()).map(at).collect() }
    }
}

/// The loads along one motion that were asked for last: most of what is tried after another has the same body.
#[derive(Debug, Default)]
pub struct LastLoads(Mutex<Option<Arc<Loads>>>);

impl LastLoads {
    /// Those of a body along the middles of the stretch's intervals.
    pub fn of(&self, body: &Body, middles: &Middles) -> Arc<Loads> {
        let last = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(loads) = last().as_ref().filter(|loads| loads.body == *body) {
            return Arc::clone(loads);
        }
        let loads = Arc::new(Loads::of(body, middles));
        *last() = Some(Arc::clone(&loads));
        loads
    }
}

/// A copy has been asked for none yet.
impl Clone for LastLoads {
    fn clone(&self) -> Self {
        Self::default()
    }
}
