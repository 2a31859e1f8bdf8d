//! Positions that an encoder or its bus got wrong for one sample: found by their neighbours, and put
//! where those say. Differentiated twice they would drown everything else.

/// How far positions may be from where their neighbours put them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// A position is wrong that is so many times further off than those around it are, rms.
    pub deviations: f64,
    /// Samples to either side that tell how far that is.
    pub around: usize,
    /// Most rounds: a position that is far off hides others about it that are less so.
    pub most_rounds: usize,
}

impl Default for Settings {
    /// Twelve deviations are no chance, and no impact either: that bends a motion for longer than a
    /// sample. A hundred samples are a piece of motion, in which some few hide others.
    fn default() -> Self {
        Self { deviations: 12.0, around: 100, most_rounds: 6 }
    }
}

/// What no joint can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impossible {
    /// More than the encoder's steps [rad].
    pub steps_rad: f64,
    /// More than its motor can accelerate the joint [rad/s^2].
    pub acceleration_rad_per_s2: f64,
}

/// Corrects positions [rad] at times [s]; the places of those that were wrong, by more than a joint
/// can do. The two first and last samples are left as they are.
pub fn correct(
    time_s: &[f64],
    q_rad: &mut [f64],
    impossible: &Impossible,
    settings: &Settings,
) -> Vec<usize> {
    let mut corrected: Vec<usize> = Vec::new();
    for _ in 0..settings.most_rounds {
        let found = correct_once(time_s, q_rad, impossible, settings);
        if found.is_empty() {
            break;
        }
        corrected.extend(found);
    }
    corrected.sort_unstable();
    corrected.dedup();
    corrected
}

/// One round of corrections.
fn correct_once(
    time_s: &[f64],
    q_rad: &mut [f64],
    impossible: &Impossible,
    settings: &Settings,
) -> Vec<usize> {
    let mut places = suspects(time_s, q_rad, impossible, settings);
    // The worst first, for it makes its neighbours look wrong as well.
    places.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut corrected: Vec<usize> = Vec::new();
    for (k, _, least_rad) in places {
        let off_rad = deviation(time_s, q_rad, k);
        if off_rad.abs() > least_rad {
            q_rad[k] -= off_rad;
            corrected.push(k);
        }
    }
    corrected
}

/// Samples that are far off: place, how far in parts of what is allowed, and that [rad].
fn suspects(
    time_s: &[f64],
    q_rad: &[f64],
    impossible: &Impossible,
    settings: &Settings,
) -> Vec<(usize, f64, f64)> {
    let count = q_rad.len();
    if count < 5 {
        return Vec::new();
    }
    let off_rad: Vec<f64> = (0..count)
        .map(|k| if (2..count - 2).contains(&k) { deviation(time_s, q_rad, k) } else { 0.0 })
        .collect();
    let mut sums = vec![0.0];
    for off in &off_rad {
        sums.push(sums[sums.len() - 1] + off * off);
    }
    let square = |from: usize, to: usize| sums[to] - sums[from];
    let suspect = |k: usize| {
        let (from, to) = (k.saturating_sub(settings.around), (k + settings.around + 1).min(count));
        let own = square(k - 2, k + 3);
        let others = (to - from).saturating_sub(5).max(1) as f64;
        let rms_rad = ((square(from, to) - own).max(0.0) / others).sqrt();
        let spacing_s = (time_s[k + 2] - time_s[k - 2]) / 4.0;
        let least_rad = (settings.deviations * rms_rad)
            .max(impossible.steps_rad)
            .max(impossible.acceleration_rad_per_s2 * spacing_s * spacing_s);
        let ratio = off_rad[k].abs() / least_rad.max(f64::MIN_POSITIVE);
        (ratio > 1.0).then_some((k, ratio, least_rad))
    };
    (2..count - 2).filter_map(suspect).collect()
}

/// How far a position is from the cubic through its two neighbours on either side [rad].
fn deviation(time_s: &[f64], q_rad: &[f64], k: usize) -> f64 {
    let places = [k - 2, k - 1, k + 1, k + 2];
    let weight = |i: usize| -> f64 {
        let others = places.iter().filter(|&&j| j != i);
        others.map(|&j| (time_s[k] - time_s[j]) / (time_s[i] - time_s[j])).product()
    };
    q_rad[k] - places.iter().map(|&i| weight(i) * q_rad[i]).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    const JOINT: Impossible = Impossible { steps_rad: 4e-5, acceleration_rad_per_s2: 100.0 };

    fn swing(count: usize) -> (Vec<f64>, Vec<f64>) {
        const STEP_RAD: f64 = 1e-5;
        let time_s: Vec<f64> = (0..count).map(|k| 1e-3 * k as f64).collect();
        let rounded = |t: &f64| ((8.0 * t).sin() / STEP_RAD).round() * STEP_RAD;
        let q_rad = time_s.iter().map(rounded).collect();
        (time_s, q_rad)
    }

    #[test]
    fn wrong_positions_are_put_right() {
        let (time_s, right) = swing(4000);
        let mut q_rad = right.clone();
        for (k, off) in [(500, 0.02), (501, -0.004), (1200, 3e-4), (3000, -0.2)] {
            q_rad[k] += off;
        }
        let places = correct(&time_s, &mut q_rad, &JOINT, &Settings::default());
        for k in [500, 1200, 3000] {
            assert!(places.contains(&k), "{k} not in {places:?}");
        }
        let error = right.iter().zip(&q_rad).map(|(a, b)| (a - b).abs()).fold(0.0_f64, f64::max);
        assert!(error < 5e-3, "{error}");
    }

    #[test]
    fn a_large_error_hides_no_smaller_one_near_by() {
        let (time_s, right) = swing(4000);
        let mut q_rad = right.clone();
        for (k, off) in [(2000, 0.3), (2040, 0.05), (2071, -0.004)] {
            q_rad[k] += off;
        }
        let places = correct(&time_s, &mut q_rad, &JOINT, &Settings::default());
        assert_eq!(places, [2000, 2040, 2071]);
    }

    #[test]
    fn an_impact_is_no_error() {
        let (time_s, mut q_rad) = swing(4000);
        // The speed is gone within five milliseconds.
        let speed = (q_rad[1960] - q_rad[1959]) / 1e-3;
        for k in 1961..4000 {
            let left = f64::max(0.0, 1.0 - 0.2 * (k - 1960) as f64);
            q_rad[k] = q_rad[k - 1] + 1e-3 * speed * left;
        }
        let before = q_rad.clone();
        let places = correct(&time_s, &mut q_rad, &JOINT, &Settings::default());
        let moved = before.iter().zip(&q_rad).map(|(a, b)| (a - b).abs()).fold(0.0_f64, f64::max);
        assert!(places.len() <= 2 && moved < 2e-3, "{places:?}, {moved}");
    }
}
