//! One joint's motion and command, smoothed alike and differentiated on an even grid.

/// How a motion is smoothed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothing {
    /// Standard deviation of the Gaussian that position and command pass alike [s].
    pub width_s: f64,
    /// Time between the points at which the motion is wanted [s].
    pub step_s: f64,
}

impl Smoothing {
    /// The narrowest Gaussian that leaves no more velocity noise from an encoder's
    /// step than wanted, but not below three and not above 25 samples.
    ///
    /// White rounding errors of variance step^2 / 12 pass the derivative of a Gaussian
    /// of width s with the gain T / (4 sqrt(pi) s^3).
    pub fn for_encoder(encoder_step_rad: f64, period_s: f64, noise_rad_per_s: f64) -> Self {
        let variance = encoder_step_rad * encoder_step_rad / 12.0;
        let gain = 4.0 * std::f64::consts::PI.sqrt();
        let cube = period_s * variance / (gain * noise_rad_per_s * noise_rad_per_s);
        let width_s = cube.cbrt().clamp(3.0 * period_s, 25.0 * period_s);
        Self { width_s, step_s: 2.0 * period_s }
    }
}

/// One joint on an even grid; all of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SmoothedMotion {
    /// Time between points [s].
    pub step_s: f64,
    /// Times [s].
    pub time_s: Vec<f64>,
    /// Angle [rad].
    pub q_rad: Vec<f64>,
    /// Velocity [rad/s].
    pub qd_rad_per_s: Vec<f64>,
    /// Acceleration [rad/s^2].
    pub qdd_rad_per_s2: Vec<f64>,
    /// Command [V].
    pub command_v: Vec<f64>,
    /// Whether samples, not a gap between them, stand behind a point.
    pub measured: Vec<bool>,
}

impl SmoothedMotion {
    /// How many points there are.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// The nearest points to another motion's times.
    pub fn at_times_of(&self, other: &Self) -> Self {
        let first_s = self.time_s.first().copied().unwrap_or(0.0);
        let nearest = |time_s: &f64| {
            let point = ((time_s - first_s) / self.step_s).round().max(0.0) as usize;
            point.min(self.len().saturating_sub(1))
        };
        let points: Vec<usize> = other.time_s.iter().map(nearest).collect();
        let chosen = |values: &[f64]| points.iter().map(|&point| values[point]).collect();
        Self {
            step_s: other.step_s,
            time_s: other.time_s.clone(),
            q_rad: chosen(&self.q_rad),
            qd_rad_per_s: chosen(&self.qd_rad_per_s),
            qdd_rad_per_s2: chosen(&self.qdd_rad_per_s2),
            command_v: chosen(&self.command_v),
            measured: points.iter().map(|&point| self.measured[point]).collect(),
        }
    }
}

/// Smooths a joint's columns.
///
/// Position and command pass the same Gaussian, so that every linear equation between
/// them stays exact. The command of a row holds from its time on: its centre lies half
/// a sample later, which the Gaussian of the command makes good.
pub fn smoothed(
    time_s: &[f64],
    q_rad: &[f64],
    command_v: &[f64],
    how: &Smoothing,
) -> SmoothedMotion {
    let even = EvenSamples::of(time_s, q_rad, command_v);
    let kernel = Kernel::new(how.width_s / even.period_s);
    let stride = (how.step_s / even.period_s).round().max(1.0) as usize;
    let reach = kernel.reach();
    let mut motion =
        SmoothedMotion { step_s: stride as f64 * even.period_s, ..SmoothedMotion::default() };
    let last = even.q_rad.len().saturating_sub(reach);
    for centre in (reach..last).step_by(stride) {
        let q = &even.q_rad[centre - reach..centre + reach];
        let middle = even.q_rad[centre];
        let moments = kernel.moments(q, middle);
        motion.time_s.push(even.start_s + centre as f64 * even.period_s);
        motion.q_rad.push(middle + moments[0]);
        motion.qd_rad_per_s.push(moments[1] / even.period_s);
        motion.qdd_rad_per_s2.push(moments[2] / (even.period_s * even.period_s));
        motion.command_v.push(kernel.held(&even.command_v[centre - reach..centre + reach]));
        motion.measured.push(even.gaps_before[centre + reach] == even.gaps_before[centre - reach]);
    }
    motion
}

/// Columns on an even grid of the typical period.
struct EvenSamples {
    start_s: f64,
    period_s: f64,
    q_rad: Vec<f64>,
    command_v: Vec<f64>,
    /// How many points up to here lie in gaps.
    gaps_before: Vec<u32>,
}

