//! How much of its motion a joint is braked by its command.

use signal::rms;

use crate::rows::evidence::Evidence;

/// A joint moves where it is faster than this part of its rms velocity.
const MOVING_PART: f64 = 0.1;

/// In which part of the samples of train logs at which a joint (from 0) moves its command drives it the other way.
pub fn braked_part(evidence: &Evidence, joint: usize) -> f64 {
    let train = &evidence.stretches[..evidence.train_stretches()];
    let velocity = train.iter().flat_map(|stretch| &stretch.motion.qd_rad_per_s[joint]);
    let command = train.iter().flat_map(|stretch| &stretch.command_v[joint]);
    opposed_part(&velocity.copied().collect::<Vec<_>>(), command.copied())
}

/// Part of the samples at which a velocity and a command are of different signs, where velocity is not small.
fn opposed_part(velocity: &[f64], command: impl Iterator<Item = f64>) -> f64 {
    let slow = MOVING_PART * rms(velocity);
    let moving = velocity.iter().zip(command).filter(|(v, _)| v.abs() > slow);
    let [opposed, all] =
        moving.fold([0.0, 0.0], |[n, all], (v, u)| [n + f64::from(v * u < 0.0), all + 1.0]);
    opposed / f64::max(all, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inertia_is_braked_half_of_the_time_and_what_only_rubs_never() {
        let phases = || (0..1000).map(|k| 0.1 * f64::from(k));
        let velocity: Vec<f64> = phases().map(f64::sin).collect();
        assert_eq!(opposed_part(&velocity, phases().map(|t| 0.3 * t.sin().signum())), 0.0);
        let of_inertia = opposed_part(&velocity, phases().map(f64::cos));
        assert!((of_inertia - 0.5).abs() < 0.02, "{of_inertia}");
        assert_eq!(opposed_part(&[], std::iter::empty()), 0.0);
    }
}
