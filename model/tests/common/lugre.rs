//! Eq. (9) integrated with steps so short that the result counts as exact.

use model::Friction;
use model::reference_robot::reference_robot;

/// The friction of the three joints, Tables 2 and 3.
pub fn joints() -> [Friction<f64>; 3] {
    reference_robot().friction
}

/// The smallest and the largest gamma over all velocities [V].
pub fn level_range(friction: &Friction<f64>) -> (f64, f64) {
    let (slow, fast) = (friction.alpha0_v + friction.alpha1_v, friction.alpha0_v);
    (slow.min(fast), slow.max(fast))
}

/// The largest deflection that friction can reach, max(gamma) / sigma0 [rad].
pub fn largest_deflection_rad(friction: &Friction<f64>) -> f64 {
    level_range(friction).1 / friction.sigma0_v_per_rad
}

/// dz/dt of eq. (9) [rad/s].
pub fn deflection_rate(friction: &Friction<f64>, velocity: f64, deflection: f64) -> f64 {
    let level = friction.stribeck_level(velocity);
    velocity - friction.sigma0_v_per_rad * velocity.abs() / level * deflection
}

/// Friction voltage of eq. (9) [V].
pub fn voltage(friction: &Friction<f64>, velocity: f64, deflection: f64) -> f64 {
    friction.sigma0_v_per_rad * deflection
        + friction.sigma1_v_s_per_rad * deflection_rate(friction, velocity, deflection)
        + friction.alpha2_v_s_per_rad * velocity
}

/// Deflection after, and mean voltage over, `duration_s`, by classical Runge-Kutta in
/// `steps` steps, the voltage's integral being a second state.
pub fn integrate(
    friction: &Friction<f64>,
    velocity: impl Fn(f64) -> f64,
    deflection_rad: f64,
    duration_s: f64,
    steps: usize,
) -> (f64, f64) {
    let h = duration_s / steps as f64;
    let slope = |v: f64, z: f64| (deflection_rate(friction, v, z), voltage(friction, v, z));
    let (mut z, mut integral) = (deflection_rad, 0.0);
    for step in 0..steps {
        let t = step as f64 * h;
        let [start, middle, end] = [t, t + 0.5 * h, t + h].map(&velocity);
        let k1 = slope(start, z);
        let k2 = slope(middle, z + 0.5 * h * k1.0);
        let k3 = slope(middle, z + 0.5 * h * k2.0);
        let k4 = slope(end, z + h * k3.0);
        z += h / 6.0 * (k1.0 + 2.0 * (k2.0 + k3.0) + k4.0);
        integral += h / 6.0 * (k1.1 + 2.0 * (k2.1 + k3.1) + k4.1);
    }
    (z, integral / duration_s)
}
