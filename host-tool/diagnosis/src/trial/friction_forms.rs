//! Forms of friction about standstill that LuGre lacks.

/// How many.
pub const COUNT: usize = SLIPS.len() + SPEEDS.len();
const SLIPS: [f64; 5] = [0.0003, 0.001, 0.003, 0.01, 0.03];
const SPEEDS: [f64; 5] = [0.005, 0.015, 0.05, 0.15, 0.5];

/// Values of each form in the intervals of a motion.
pub fn along(v: &[f64], period_s: f64) -> Vec<Vec<f64>> {
    let last = v.len().saturating_sub(1);
    let mid = |k: usize| 0.5 * (v[k] + v[(k + 1).min(last)]);
    let slip = |r: &f64| {
        let mut s = 0.0_f64;
        (0..v.len()).map(|k| { let before = s; s = (s + mid(k) * period_s / r).clamp(-1.0, 1.0); 0.5 * (before + s) }).collect()
    };
    let speed = |w: &f64| (0..v.len()).map(|k| (mid(k) / w).tanh()).collect();
    SLIPS.iter().map(slip).chain(SPEEDS.iter().map(speed)).collect()
}
