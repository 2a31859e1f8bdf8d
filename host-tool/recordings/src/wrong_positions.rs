//! Positions that an encoder or its bus got wrong for one sample: found by their neighbours, and put
//! where those say. Differentiated twice they would drown everything else.

/// How far positions may be from where their neighbours put them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// A position is wrong that is so many times further off than those around it are, rms.
    pub deviations: f64,
    /// Samples to either side that tell how far that is.
    pub around: usize,
    /// Others among them that may be wrong as well: two that are equally far off would hide each other.
    pub others_wrong: usize,
    /// A position is all that is wrong with its neighbours if putting it right leaves less than this part
    /// of their squares.
    pub most_left: f64,
    /// Most rounds: a position that is far off hides others about it that are less so.
    pub most_rounds: usize,
}

impl Default for Settings {
    /// Twelve deviations are no chance, and no impact either: that bends a motion for longer than a
    /// sample, and its kink leaves 7 % of the squares. A hundred samples are a piece of motion, in which some
    /// few are wrong where one in a hundred is.
    fn default() -> Self {
        Self { deviations: 12.0, around: 100, others_wrong: 3, most_left: 0.04, most_rounds: 6 }
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
    let suspect = |k: usize| {
        let spacing_s = (time_s[k + 2] - time_s[k - 2]) / 4.0;
        let possible_rad =
            impossible.steps_rad.max(impossible.acceleration_rad_per_s2 * spacing_s * spacing_s);
        if off_rad[k].abs() <= possible_rad {
            return None;
        }
        let others = if is_spike(time_s, q_rad, &off_rad, k, settings.most_left) {
            settings.others_wrong
        } else {
            0
        };
        let usual_rad = settings.deviations * usual(&off_rad, k, others, settings.around);
        let least_rad = usual_rad.max(possible_rad).max(f64::MIN_POSITIVE);
        let ratio = off_rad[k].abs() / least_rad;
        (ratio > 1.0).then_some((k, ratio, least_rad))
    };
    (2..count - 2).filter_map(suspect).collect()
}

/// How far samples around one are off, rms, without those that it makes look wrong and those that so many
/// others do.
fn usual(off_rad: &[f64], k: usize, others_wrong: usize, around: usize) -> f64 {
    let (from, to) = (k.saturating_sub(around), (k + around + 1).min(off_rad.len()));
    let others = (from..to).filter(|other| other.abs_diff(k) > 2);
    let mut squares: Vec<f64> = others.map(|other| off_rad[other].powi(2)).collect();
    squares.sort_unstable_by(f64::total_cmp);
    squares.truncate(squares.len().saturating_sub(5 * others_wrong));
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}

/// Whether a sample is all that is wrong with its neighbours: once it is where they say, they are where
/// theirs say.
fn is_spike(time_s: &[f64], q_rad: &[f64], off_rad: &[f64], k: usize, most_left: f64) -> bool {
    let (from, to) = (k.saturating_sub(4), (k + 5).min(q_rad.len()));
    let mut corrected = q_rad[from..to].to_vec();
    corrected[k - from] -= off_rad[k];
    let near = (k - 2).max(2)..(k + 3).min(q_rad.len() - 2);
    let before: f64 = near.clone().map(|near| off_rad[near].powi(2)).sum();
    let left = |near: usize| deviation(&time_s[from..to], &corrected, near - from).powi(2);
    near.map(left).sum::<f64>() < most_left * before
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
    fn errors_of_one_size_do_not_hide_each_other() {
        let (time_s, right) = swing(4000);
        let mut q_rad = right.clone();
        for (k, off) in [(2000, 0.06), (2051, -0.055), (2090, 0.05), (2095, 0.06)] {
            q_rad[k] += off;
        }
        let places = correct(&time_s, &mut q_rad, &JOINT, &Settings::default());
        assert_eq!(places, [2000, 2051, 2090, 2095]);
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
