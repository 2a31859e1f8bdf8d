//! Velocity and acceleration of a sampled position, by a parabola through its neighbours.

/// Velocities and accelerations at the rows, from parabolas over `half_window_s` either way.
///
/// `time_s` increases; at the ends the parabola is one-sided. Both are zero where fewer than four
/// rows lie in the window.
pub fn derivatives(time_s: &[f64], position: &[f64], half_window_s: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut from, mut to) = (0, 0);
    let mut found = (Vec::with_capacity(time_s.len()), Vec::with_capacity(time_s.len()));
    for (row, &now) in time_s.iter().enumerate() {
        while now - time_s[from] > half_window_s {
            from += 1;
        }
        while to < time_s.len() && time_s[to] - now <= half_window_s {
            to += 1;
        }
        let (slope, bend) = parabola(&time_s[from..to], &position[from..to], now, position[row]);
        found.0.push(slope);
        found.1.push(2.0 * bend);
    }
    found
}

/// Slope and half the curvature at `now` of the parabola through points, least squares.
fn parabola(time_s: &[f64], position: &[f64], now: f64, here: f64) -> (f64, f64) {
    if time_s.len() < 4 {
        return (0.0, 0.0);
    }
    let (mut s, mut r) = ([0.0; 5], [0.0; 3]);
    for (t, p) in time_s.iter().zip(position) {
        let (x, y) = (t - now, p - here);
        let mut power = 1.0;
        for k in 0..5 {
            s[k] += power;
            if k < 3 {
                r[k] += power * y;
            }
            power *= x;
        }
    }
    let rows = nalgebra::Matrix3::new(s[0], s[1], s[2], s[1], s[2], s[3], s[2], s[3], s[4]);
    let right = nalgebra::Vector3::new(r[0], r[1], r[2]);
    rows.lu().solve(&right).map_or((0.0, 0.0), |x| (x[1], x[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_found_at_uneven_times_and_at_the_ends() {
        let time: Vec<f64> =
            (0..40).map(|k| 0.02 * f64::from(k) + 0.003 * f64::from(k % 3)).collect();
        let position: Vec<f64> = time.iter().map(|t| 0.3 + 2.0 * t - 1.5 * t * t).collect();
        let (velocity, acceleration) = derivatives(&time, &position, 0.1);
        for (k, t) in time.iter().enumerate() {
            assert!((velocity[k] - (2.0 - 3.0 * t)).abs() < 1e-8);
            assert!((acceleration[k] + 3.0).abs() < 1e-6);
        }
    }
}
