//! LuGre friction, eq. (9), driven by a velocity that is known but for a jitter.

use model::{Friction, FrictionState};

/// The bristles of a joint. Noise moves it by less than the encoder resolves, and yet |v|
/// in eq. (9) counts it: friction relaxes under a joint that seems to stand still. The
/// velocity is therefore taken as two equally likely ones, `jitter` above and below.
pub struct Bristles<'a> {
    friction: &'a Friction<f64>,
    jitter_rad_per_s: f64,
    step_s: f64,
    /// Above this velocity z has its steady value within a step.
    settled_rad_per_s: f64,
    state: FrictionState<f64>,
}

impl<'a> Bristles<'a> {
    /// Bristles without deflection, for steps of `step_s`.
    pub fn new(friction: &'a Friction<f64>, jitter_rad_per_s: f64, step_s: f64) -> Self {
        const SETTLED: f64 = 40.0;
        let level = friction.alpha0_v.max(friction.alpha0_v + friction.alpha1_v);
        let settled_rad_per_s = SETTLED * level / friction.sigma0_v_per_rad / step_s;
        let state = FrictionState::default();
        Self { friction, jitter_rad_per_s, step_s, settled_rad_per_s, state }
    }

    /// Mean friction over a step [V].
    pub fn step(&mut self, velocity: f64) -> f64 {
        if velocity.abs() > self.settled_rad_per_s {
            let level = self.friction.stribeck_level(velocity);
            let steady = level / self.friction.sigma0_v_per_rad * velocity.signum();
            self.state.deflection_rad = steady;
            return self.friction.sliding(velocity);
        }
        let (mut above, mut below) = (self.state, self.state);
        let jitter = self.jitter_rad_per_s;
        let sum = above.step(self.friction, velocity + jitter, self.step_s)
            + below.step(self.friction, velocity - jitter, self.step_s);
        self.state.deflection_rad = 0.5 * (above.deflection_rad + below.deflection_rad);
        0.5 * sum
    }
}