impl EvenSamples {
    fn of(time_s: &[f64], q_rad: &[f64], command_v: &[f64]) -> Self {
        const GAP_IN_PERIODS: f64 = 5.0;
        let period_s = typical_period_s(time_s);
        let start_s = time_s.first().copied().unwrap_or(0.0);
        let span_s = time_s.last().map_or(0.0, |end| end - start_s);
        // A millionth of a period forgives rounded times.
        let points = if period_s > 0.0 { (span_s / period_s + 1e-6) as usize + 1 } else { 0 };
        let mut even = Self {
            start_s,
            period_s,
            q_rad: Vec::with_capacity(points),
            command_v: Vec::with_capacity(points),
            gaps_before: Vec::with_capacity(points),
        };
        let (mut row, mut gaps) = (0, 0);
        for point in 0..points {
            let time = start_s + (point as f64 + 1e-6) * period_s;
            while row + 2 < time_s.len() && time_s[row + 1] <= time {
                row += 1;
            }
            let interval_s = time_s[row + 1] - time_s[row];
            let share = ((time - time_s[row]) / interval_s).clamp(0.0, 1.0);
            let share = if share < 1e-5 { 0.0 } else { share };
            gaps += u32::from(interval_s > GAP_IN_PERIODS * period_s);
            even.q_rad.push(q_rad[row] + share * (q_rad[row + 1] - q_rad[row]));
            even.command_v.push(command_v[row]);
            even.gaps_before.push(gaps);
        }
        even
    }
}

/// The median time between samples [s]; 0 with fewer than two.
pub fn typical_period_s(time_s: &[f64]) -> f64 {
    let mut periods: Vec<f64> = time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if periods.is_empty() {
        return 0.0;
    }
    let middle = periods.len() / 2;
    *periods.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// A sampled Gaussian and its derivatives, exact for parabolas; lengths in samples.
struct Kernel {
    mean: Vec<f64>,
    first: Vec<f64>,
    second: Vec<f64>,
    held: Vec<f64>,
}

impl Kernel {
    fn new(width: f64) -> Self {
        const REACH_IN_WIDTHS: f64 = 3.5;
        let reach = (REACH_IN_WIDTHS * width).ceil().max(2.0) as i32;
        let offsets: Vec<f64> = (-reach..reach).map(f64::from).collect();
        let bell = |x: f64| (-0.5 * (x / width).powi(2)).exp();
        let sum = |f: &dyn Fn(f64) -> f64| offsets.iter().map(|&x| f(x)).sum::<f64>();
        // The lone tap at -reach has no partner: without it the kernels are symmetric.
        let paired = |x: f64| if x == -f64::from(reach) { 0.0 } else { bell(x) };
        let (m0, m2, m4) =
            (sum(&paired), sum(&|x| x * x * paired(x)), sum(&|x| x.powi(4) * paired(x)));
        let centre = m2 / m0;
        let held_sum = sum(&|x| bell(x + 0.5));
        let taps = |f: &dyn Fn(f64) -> f64| offsets.iter().map(|&x| f(x)).collect();
        Self {
            mean: taps(&|x| paired(x) / m0),
            first: taps(&|x| x * paired(x) / m2),
            second: taps(&|x| 2.0 * (x * x - centre) * paired(x) / (m4 - centre * m2)),
            held: taps(&|x| bell(x + 0.5) / held_sum),
        }
    }

    fn reach(&self) -> usize {
        self.mean.len() / 2
    }

    /// Mean, first and second derivative of values taken from `origin`.
    fn moments(&self, values: &[f64], origin: f64) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (i, value) in values.iter().enumerate() {
            let value = value - origin;
            sums[0] += self.mean[i] * value;
            sums[1] += self.first[i] * value;
            sums[2] += self.second[i] * value;
        }
        sums
    }

    /// Mean of values each held for the sample that it begins.
    fn held(&self, values: &[f64]) -> f64 {
        self.held.iter().zip(values).map(|(tap, value)| tap * value).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_keeps_its_derivatives_and_a_held_command_its_time() {
        let time_s: Vec<f64> = (0..400).map(|k| 1e-3 * f64::from(k)).collect();
        let q: Vec<f64> = time_s.iter().map(|t| 0.3 - 2.0 * t + 5.0 * t * t).collect();
        let held: Vec<f64> = time_s.iter().map(|t| 4.0 * (t + 0.5e-3)).collect();
        let motion = smoothed(&time_s, &q, &held, &Smoothing { width_s: 0.004, step_s: 0.002 });
        for k in 0..motion.len() {
            let t = motion.time_s[k];
            assert!((motion.qd_rad_per_s[k] + 2.0 - 10.0 * t).abs() < 1e-9);
            assert!((motion.qdd_rad_per_s2[k] - 10.0).abs() < 1e-7);
            assert!((motion.command_v[k] - 4.0 * t).abs() < 1e-9);
            assert!(motion.measured[k]);
        }
    }

    #[test]
    fn a_gap_is_marked() {
        let time_s: Vec<f64> =
            (0..400).filter(|k| !(150..200).contains(k)).map(|k| 1e-3 * f64::from(k)).collect();
        let motion =
            smoothed(&time_s, &time_s, &time_s, &Smoothing { width_s: 0.003, step_s: 0.001 });
        let marked = |t: f64| !motion.measured[((t - motion.time_s[0]) / 1e-3).round() as usize];
        assert!(marked(0.175) && !marked(0.1) && !marked(0.3));
    }
}
