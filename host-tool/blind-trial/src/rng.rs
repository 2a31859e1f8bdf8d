//! What a blind trial draws its numbers with.

use rand_distr::{Distribution, StandardNormal, Uniform};
use rand_pcg::Pcg64Mcg;

use rig::effects::Random;

/// Random numbers of one case; same seed and case, same numbers.
#[derive(Clone, Debug)]
pub struct Rng {
    random: Pcg64Mcg,
}

impl Rng {
    /// Those of a case of a trial.
    pub fn new(seed: u32, case: u32) -> Self {
        const NAME: u128 = 0xB11D_7E57;
        let state = NAME << 64 | u128::from(seed) << 32 | u128::from(case);
        let mut rng = Self { random: Pcg64Mcg::new(state << 1 | 1) };
        // The first numbers of neighbouring seeds are alike.
        for _ in 0..16 {
            rng.unit();
        }
        rng
    }

    /// A normal deviate, drawn again beyond `limit` standard deviations.
    pub fn normal_within(&mut self, limit: f64) -> f64 {
        loop {
            let deviate: f64 = StandardNormal.sample(&mut self.random);
            if deviate.abs() <= limit {
                return deviate;
            }
        }
    }

    /// The generator itself, for distributions of one's own.
    pub(crate) fn generator(&mut self) -> &mut Pcg64Mcg {
        &mut self.random
    }

    /// One of several; they must not be empty.
    pub fn pick<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[((self.unit() * of.len() as f64) as usize).min(of.len() - 1)]
    }

    /// A joint, 1 to 3.
    pub fn joint(&mut self) -> u8 {
        *self.pick(&[1, 2, 3])
    }
}

impl Random for Rng {
    fn unit(&mut self) -> f64 {
        // 0 and 1 bound a range, so this is the number and never the fallback.
        Uniform::new(0.0, 1.0).map_or(0.5, |range| range.sample(&mut self.random))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn same_case_same_numbers_and_another_case_others() {
        let first = |seed, case| Rng::new(seed, case).unit();
        assert_eq!(first(1, 2), first(1, 2));
        assert!((first(1, 2) - first(1, 3)).abs() > 1e-6);
        assert!((first(1, 2) - first(2, 2)).abs() > 1e-6);
    }

    #[test]
    fn numbers_stay_within_their_ranges() {
        let mut rng = Rng::new(1, 1);
        for _ in 0..1000 {
            assert!((0.1..=0.2).contains(&rng.log_uniform(0.1, 0.2)));
            assert!((1.0..=24.0).contains(&rng.harmonic(24)));
            assert!(rng.normal_within(2.5).abs() <= 2.5);
            assert!((1..=3).contains(&rng.joint()));
        }
    }
}
